// SPDX-License-Identifier: BSD-3-Clause
// storey_reconstruct as a user runs it who asks for simpler models.
#include <gtest/gtest.h>
#include <pcl/io/pcd_io.h>
#include <pcl/point_types.h>
#include <sys/wait.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <numeric>
#include <set>

#include "synth/buildings.h"
#include "synth/cloud_writer.h"
#include "synth/sampling.h"
#include "temporary_files.h"

namespace storey::test {
namespace {

using Json = nlohmann::json;

struct Outcome {
  int status = -1;
  std::string message;
  Json report;  // null if there is none
  std::set<std::string> files;
  pcl::PointCloud<pcl::PointXYZRGBNormal> explained;  // of --intermediate
};

// Two towers on a podium, in a file that all tests read.
class ReconstructProgram : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    directory_ = new TemporaryDirectory;
    synth::SamplingOptions options;
    options.points = 20000;
    const synth::SyntheticCloud cloud =
        synth::sampleBuilding(synth::makeBuilding("two_towers").layers, options);
    synth::writeCloudPly(directory_->file("cloud.ply"), cloud, synth::needsDouble(cloud), true);
  }
  static void TearDownTestSuite() { delete directory_; }

  static Outcome run(const std::string& arguments, const std::string& prefix = "") {
    const TemporaryDirectory scratch;
    const std::string command = prefix + std::string(STOREY_RECONSTRUCT) + " " +
                                directory_->file("cloud.ply") + " -q -o " + scratch.file("out") +
                                " " + arguments + " >" + scratch.file("stdout") + " 2>" +
                                scratch.file("stderr");
    const int result = std::system(command.c_str());
    Outcome outcome{
        WIFEXITED(result) ? WEXITSTATUS(result) : -1, readAll(scratch.file("stderr")), {}, {}, {}};
    if (std::filesystem::exists(scratch.file("out"))) {
      for (const auto& entry : std::filesystem::directory_iterator(scratch.file("out"))) {
        if (entry.file_size() > 0) outcome.files.insert(entry.path().filename().string());
      }
    }
    if (std::filesystem::exists(scratch.file("out/report.json"))) {
      outcome.report = Json::parse(readAll(scratch.file("out/report.json")));
    }
    const std::string explained = scratch.file("out/11_points.pcd");
    if (std::filesystem::exists(explained)) pcl::io::loadPCDFile(explained, outcome.explained);
    return outcome;
  }

  static Outcome runWell(const std::string& arguments) {
    Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.status, 0) << arguments << ": " << outcome.message;
    EXPECT_TRUE(outcome.report["model"]["valid"].get<bool>()) << arguments;
    return outcome;
  }

 private:
  static TemporaryDirectory* directory_;
};

TemporaryDirectory* ReconstructProgram::directory_ = nullptr;

int polygonsOf(const Outcome& outcome) { return outcome.report["model"]["polygons"].get<int>(); }

TEST_F(ReconstructProgram, WrongLimitsGiveOneLineAndStatus2) {
  for (const char* const arguments :
       {"--max-faces -1", "--max-types -1", "--max-faces=-20", "--max-faces 6.5",
        "--max-types many", "--max-faces", "--max-faces 99999999999999999999", "--trade-off=yes",
        "--max-face 6"}) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.status, 2) << arguments;
    EXPECT_EQ(outcome.message.find('\n') + 1, outcome.message.size()) << outcome.message;
    EXPECT_TRUE(outcome.report.is_null()) << arguments;
  }
}

TEST_F(ReconstructProgram, OptionsThatTheMethodIgnoresGiveOneLineAndStatus2) {
  for (const char* const arguments :
       {"--slice-thickness 1", "--linking greedy", "--smoothness 1", "--label-cost 1",
        "--encoding turns", "--expansion", "--method paper --min-wall-area 1",
        "--method paper --block-cost 1", "--method paper --trade-off"}) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.status, 2) << arguments;
    EXPECT_NE(outcome.message.find("goes with --method"), std::string::npos) << outcome.message;
    EXPECT_TRUE(outcome.report.is_null()) << arguments;
  }
}

TEST_F(ReconstructProgram, NumbersThatDoNotFitTheCloudAreNamed) {
  for (const char* const option : {"--noise", "--grid"}) {
    const Outcome outcome = run(option + std::string(" 1e-30"));
    EXPECT_EQ(outcome.status, 65) << option;
    EXPECT_NE(outcome.message.find(option), std::string::npos) << outcome.message;
  }
}

