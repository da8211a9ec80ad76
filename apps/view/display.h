// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace storey::view {

/// A connection to the X server that the environment names. To be held while VTK draws: VTK ends
/// the program if the server is of no use, and a server started for one program (xvfb-run)
/// resets itself, deaf for a moment, whenever its last connection is closed.
class DisplayConnection {
 public:
  DisplayConnection();
  ~DisplayConnection();
  DisplayConnection(const DisplayConnection&) = delete;
  DisplayConnection& operator=(const DisplayConnection&) = delete;

  /// Whether the server answered and offers OpenGL (GLX) in full colour.
  bool usable() const { return usable_; }

 private:
  void* display_;
  bool usable_ = false;
};

}  // namespace storey::view
