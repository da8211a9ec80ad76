// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace storey::exports {

// The text files that report.html is made of, put into the program when it is built
// (CMakeLists.txt): those of the folder `page`, and three.js with its OrbitControls and
// GLTFLoader as the distribution packages them.
extern const char kPageTemplate[];
extern const char kPageStyle[];
extern const char kPageTurntable[];
extern const char kPageViewer[];
extern const char kPageTables[];
extern const char kTexturedTemplate[];
extern const char kTexturedSection[];
extern const char kTexturedViewer[];
extern const char kThree[];
extern const char kOrbitControls[];
extern const char kGltfLoader[];
extern const char kThreeLicence[];

}  // namespace storey::exports
