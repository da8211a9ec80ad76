// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace storey::cli {

/// Lets threads that wait for each other fall asleep after some microseconds. OpenMP's spin for
/// milliseconds where nothing else is asked for: with many short lists of tasks they take half as
/// much time again as the work itself, from other threads of the program as well.
///
/// How they wait is read from the environment before `main`, so the program is started anew, once:
/// to be called before it has done anything. Where the environment says already how to wait, or the
/// program cannot be started anew, nothing happens.
/// \param arguments of the program, as `main` has them
void limitSpinning(char** arguments);

}  // namespace storey::cli
