// SPDX-License-Identifier: BSD-3-Clause
#include "view/display.h"

#include <X11/Xlib.h>  // in a file of its own: its macros are named as other people's variables
#include <X11/Xutil.h>

namespace storey::view {
namespace {

bool offersOpenGl(Display* display) {
  constexpr int kBitsPerPixel = 24;
  int opcode = 0;
  int event = 0;
  int error = 0;
  XVisualInfo visual;
  return XQueryExtension(display, "GLX", &opcode, &event, &error) != 0 &&
         XMatchVisualInfo(display, DefaultScreen(display), kBitsPerPixel, TrueColor, &visual) != 0;
}

}  // namespace

DisplayConnection::DisplayConnection() : display_(XOpenDisplay(nullptr)) {
  usable_ = display_ != nullptr && offersOpenGl(static_cast<Display*>(display_));
}

DisplayConnection::~DisplayConnection() {
  if (display_ != nullptr) XCloseDisplay(static_cast<Display*>(display_));
}

}  // namespace storey::view
