// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace storey::io {

/// An untrusted file, read once from front to back through a window of bounded size. Every
/// misfortune ends in a `Failure` that names the file: not there (66); a directory, FIFO or device,
/// empty, too large, or shorter than asked for (65); a device error or a file that shrinks while it
/// is read (74).
class InputFile {
 public:
  /// \param max_bytes largest size of the file that is accepted
  InputFile(std::string path, std::uint64_t max_bytes);
  ~InputFile();
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;

  const std::string& path() const { return path_; }
  std::uint64_t size() const { return size_; }
  std::uint64_t position() const { return position_; }
  std::uint64_t remaining() const { return size_ - position_; }

  /// The next n bytes without consuming them; fewer at the end of the file.
  std::string_view peek(std::size_t n);

  /// Consumes n bytes, which stay valid until the next call. Fails if the file has fewer.
  const unsigned char* take(std::size_t n);

  /// Consumes n bytes unseen. Fails if the file has fewer.
  void skip(std::uint64_t n);

  /// The next line without its end (LF or CR LF), valid until the next call; false at the end of
  /// the file. Fails if the line is longer than `max_length`.
  bool nextLine(std::string_view& line, std::size_t max_length);

  /// The next line of a header, within the limits of `limits.h`. Fails at the end of the file.
  std::string_view nextHeaderLine();

  /// The next line of a body that is not blank; false at the end of the file.
  bool nextBodyLine(std::string_view& line);

  /// Fails unless nothing but a line end is left.
  void expectEnd();

  [[noreturn]] void fail(const std::string& reason, const std::string& hint = kDefaultHint) const;
  [[noreturn]] void failAtLine(const std::string& reason,
                               const std::string& hint = kDefaultHint) const;
  [[noreturn]] void failAtByte(const std::string& reason,
                               const std::string& hint = kDefaultHint) const;

  /// Fails if `bytes` (what `purpose` will need) is more than `max_memory`.
  void checkMemory(std::uint64_t bytes, std::uint64_t max_memory, const std::string& purpose) const;

 private:
  static constexpr const char* kDefaultHint = "write the file again from its source";

  bool fill(std::size_t n);

  std::string path_;
  int descriptor_ = -1;
  std::uint64_t size_ = 0;
  std::uint64_t position_ = 0;   // in the file, of the window's first byte
  std::uint64_t read_ = 0;       // bytes got from the file so far
  std::uint64_t num_lines_ = 0;  // lines consumed: the number of the current line, from 1
  std::size_t header_lines_ = 0;
  std::vector<unsigned char> buffer_;
  std::size_t begin_ = 0;  // the window: [begin_, end_) of the buffer
  std::size_t end_ = 0;
};

}  // namespace storey::io
