// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

// The distribution's PCL is built for baseline x86-64: Eigen aligns to 16 bytes there and takes its
// memory from malloc. With -mavx or -march=native Eigen aligns to 32 and uses another allocator,
// and memory that PCL allocates and we free then crashes the program. Better an error here.
#if EIGEN_MAX_ALIGN_BYTES > 16 && !defined(STOREY_ALLOW_WIDE_EIGEN_ALIGNMENT)
#error \
    "storey: compiled with AVX or -march=native against a baseline PCL. Drop the flag, or define STOREY_ALLOW_WIDE_EIGEN_ALIGNMENT if your PCL was built the same way."
#endif
