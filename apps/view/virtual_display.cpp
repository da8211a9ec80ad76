// SPDX-License-Identifier: BSD-3-Clause
#include "view/virtual_display.h"

#include <unistd.h>

#include <cstdlib>
#include <string>
#include <vector>

namespace storey::view {

void restartOnVirtualDisplay(char** argv) {
  const char* const display = std::getenv("DISPLAY");
  if (display != nullptr && *display != '\0') return;
  // -noreset: a server that starts anew when its last client leaves signals xvfb-run in the midst
  // of its cleaning up, which then fails although the program did not.
  // Some versions of xvfb-run send stderr to stdout: a shell within sends it back.
  const int stderr_copy = dup(STDERR_FILENO);
  std::string words[] = {"xvfb-run",
                         "-a",
                         "-s",
                         "-screen 0 1600x1200x24 -noreset",
                         "sh",
                         "-c",
                         "exec \"$@\" 2>&" + std::to_string(stderr_copy),
                         "sh"};
  std::vector<char*> command;
  for (std::string& word : words) command.push_back(word.data());
  for (; *argv != nullptr; ++argv) command.push_back(*argv);
  command.push_back(nullptr);
  execvp(command[0], command.data());  // returns if there is no xvfb-run
  close(stderr_copy);
}

}  // namespace storey::view
