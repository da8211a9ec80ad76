// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace storey::reconstruct {

/// Draws every stage of a reconstruction as PNG by storey_view, a program of its own: VTK's
/// rendering takes longer to load than a small building to reconstruct.
class PictureProgram {
 public:
  /// Looks for it beside the running program, then where programs are looked for.
  /// \throws io::Failure (MissingInput) if it is not there
  PictureProgram();

  /// \throws io::Failure with its exit status if it fails; what is wrong is then on stderr already
  void draw(const std::string& directory) const;

 private:
  std::string program_;
};

}  // namespace storey::reconstruct
