// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "export/exported.h"

namespace storey::exports {

/// A kind of file that a model is written as.
struct Format {
  const char* name;  ///< what it is asked for by
  const char* file;  ///< its name in the directory of the results
  void (*write)(const std::string& path, const Exported& exported);
};

/// All of them.
const std::vector<Format>& allFormats();

/// The format of that name; null if there is none.
const Format* findFormat(const std::string& name);

/// The first format whose file has the extension of this one; null if there is none.
const Format* formatOfFile(const std::string& path);

}  // namespace storey::exports
