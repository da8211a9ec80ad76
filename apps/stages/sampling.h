// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "stages/stage_cloud.h"

namespace storey::stages {

struct SamplingOptions {
  int structure_points = 0;  ///< size of the sample; 0: derived
  double noise = 0.0;        ///< of the points about their surfaces, length; 0: measured
};

/// Finds out how many of the points show all that the noise lets tell apart
/// (`NoiseLimitedSampling`). \return a line that says what was found
std::string findSampleSize(StageCloud& cloud, const SamplingOptions& options, unsigned int threads);

/// So many of the points, evenly drawn; the points themselves where these are all.
Cloud::Ptr samplePoints(const StageCloud& cloud);

/// Whether there are points besides the sample.
bool isSampled(const StageCloud& cloud);

/// A cloud of the sample alone, to find the structure in. The points must be in no groups yet.
StageCloud sampleOf(const StageCloud& cloud);

}  // namespace storey::stages
