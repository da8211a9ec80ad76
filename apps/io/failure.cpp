// SPDX-License-Identifier: BSD-3-Clause
#include "io/failure.h"

#include <cstdio>
#include <new>

namespace storey::io {

Failure::Failure(ExitStatus status, const std::string& file, const std::string& reason,
                 const std::string& hint)
    : status_(status) {
  if (!file.empty()) message_ = printable(file) + ": ";
  message_ += printable(reason);
  if (!hint.empty()) message_ += "; " + printable(hint);
}

std::string printable(const std::string& text, std::size_t max_length) {
  std::string clean = text;
  if (clean.size() > max_length) {
    const std::size_t half = max_length / 2;
    clean = clean.substr(0, half) + "..." + clean.substr(clean.size() - half);
  }
  for (char& c : clean) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20 || byte == 0x7f) c = '?';
  }
  return clean;
}

int runMain(const char* program, const std::function<int()>& body) {
  const auto report = [program](const char* message, ExitStatus status) {
    std::fprintf(stderr, "%s: %s\n", program, message);
    return static_cast<int>(status);
  };
  try {
    return body();
  } catch (const Failure& failure) {
    return report(failure.what(), failure.status());
  } catch (const std::bad_alloc&) {
    return report("out of memory; use a smaller cloud or a larger machine", Temporary);
  } catch (const std::exception& error) {
    const std::string text = printable(error.what());
    return report(("internal error: " + text + "; please report it with the input").c_str(),
                  Internal);
  } catch (...) {
    return report("internal error; please report it with the input", Internal);
  }
}

}  // namespace storey::io
