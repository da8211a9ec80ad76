// SPDX-License-Identifier: BSD-3-Clause
#include "io/input_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <utility>

#include "io/failure.h"
#include "io/limits.h"

namespace storey::io {
namespace {

constexpr std::size_t kChunkBytes = 1u << 20;  // of one read(2)

const char* kindOf(mode_t mode) {
  if (S_ISDIR(mode)) return "a directory";
  if (S_ISFIFO(mode)) return "a pipe";
  if (S_ISSOCK(mode)) return "a socket";
  return "a device";
}

bool isBlank(std::string_view text) {
  return text.find_first_not_of(" \t\r\n\v\f") == std::string_view::npos;
}

}  // namespace

std::uint64_t defaultMaxMemory() {
  const long pages = sysconf(_SC_PHYS_PAGES);
  const long page_bytes = sysconf(_SC_PAGESIZE);
  if (pages <= 0 || page_bytes <= 0) return std::uint64_t{4} << 30;
  return static_cast<std::uint64_t>(pages) * static_cast<std::uint64_t>(page_bytes) / 4 * 3;
}

std::uint64_t availableMemory() {
  std::ifstream memory("/proc/meminfo");
  for (std::string line; std::getline(memory, line);) {
    constexpr std::string_view kName = "MemAvailable:";
    if (line.compare(0, kName.size(), kName) == 0) {
      return std::strtoull(line.c_str() + kName.size(), nullptr, 10) * 1024;
    }
  }
  return defaultMaxMemory();
}

InputFile::InputFile(std::string path, std::uint64_t max_bytes) : path_(std::move(path)) {
  // O_NONBLOCK: opening a FIFO that nobody writes to must not wait.
  descriptor_ = open(path_.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  if (descriptor_ < 0) {
    const int error = errno;
    throw Failure(MissingInput, path_, std::string("cannot be opened: ") + std::strerror(error),
                  error == ENOENT ? "check the path" : "check its permissions");
  }
  struct stat status {};
  const bool known = fstat(descriptor_, &status) == 0;
  const auto refuse = [this](ExitStatus code, const std::string& reason, const char* hint) {
    close(descriptor_);
    throw Failure(code, path_, reason, hint);
  };
  if (!known) refuse(IoError, "its size cannot be found out", "check the disk");
  if (!S_ISREG(status.st_mode)) {
    refuse(BadInput, std::string("is ") + kindOf(status.st_mode) + ", not a file", "name a file");
  }
  size_ = static_cast<std::uint64_t>(status.st_size);
  if (size_ == 0) refuse(BadInput, "is empty", "write the file again from its source");
  if (size_ > max_bytes) {
    refuse(BadInput,
           "has " + std::to_string(size_) + " bytes, the limit is " + std::to_string(max_bytes),
           "raise the limit, or cut the building out of the cloud");
  }
}

InputFile::~InputFile() { close(descriptor_); }

bool InputFile::fill(std::size_t n) {
  while (end_ - begin_ < n && read_ < size_) {
    if (begin_ > 0) {
      std::memmove(buffer_.data(), buffer_.data() + begin_, end_ - begin_);
      end_ -= begin_;
      begin_ = 0;
    }
    if (buffer_.empty()) buffer_.resize(std::min<std::uint64_t>(kChunkBytes, size_));
    if (buffer_.size() < n) buffer_.resize(std::max(n, 2 * buffer_.size()));
    const std::uint64_t room = std::min<std::uint64_t>(buffer_.size() - end_, size_ - read_);
    const ssize_t got = ::read(descriptor_, buffer_.data() + end_, static_cast<std::size_t>(room));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) {
      throw Failure(IoError, path_, std::string("cannot be read: ") + std::strerror(errno),
                    "check the disk");
    }
    if (got == 0) {
      throw Failure(IoError, path_, "became shorter while it was read",
                    "wait until its writer has finished");
    }
    end_ += static_cast<std::size_t>(got);
    read_ += static_cast<std::uint64_t>(got);
  }
  return end_ - begin_ >= n;
}

std::string_view InputFile::peek(std::size_t n) {
  fill(n);
  return {reinterpret_cast<const char*>(buffer_.data() + begin_), std::min(n, end_ - begin_)};
}

const unsigned char* InputFile::take(std::size_t n) {
  if (n > remaining()) {
    failAtByte("ends early: " + std::to_string(n) + " bytes expected, " +
               std::to_string(remaining()) + " left");
  }
  fill(n);
  const unsigned char* const bytes = buffer_.data() + begin_;
  begin_ += n;
  position_ += n;
  return bytes;
}

void InputFile::skip(std::uint64_t n) {
  while (n > 0) {
    const auto step = static_cast<std::size_t>(std::min<std::uint64_t>(n, kChunkBytes));
    take(step);
    n -= step;
  }
}

bool InputFile::nextLine(std::string_view& line, std::size_t max_length) {
  std::size_t searched = 0;
  const void* found = nullptr;
  while (found == nullptr && fill(searched + 1)) {
    const std::size_t available = end_ - begin_;
    found = std::memchr(buffer_.data() + begin_ + searched, '\n', available - searched);
    searched = available;
    if (found == nullptr && searched > max_length) break;
  }
  if (searched == 0) return false;
  const unsigned char* const first = buffer_.data() + begin_;
  const std::size_t length =
      found == nullptr ? searched
                       : static_cast<std::size_t>(static_cast<const unsigned char*>(found) - first);
  ++num_lines_;
  if (length > max_length) {
    failAtLine("is longer than " + std::to_string(max_length) + " bytes");
  }
  line = {reinterpret_cast<const char*>(first), length};
  const std::size_t consumed = length + (found == nullptr ? 0 : 1);
  begin_ += consumed;
  position_ += consumed;
  if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
  return true;
}

std::string_view InputFile::nextHeaderLine() {
  std::string_view line;
  if (++header_lines_ > kMaxHeaderLines) {
    fail("its header has more than " + std::to_string(kMaxHeaderLines) + " lines");
  }
  if (!nextLine(line, kMaxHeaderLineBytes)) fail("ends within its header");
  if (position_ > kMaxHeaderBytes) {
    fail("its header is longer than " + std::to_string(kMaxHeaderBytes) + " bytes");
  }
  return line;
}

bool InputFile::nextBodyLine(std::string_view& line) {
  while (nextLine(line, kMaxBodyLineBytes)) {
    if (!isBlank(line)) return true;
  }
  return false;
}

void InputFile::expectEnd() {
  if (remaining() <= kMaxTrailingBytes && isBlank(peek(kMaxTrailingBytes))) return;
  failAtByte(std::to_string(remaining()) + " bytes more than the header declares");
}

void InputFile::fail(const std::string& reason, const std::string& hint) const {
  throw Failure(BadInput, path_, reason, hint);
}

void InputFile::failAtLine(const std::string& reason, const std::string& hint) const {
  fail("line " + std::to_string(num_lines_) + ": " + reason, hint);
}

void InputFile::failAtByte(const std::string& reason, const std::string& hint) const {
  fail("byte " + std::to_string(position_) + ": " + reason, hint);
}

void InputFile::checkMemory(std::uint64_t bytes, std::uint64_t max_memory,
                            const std::string& purpose) const {
  if (bytes <= max_memory) return;
  fail(purpose + " need " + std::to_string(bytes) + " bytes of memory, the limit is " +
           std::to_string(max_memory),
       "thin the cloud out (storey_reconstruct --max-points), or take a larger machine");
}

}  // namespace storey::io
