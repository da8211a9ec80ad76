// SPDX-License-Identifier: BSD-3-Clause
#include "view/display.h"

#include <X11/Xlib.h>  // in a file of its own: its macros are named as other people's variables

namespace storey::view {

DisplayConnection::DisplayConnection() : display_(XOpenDisplay(nullptr)) {}

DisplayConnection::~DisplayConnection() {
  if (open()) XCloseDisplay(static_cast<Display*>(display_));
}

}  // namespace storey::view
