// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace storey::exports {

// The text files that report.html is made of, put into the program when it is built
// (CMakeLists.txt): those of the folder `page`, and three.js with its OrbitControls as the
// distribution packages them.
extern const char kPageTemplate[];
extern const char kPageStyle[];
extern const char kPageViewer[];
extern const char kPageTables[];
extern const char kThree[];
extern const char kOrbitControls[];
extern const char kThreeLicence[];

}  // namespace storey::exports
