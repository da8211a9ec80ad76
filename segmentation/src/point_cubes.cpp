// SPDX-License-Identifier: BSD-3-Clause
#include <storey/filters/detail/chunks.h>
#include <storey/segmentation/detail/point_cubes.h>

namespace storey::detail {

GridCell cubeAt(const Eigen::Vector3f& position, double side) {
  const Eigen::Vector3d p = position.cast<double>();
  return {cellAlong(p.x(), side), cellAlong(p.y(), side), cellAlong(p.z(), side)};
}

PointCubes sortIntoCubes(const std::vector<OrientedPoint>& points, double side,
                         const std::function<bool(std::size_t)>& counts, unsigned int threads) {
  PointCubes cubes;
  cubes.of.assign(points.size(), PointCubes::kNone);
  // Each chunk numbers its own; one after the other they are then met in the order of the points.
  std::vector<GridCells> of_chunk(Chunks(points.size()).count());
  forEachChunk(points.size(), threads, [&](std::size_t c, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (!counts(i)) continue;
      cubes.of[i] = static_cast<std::uint32_t>(of_chunk[c].add(cubeAt(points[i].position, side)));
    }
  });
  std::vector<std::vector<std::uint32_t>> numbers(of_chunk.size());
  for (std::size_t c = 0; c < of_chunk.size(); ++c) {
    for (std::size_t cube = 0; cube < of_chunk[c].size(); ++cube) {
      numbers[c].push_back(static_cast<std::uint32_t>(cubes.cells.add(of_chunk[c][cube])));
    }
  }
  forEachChunk(points.size(), threads, [&](std::size_t c, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (cubes.of[i] != PointCubes::kNone) cubes.of[i] = numbers[c][cubes.of[i]];
    }
  });
  return cubes;
}

}  // namespace storey::detail
