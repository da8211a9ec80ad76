// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <storey/segmentation/floorplan.h>

#include <cstddef>

#include "synth/surface_sampler.h"

namespace storey::synth {

/// Errors that an ideal estimator makes on average, in the building's units.
struct AccuracyLimit {
  double vertex_to_facet = 0.0;      ///< the paper's measure: mean distance of the model's vertices
                                     ///< to the nearest true facet [Sui et al. 2016, Table 2]
  double vertex_deviation = 0.0;     ///< standard deviation of the same distances
  double corner_displacement = 0.0;  ///< mean distance of a model vertex to its true corner
};

/// The statistical limit of the accuracy of a model whose topology is known, for `points` points
/// spread evenly over the sampled faces with isotropic noise `sigma`: density r = points / area.
///
/// Walls. Each is fitted alone to its n = r A points, as an exactly vertical plane with the error
/// e(s) = a + b (s - m) at the place s along it. Least squares attains the Cramer-Rao bound:
///     var a = sigma^2 / n,     var b = sigma^2 / (n v),     independent,
/// with mean m and variance v of the place over all parts of the plane in all layers. At the end
/// of a single rectangle (s - m)^2 = 3 v, so e has the deviation 2 sigma / sqrt(n) there.
///
/// Heights. Points of walls of total length L end (or begin) at a level z0. Their heights are a
/// Poisson process of intensity lambda Phi((z0 - z) / sigma), lambda = r L, with Fisher information
///     I = integral (d intensity / d z0)^2 / intensity dz = (lambda / sigma) integral phi^2 / Phi,
/// where the last integral is 0.9032, so var z0 = sigma / (0.9032 lambda). If horizontal faces are
/// sampled, their n points at the level add n / sigma^2 to I.
///
/// The measure is not linear in these errors (it takes the nearest facet), so its mean is found by
/// drawing 400 sets of errors from these Gaussians, moving every vertex of the true model to the
/// intersection of its displaced planes, and measuring. Walls that share a direction, or a
/// building of known shape, can be found better than this: ratios below 1 are possible.
///
/// \return zeros if the building is empty, `points` is 0 or `sigma` is not positive
AccuracyLimit cramerRaoLimit(const std::vector<FloorplanLayer>& layers, std::size_t points,
                             double sigma, SampledFaces faces = SampledFaces::Walls);

}  // namespace storey::synth