TEST_F(ReconstructProgram, ASampleWithTooFewPointsIsNamed) {
  for (const char* const option : {"--structure-points", "--max-points"}) {
    const Outcome outcome = run(option + std::string(" 20"));
    EXPECT_EQ(outcome.status, 65) << option;
    EXPECT_NE(outcome.message.find(option), std::string::npos) << outcome.message;
  }
}

TEST_F(ReconstructProgram, WritesWhatIsAskedForAndNoMore) {
  using Names = std::set<std::string>;
  EXPECT_EQ(runWell("").files, (Names{"model.ply", "model.obj", "model.mtl", "floorplans.geojson",
                                      "report.html", "report.json"}));
  EXPECT_EQ(runWell("--formats ply").files, (Names{"model.ply", "report.json"}));
  EXPECT_EQ(runWell("--formats cityjson,gltf,stl,vtk,svg,dxf --crs EPSG:7415").files,
            (Names{"model.city.json", "model.glb", "model.stl", "model.vtk", "floorplans.svg",
                   "floorplans.dxf", "report.json"}));
}

TEST_F(ReconstructProgram, MoreThreadsThanAnyMachineHasGiveTheSameModel) {
  const Outcome one = runWell("--threads 1");
  const Outcome many = runWell("--threads 1000000000");
  EXPECT_EQ(many.report["walls"], one.report["walls"]);
  EXPECT_EQ(many.report["levels"], one.report["levels"]);
}

TEST_F(ReconstructProgram, PicturesOfAllStagesAreDrawn) {
  if (std::system("command -v xvfb-run >/dev/null") != 0) GTEST_SKIP() << "no xvfb-run";
  const Outcome outcome = runWell("--pictures --formats ply,geojson");
  for (const char* const name :
       {"01_upright", "02_confidence", "02_classes", "03_directions", "09_walls", "09_cells",
        "09_floorplans", "10_types", "11_model", "11_support", "12_overlay"}) {
    EXPECT_EQ(outcome.files.count(name + std::string(".png")), 1u) << name;
  }
  EXPECT_EQ(outcome.files.count("04_slices.png"), 0u);  // of the paper's chain only
}

TEST_F(ReconstructProgram, TheModelIsThereThoughItsPicturesAreNot) {
  const Outcome outcome = run("--pictures --formats ply", "env -u DISPLAY PATH=/nonexistent ");
  EXPECT_EQ(outcome.status, 75);
  EXPECT_NE(outcome.message.find("no display"), std::string::npos) << outcome.message;
  EXPECT_EQ(outcome.message.find('\n') + 1, outcome.message.size()) << outcome.message;
  EXPECT_EQ(outcome.files.count("model.ply"), 1u);
  EXPECT_TRUE(outcome.report["model"]["valid"].get<bool>());
}

TEST_F(ReconstructProgram, WrongFormatsGiveOneLineAndStatus2) {
  for (const char* const arguments :
       {"--formats ply,obi", "--formats ply,,obj", "--formats PLY", "--crs 7415",
        "--crs EPSG:", "--crs EPSG:x", "--crs EPSG:-1", "--crs EPSG:0", "--crs EPSG:12x"}) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.status, 2) << arguments;
    EXPECT_EQ(outcome.message.find('\n') + 1, outcome.message.size()) << outcome.message;
    EXPECT_TRUE(outcome.files.empty()) << arguments;
  }
}

TEST_F(ReconstructProgram, TheReportCountsThePointsByTheirDistance) {
  const Json residuals = runWell("").report["residuals"];
  const auto counts = residuals["counts"].get<std::vector<double>>();
  const double points = residuals["points"].get<double>();
  EXPECT_EQ(points, 20000);
  EXPECT_EQ(std::accumulate(counts.begin(), counts.end(), residuals["beyond"].get<double>()),
            points);
  // Four bins are one deviation, and 68.3 % of a normal distribution are within. A noise that is
  // measured wrong by 5 % moves that by 0.05 x 2 x 0.242.
  const double within = counts[0] + counts[1] + counts[2] + counts[3];
  EXPECT_NEAR(within / points, 0.683, 0.024);
}

