// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace storey::view {

/// A connection to the X server that the environment names. To be held while VTK draws: VTK ends
/// the program if the server does not answer, and a server started for one program (xvfb-run)
/// resets itself, deaf for a moment, whenever its last connection is closed.
class DisplayConnection {
 public:
  DisplayConnection();
  ~DisplayConnection();
  DisplayConnection(const DisplayConnection&) = delete;
  DisplayConnection& operator=(const DisplayConnection&) = delete;

  bool open() const { return display_ != nullptr; }

 private:
  void* display_;
};

}  // namespace storey::view
