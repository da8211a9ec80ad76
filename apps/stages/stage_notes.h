// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/input_file.h"
#include "stages/stage_cloud.h"

namespace storey::stages {

/// The state as comments for a header, a key and its values each; numbers read back exactly.
std::vector<std::string> toNotes(const StageState& state);

/// The state of a file's comments; nothing if there is none in them, and so no stage wrote the
/// file. Unknown keys are passed over: a later version may have more.
/// \throws io::Failure (BadInput) for values that make no sense
std::optional<StageState> fromNotes(const std::vector<std::string>& notes,
                                    const io::InputFile& file);

}  // namespace storey::stages
