// SPDX-License-Identifier: BSD-3-Clause
// How faithful textures of generated buildings are to what the buildings were painted with. Prints
// the tables of doc/textures.md.
#include <omp.h>
#include <storey/surface/detail/texture_fill.h>

#include <cstdio>
#include <ctime>
#include <string>
#include <vector>

#include "bench/markdown.h"
#include "cli/command_line.h"
#include "synth/photos/rendered_building.h"
#include "synth/photos/texture_evaluation.h"

namespace {

using storey::bench::fixed;
using Textures = std::vector<storey::FacadeTexture>;
namespace synth = storey::synth;

double processorSeconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

Textures texturesOf(const storey::PolyhedralModel& model,
                    const std::vector<storey::FacadePhoto>& photos) {
  storey::FacadeTexturing texturing;
  texturing.setModel(model);
  texturing.setPhotos(photos);
  Textures textures;
  texturing.texture(textures);
  return textures;
}

bool areSame(const Textures& a, const Textures& b) {
  for (std::size_t f = 0; f < a.size(); ++f) {
    if (a[f].image.channels != b[f].image.channels || a[f].states != b[f].states) return false;
  }
  return a.size() == b.size();
}

double texelsOf(const Textures& textures) {
  double texels = 0.0;
  for (const storey::FacadeTexture& t : textures) texels += static_cast<double>(t.states.size());
  return texels;
}

/// Share of the area.
double seenOf(const Textures& textures) {
  double seen = 0.0;
  double all = 0.0;
  for (const storey::FacadeTexture& t : textures) {
    const double area = t.texel * t.texel;
    for (const storey::TexelState state : t.states) {
      seen += state == storey::TexelState::Seen ? area : 0.0;
      all += state == storey::TexelState::Outside ? 0.0 : area;
    }
  }
  return seen / all;
}

/// How faithful the middles of walls are when they were not seen: filled, and with the mean.
std::vector<std::string> measureFill(const synth::PhotoScene& scene, Textures textures) {
  synth::hideMiddles(scene, textures);
  Textures plain = textures;
  for (storey::FacadeTexture& t : textures) storey::detail::fillUnseen(t);
  for (storey::FacadeTexture& t : plain) synth::fillWithMean(t);
  const auto filled = storey::TexelState::Filled;
  return {fixed(synth::faithfulness(scene, textures, filled), 1),
          fixed(synth::faithfulness(scene, plain, filled), 1)};
}

/// The columns that every row has.
std::vector<std::string> measureSeen(const std::string& building, const char* windows,
                                     const synth::Rendered& rendered,
                                     const storey::PolyhedralModel& model, Textures& textures) {
  omp_set_num_threads(1);
  const double start = processorSeconds();
  textures = texturesOf(model, rendered.photos);
  const double seconds = processorSeconds() - start;
  omp_set_num_threads(2);
  const bool same = areSame(textures, texturesOf(model, rendered.photos));
  return {building,
          windows,
          std::to_string(textures.size()),
          fixed(texelsOf(textures) / 1e6, 2),
          fixed(seconds, 1),
          same ? "yes" : "no",
          fixed(100.0 * seenOf(textures), 1),
          fixed(synth::faithfulness(rendered.scene, textures), 1)};
}

void measurePainted(const std::string& building, synth::PhotoOptions options,
                    storey::bench::Table& table) {
  const synth::Rendered rendered(building.c_str(), options);
  const std::vector<storey::Camera> cameras = rendered.scene.placeCameras();
  Textures textures;
  auto row = measureSeen(building, "painted", rendered, rendered.model, textures);
  options.occluders = 0;
  const synth::Rendered bare(building.c_str(), options);
  const auto painted = synth::paintedOccluders(rendered.scene, cameras, textures,
                                               texturesOf(bare.model, bare.photos));
  row.push_back(fixed(100.0 * synth::wrongMask(bare.scene, cameras, textures), 2));
  row.push_back(fixed(100.0 * painted.share(), 2));
  for (std::string& cell : measureFill(rendered.scene, textures)) row.push_back(std::move(cell));
  table.add(row);
}

/// Of the model without windows, and of the one with them.
void measureRecessed(const std::string& building, synth::PhotoOptions options,
                     storey::bench::Table& table) {
  options.recess = 0.3;
  const synth::Rendered rendered(building.c_str(), options);
  storey::PolyhedralModel cut = rendered.model;
  synth::cutPaintedWindows(rendered.scene, options.recess, cut);
  for (const bool windowed : {false, true}) {
    Textures textures;
    auto row = measureSeen(building, windowed ? "set back, cut" : "set back", rendered,
                           windowed ? cut : rendered.model, textures);
    row.insert(row.end(), 4, "-");
    table.add(row);
  }
}

constexpr const char* kAccuracyText =
    "## Faithfulness\n\n"
    "%d photos, %d pixels wide, of each building. Windows: painted; set back by 0.3, which the "
    "model "
    "does not know; or\nset back and cut into it. Same: the same bytes from 2 threads. Seen: share "
    "of "
    "the facades. PSNR: of the seen texels.\nWrong mask: texels that are marked otherwise than "
    "rays "
    "to the cameras say. Occluders: of the texels that three photos\nsee past everything, those "
    "with "
    "something else on them. Filled: PSNR of the middle of each wall (0.3 x 0.3 of it)\nwhen it is "
    "hidden and filled from the wall's repetition; beside it, of the wall's mean colour. CPU "
    "seconds "
    "are of one\nthread.\n\n";

constexpr const char* kTimeText =
    "## Time\n\nA building of ten facades, 30 photos of 1.5 megapixels, CPU seconds of two "
    "threads together.\n\n";

void measureFaithfulness(const std::vector<std::string>& buildings,
                         const synth::PhotoOptions& options) {
  std::printf(kAccuracyText, options.views, options.width);
  storey::bench::Table table({"building", "windows", "facades", "Mtexels", "CPU s", "same",
                              "seen %", "PSNR dB", "wrong mask %", "occluders %", "filled dB",
                              "mean colour dB"});
  for (const std::string& building : buildings) {
    measurePainted(building, options, table);
    measureRecessed(building, options, table);
    std::fprintf(stderr, "%s\n", building.c_str());
  }
  table.print();
}

void measureTime() {
  synth::PhotoOptions options;
  options.views = 30;
  options.width = 1416;
  const synth::Rendered rendered("courtyard", options);
  omp_set_num_threads(2);
  const double start = processorSeconds();
  const Textures textures = texturesOf(rendered.model, rendered.photos);
  const double seconds = processorSeconds() - start;
  std::printf("%s", kTimeText);
  storey::bench::Table table({"facades", "Mtexels", "CPU s"});
  table.add(
      {std::to_string(textures.size()), fixed(texelsOf(textures) / 1e6, 1), fixed(seconds, 1)});
  table.print();
}

int run(int argc, char** argv) {
  std::vector<std::string> buildings;
  synth::PhotoOptions options;
  options.views = 20;
  options.width = 640;
  storey::cli::CommandLine line("storey_texture_accuracy", {"[BUILDING...] [options]"},
                                "How faithful textures are to what buildings were painted with. "
                                "Named buildings: those alone, without the measurement of time.");
  line.arguments("buildings", buildings, "names that storey_synth knows");
  line.whole("views", options.views, 2, "photos of each building");
  line.whole("photo-width", options.width, 16, "pixels");
  if (!line.parse(argc, argv)) return 0;
  const bool all = buildings.empty();
  if (all) buildings = {"l_shape", "courtyard", "two_towers", "hexagon", "overhang"};
  measureFaithfulness(buildings, options);
  if (all) measureTime();
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return storey::cli::runMain("storey_texture_accuracy", [&] { return run(argc, argv); });
}
