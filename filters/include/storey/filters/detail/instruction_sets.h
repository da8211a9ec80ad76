// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Has a function over plain arrays compiled for several instruction sets, one of which is chosen at
// run time. Only in files that include neither PCL nor Eigen: their types change with the set.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && defined(__linux__)
#define STOREY_EACH_INSTRUCTION_SET __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define STOREY_EACH_INSTRUCTION_SET
#endif
