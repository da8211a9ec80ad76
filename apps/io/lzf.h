// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

namespace storey::io {

/// Unpacks an LZF stream (the compression of PCD's `binary_compressed`, format of M. Lehmann's
/// liblzf) and checks every step. A control byte c below 32 is followed by c + 1 plain bytes; any
/// other one means: copy (c >> 5) + 2 bytes from 1 + 256 (c & 31) + next byte back, where c >> 5 =
/// 7 is extended by a further byte. Own code: PCL's lies in pcl_io, which would load VTK and MPI
/// into every program. \return true if the stream gives exactly `unpacked_size` bytes
bool unpackLzf(const unsigned char* packed, std::size_t packed_size, unsigned char* unpacked,
               std::size_t unpacked_size);

}  // namespace storey::io
