// SPDX-License-Identifier: BSD-3-Clause
// How faithful textures of generated buildings are to what the buildings were painted with. Prints
// the tables of doc/textures.md.
#include <omp.h>
#include <storey/surface/detail/texture_fill.h>

#include <array>
#include <chrono>
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

Textures texturesOf(const synth::Rendered& rendered) {
  storey::FacadeTexturing texturing;
  texturing.setModel(rendered.model);
  texturing.setPhotos(rendered.photos);
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

double seenOf(const Textures& textures) {
  double seen = 0.0;
  double all = 0.0;
  for (const storey::FacadeTexture& t : textures) {
    for (const storey::TexelState state : t.states) {
      seen += state == storey::TexelState::Seen ? 1.0 : 0.0;
      all += state == storey::TexelState::Outside ? 0.0 : 1.0;
    }
  }
  return seen / all;
}

/// Gives what is unseen the mean of what was seen: what any filling must be better than.
void fillWithMean(storey::FacadeTexture& t) {
  std::array<double, 3> sum{};
  double count = 0.0;
  for (std::size_t i = 0; i < t.states.size(); ++i) {
    if (t.states[i] != storey::TexelState::Seen) continue;
    for (std::size_t c = 0; c < 3; ++c) sum[c] += t.image.channels[3 * i + c];
    count += 1.0;
  }
  for (std::size_t i = 0; count > 0.0 && i < t.states.size(); ++i) {
    if (t.states[i] != storey::TexelState::Unseen) continue;
    t.states[i] = storey::TexelState::Filled;
    for (std::size_t c = 0; c < 3; ++c) {
      t.image.channels[3 * i + c] = static_cast<std::uint8_t>(sum[c] / count);
    }
  }
}

/// How faithful the middles of walls are when they were not seen: filled, and with the mean.
std::vector<std::string> measureFill(const synth::PhotoScene& scene, Textures textures) {
  synth::hideMiddles(scene, textures);
  Textures plain = textures;
  for (storey::FacadeTexture& t : textures) storey::detail::fillUnseen(t);
  for (storey::FacadeTexture& t : plain) fillWithMean(t);
  const auto filled = storey::TexelState::Filled;
  return {fixed(synth::faithfulness(scene, textures, filled), 1),
          fixed(synth::faithfulness(scene, plain, filled), 1)};
}

std::vector<std::string> measure(const std::string& building, synth::PhotoOptions options) {
  const synth::Rendered rendered(building.c_str(), options);
  const std::vector<storey::Camera> cameras = rendered.scene.placeCameras();
  omp_set_num_threads(1);
  const double start = processorSeconds();
  const Textures textures = texturesOf(rendered);
  const double seconds = processorSeconds() - start;
  omp_set_num_threads(2);
  const bool same = areSame(textures, texturesOf(rendered));
  options.occluders = 0;
  const synth::Rendered bare(building.c_str(), options);
  const auto painted = synth::paintedOccluders(rendered.scene, cameras, textures, texturesOf(bare));
  std::vector<std::string> row = {building,
                                  fixed(options.recess, 1),
                                  fixed(100.0 * seenOf(textures), 1),
                                  fixed(synth::faithfulness(rendered.scene, textures), 1),
                                  fixed(100.0 * synth::wrongMask(bare.scene, cameras, textures), 2),
                                  fixed(100.0 * painted.share(), 2)};
  for (std::string& cell : measureFill(rendered.scene, textures)) row.push_back(std::move(cell));
  row.push_back(fixed(texelsOf(textures) / 1e6, 2));
  row.push_back(fixed(seconds, 1));
  row.emplace_back(same ? "yes" : "no");
  return row;
}

constexpr const char* kAccuracyText =
    "## Faithfulness\n\n"
    "%d photos of %d pixels' width of each building, with poles, trees and cars in front, "
    "exposures "
    "from 0.8 to 1.25 and noise of 2 grey levels; windows painted, or set back by 0.3 in photos of "
    "a model that knows nothing of it. Seen: share of the facades. PSNR: of the seen texels, in "
    "dB. "
    "Wrong mask: texels whose mark is not what rays to the cameras say. Occluders: of the texels "
    "that "
    "three photos see past everything, those with something else on them. Filled: PSNR of the "
    "middle "
    "of each wall (0.3 x 0.3 of it) when it is hidden and filled, beside that of the wall's mean "
    "colour. CPU seconds of one thread.\n\n";

constexpr const char* kTimeText =
    "## Time\n\nA building of ten facades, 30 photos of 1.5 megapixels, two threads.\n\n";

void measureFaithfulness(const std::vector<std::string>& buildings, synth::PhotoOptions options) {
  std::printf(kAccuracyText, options.views, options.width);
  storey::bench::Table table({"building", "depth", "seen %", "PSNR", "wrong mask %", "occluders %",
                              "filled", "mean colour", "Mtexels", "CPU s", "same by 2 threads"});
  for (const std::string& building : buildings) {
    for (const double recess : {0.0, 0.3}) {
      options.recess = recess;
      table.add(measure(building, options));
      std::fprintf(stderr, "%s %.1f\n", building.c_str(), recess);
    }
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
  const auto begin = std::chrono::steady_clock::now();
  const Textures textures = texturesOf(rendered);
  const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - begin;
  std::printf("%s", kTimeText);
  storey::bench::Table table({"facades", "Mtexels", "seconds", "CPU s"});
  table.add({std::to_string(textures.size()), fixed(texelsOf(textures) / 1e6, 1),
             fixed(passed.count(), 1), fixed(processorSeconds() - start, 1)});
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
