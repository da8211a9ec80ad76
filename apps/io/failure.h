// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <exception>
#include <functional>
#include <string>

namespace storey::io {

/// Exit statuses of every storey program. A batch engine acts on them: 65 is never worth a retry,
/// 75 is.
enum ExitStatus : int {
  Ok = 0,
  Partly = 1,         ///< some of several buildings failed
  Usage = 2,          ///< wrong command line
  BadInput = 65,      ///< an input is there but cannot be used
  MissingInput = 66,  ///< an input is not there, or not readable
  Internal = 70,      ///< a fault of the program
  CannotCreate = 73,  ///< an output cannot be created
  IoError = 74,       ///< reading or writing failed half-way: disk full, device error
  Temporary = 75,     ///< may succeed later or on a larger machine
};

/// The end of a program's work for a reason that the user can see and act on. `what()` is one line,
/// "file: reason; hint", free of control characters whatever the file's name or content.
class Failure : public std::exception {
 public:
  /// \param file   the file concerned; empty if there is none
  /// \param reason what is wrong, with the line or byte where that helps
  /// \param hint   what to do about it; empty if there is nothing to say
  Failure(ExitStatus status, const std::string& file, const std::string& reason,
          const std::string& hint);

  ExitStatus status() const { return status_; }
  const char* what() const noexcept override { return message_.c_str(); }

 private:
  ExitStatus status_;
  std::string message_;
};

/// `text` fit for a message: control characters become '?', the middle of long text is left out.
std::string printable(const std::string& text, std::size_t max_length = 300);

/// Runs a program's body and returns its exit status. Whatever is thrown ends as exactly one line
/// on stderr, "program: file: reason; hint".
int runMain(const char* program, const std::function<int()>& body);

}  // namespace storey::io
