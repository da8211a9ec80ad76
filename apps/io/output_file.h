// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace storey::io {

/// A file that appears under its name when it is complete, or not at all. It is written as
/// `path.tmp.<pid>` in the same directory; every write and the close are checked. Without a
/// `commit` (an exception, an early return) the temporary file is removed, and an older file of the
/// final name stays as it was. A name that is a device or a pipe (/dev/stdout) is written directly.
/// Every error is a `Failure`: cannot be created (73), disk full or device error (74).
class OutputFile {
 public:
  explicit OutputFile(const std::string& path);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  const std::string& path() const { return path_; }

  void write(const void* data, std::size_t size);
  void write(std::string_view text) { write(text.data(), text.size()); }

  /// Appends the shortest decimal number that reads back as exactly this value.
  void writeNumber(double value);
  void writeNumber(float value);
  void writeNumber(long long value);

  /// Writes what is left, makes it safe on the disk and gives the file its name.
  void commit();

 private:
  void flush();
  void writeThrough(const char* data, std::size_t size);
  void removeTemporary();
  [[noreturn]] void fail(const std::string& action);

  std::string path_;
  std::string temporary_;  // empty when the target is written directly
  int descriptor_ = -1;
  std::string buffer_;
};

/// A directory for several outputs, made with its parents if it is not there.
class OutputDirectory {
 public:
  /// \throws Failure (CannotCreate) if it cannot be made or is not a directory
  explicit OutputDirectory(const std::string& path);

  const std::string& path() const { return path_; }
  /// The path of a file in it.
  std::string file(const std::string& name) const { return path_ + "/" + name; }

 private:
  std::string path_;
};

}  // namespace storey::io
