// SPDX-License-Identifier: BSD-3-Clause
#include "io/output_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include "io/failure.h"

namespace storey::io {
namespace {

constexpr std::size_t kBufferBytes = 1u << 18;
constexpr int kFileMode = 0666;  // less the umask

const char* hintFor(int error) {
  switch (error) {
    case ENOSPC:
    case EDQUOT:
    case EFBIG:
      return "make room or choose another directory";
    case ENOENT:
    case ENOTDIR:
      return "create its directory first";
    case EACCES:
    case EPERM:
    case EROFS:
      return "choose a directory that you may write to";
    default:
      return "check the disk";
  }
}

Failure cannotCreate(const std::string& path, int error) {
  return Failure(CannotCreate, path, std::string("cannot be created: ") + std::strerror(error),
                 hintFor(error));
}

/// The file that a link leads to: the rename must replace that file, not the link.
std::string followLinks(const std::string& path) {
  std::error_code error;
  const std::filesystem::path target = std::filesystem::canonical(path, error);
  return error ? path : target.string();
}

std::string directoryOf(const std::string& path) {
  const std::string parent = std::filesystem::path(path).parent_path().string();
  return parent.empty() ? "." : parent;
}

}  // namespace

OutputFile::OutputFile(const std::string& path) : path_(path) {
  struct stat status {};
  const bool exists = stat(path.c_str(), &status) == 0;
  if (path.empty()) throw cannotCreate(path, ENOENT);
  if (exists && S_ISDIR(status.st_mode)) throw cannotCreate(path, EISDIR);
  int flags = O_WRONLY | O_CLOEXEC;
  if (!exists || S_ISREG(status.st_mode)) {
    path_ = followLinks(path);
    temporary_ = path_ + ".tmp." + std::to_string(getpid());
    unlink(temporary_.c_str());  // left over by a killed process that had the same number
    flags |= O_CREAT | O_EXCL;
  }
  const std::string& target = temporary_.empty() ? path_ : temporary_;
  descriptor_ = open(target.c_str(), flags, kFileMode);
  if (descriptor_ < 0) throw cannotCreate(path, errno);
  buffer_.reserve(kBufferBytes);
}

OutputFile::~OutputFile() { removeTemporary(); }

void OutputFile::write(const void* data, std::size_t size) {
  if (buffer_.size() + size > kBufferBytes) flush();
  if (size > kBufferBytes) {
    writeThrough(static_cast<const char*>(data), size);
  } else {
    buffer_.append(static_cast<const char*>(data), size);
  }
}

namespace {

template <typename T>
void writeShortest(OutputFile& file, T value) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, value).ptr;
  file.write(text, static_cast<std::size_t>(end - text));
}

}  // namespace

void OutputFile::writeNumber(double value) { writeShortest(*this, value); }
void OutputFile::writeNumber(float value) { writeShortest(*this, value); }
void OutputFile::writeNumber(long long value) { writeShortest(*this, value); }

void OutputFile::commit() {
  flush();
  // A device or pipe cannot be synchronised and says EINVAL.
  if (fsync(descriptor_) != 0 && !(temporary_.empty() && errno == EINVAL)) fail("be saved");
  const int descriptor = descriptor_;
  descriptor_ = -1;
  if (close(descriptor) != 0) fail("be closed");
  if (temporary_.empty()) return;
  if (std::rename(temporary_.c_str(), path_.c_str()) != 0) fail("be given its name");
  temporary_.clear();
  // The new name must survive a power failure too; not every file system can promise that.
  const int directory = open(directoryOf(path_).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (directory < 0) return;
  fsync(directory);
  close(directory);
}

void OutputFile::flush() {
  writeThrough(buffer_.data(), buffer_.size());
  buffer_.clear();
}

void OutputFile::writeThrough(const char* data, std::size_t size) {
  while (size > 0) {
    const ssize_t written = ::write(descriptor_, data, size);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) fail("be written");
    data += written;
    size -= static_cast<std::size_t>(written);
  }
}

void OutputFile::removeTemporary() {
  if (descriptor_ >= 0) close(descriptor_);
  descriptor_ = -1;
  if (!temporary_.empty()) unlink(temporary_.c_str());
  temporary_.clear();
}

void OutputFile::fail(const std::string& action) {
  const int error = errno;
  removeTemporary();
  throw Failure(IoError, path_, "cannot " + action + ": " + std::strerror(error), hintFor(error));
}

OutputDirectory::OutputDirectory(const std::string& path) : path_(path) {
  std::error_code error;
  std::filesystem::create_directories(path, error);
  if (error) throw cannotCreate(path, error.value());
  if (!std::filesystem::is_directory(path, error)) throw cannotCreate(path, ENOTDIR);
}

}  // namespace storey::io
