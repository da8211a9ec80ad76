// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>

#include "io/input_file.h"

namespace storey::view {

/// Reads a JSON file and hands it to `extract`; whatever that does not find in it is a Failure.
/// \param extract may throw what JSON throws, or std::invalid_argument with a reason
/// \throws io::Failure (BadInput, MissingInput, IoError)
template <typename Extract>
void readJson(const std::string& path, const Extract& extract) {
  constexpr std::uint64_t kMaxBytes = std::uint64_t{1} << 28;  // these files have kilobytes
  io::InputFile file(path, kMaxBytes);
  const auto size = static_cast<std::size_t>(file.size());
  const auto fail = [&](const std::exception& error) {
    file.fail("is not what storey_reconstruct writes: " + std::string(error.what()),
              "run storey_reconstruct again");
  };
  try {
    const unsigned char* const text = file.take(size);
    extract(nlohmann::json::parse(text, text + size));
  } catch (const nlohmann::json::exception& error) {
    fail(error);
  } catch (const std::invalid_argument& error) {
    fail(error);
  }
}

}  // namespace storey::view