// The cloud's noise is 0.1, its normals are turned by 15 degrees about any axis across them: by
// 15 / sqrt(2) in plan.
TEST_F(ReconstructProgram, TheReportTellsHowSureItsScalesAre) {
  const Json report = runWell("").report;
  const Json& scale = report["scale"];
  const double deviation = scale["measured_noise_deviation"].get<double>();
  EXPECT_GT(deviation, 0.0);
  EXPECT_NEAR(scale["measured_noise"].get<double>(), 0.1, 0.002 + 3.0 * deviation);
  EXPECT_GT(scale["measured_noise_share"].get<double>(), 0.25);
  for (const Json& direction : report["directions"]) {
    EXPECT_NEAR(direction["spread_deg"].get<double>(), 15.0 / std::sqrt(2.0), 1.0);
  }
}

TEST_F(ReconstructProgram, TheTradeOffLeadsFromTheModelToSimplerOnes) {
  const Outcome plain = runWell("");
  const Outcome outcome = runWell("--trade-off");
  const Json& front = outcome.report["building"]["trade_off"];
  ASSERT_GT(front.size(), 1U);
  for (std::size_t i = 0; i + 1 < front.size(); ++i) {
    EXPECT_GT(front[i]["faces"], front[i + 1]["faces"]);
    EXPECT_LT(front[i]["face_cost"], front[i + 1]["face_cost"]);
    EXPECT_LE(front[i]["energy"].get<double>(), front[i + 1]["energy"].get<double>());
  }
  EXPECT_GE(front.back()["faces"], 6);
  // Without being asked there is only the model itself, which the question does not change.
  ASSERT_EQ(plain.report["building"]["trade_off"].size(), 1U);
  EXPECT_EQ(plain.report["building"]["trade_off"][0], front[0]);
  EXPECT_EQ(plain.report["model"], outcome.report["model"]);
}

// The colours are those of the share that the report says is within three deviations.
TEST_F(ReconstructProgram, PointsAreColouredByTheirDistanceFromTheModel) {
  const Outcome outcome = runWell("--intermediate");
  const pcl::PointCloud<pcl::PointXYZRGBNormal>& points = outcome.explained;
  ASSERT_EQ(points.size(), outcome.report["input"]["structure_points"].get<std::size_t>());
  const auto green =
      std::count_if(points.begin(), points.end(), [](const auto& p) { return p.r < 100; });
  const Json& residuals = outcome.report["residuals"];
  double within = 0.0;
  for (std::size_t k = 0; k < 12; ++k) within += residuals["counts"][k].get<double>();
  EXPECT_NEAR(static_cast<double>(green) / static_cast<double>(points.size()),
              within / residuals["points"].get<double>(), 0.005);
}

TEST_F(ReconstructProgram, AModelKeepsTheLimitOfItsFaces) {
  const Outcome plain = runWell("");
  const int all = polygonsOf(plain);
  EXPECT_EQ(runWell("--max-faces " + std::to_string(all)).report["model"], plain.report["model"]);
  const Outcome simpler = runWell("--max-faces " + std::to_string(all - 1));
  EXPECT_LT(polygonsOf(simpler), all);
  EXPECT_EQ(simpler.report["parameters"]["max_faces"], all - 1);
  const Json& front = simpler.report["building"]["trade_off"];
  EXPECT_LE(front.back()["faces"], all - 1);
}

TEST_F(ReconstructProgram, AModelOfSlicesKeepsTheLimitOfItsFaces) {
  const Outcome plain = runWell("--method paper");
  const int all = polygonsOf(plain);
  const int types = plain.report["layers"]["types"].get<int>();
  ASSERT_GT(types, 1);
  EXPECT_EQ(runWell("--method paper --max-faces " + std::to_string(all)).report["model"],
            plain.report["model"]);
  const Outcome simpler = runWell("--method paper --max-faces " + std::to_string(all - 1));
  EXPECT_LT(polygonsOf(simpler), all);
  EXPECT_LT(simpler.report["layers"]["types"], types);
  // The front tells it beforehand: fewer types, fewer polygons.
  const Json& front = plain.report["layers"]["trade_off"];
  EXPECT_EQ(simpler.report["layers"]["trade_off"], front);
  for (const Json& point : front) {
    if (point["types"] < types) {
      EXPECT_LT(point["faces"], all);
    } else if (point["types"] == types) {
      EXPECT_EQ(point["faces"], all);
    }
  }
}

TEST_F(ReconstructProgram, AModelKeepsTheLimitOfItsTypes) {
  const int types = runWell("").report["layers"]["types"].get<int>();
  ASSERT_GT(types, 1);
  const Outcome simpler = runWell("--max-types 1");
  EXPECT_EQ(simpler.report["layers"]["types"], 1);
  EXPECT_EQ(simpler.report["parameters"]["max_types"], 1);
}

}  // namespace
}  // namespace storey::test
