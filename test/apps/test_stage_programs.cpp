// SPDX-License-Identifier: BSD-3-Clause
// The programs of the stages, chained in a shell as a user would, against storey_reconstruct.
#include <gtest/gtest.h>
#include <pcl/io/pcd_io.h>
#include <pcl/io/ply_io.h>
#include <sys/wait.h>

#include <cstdlib>

#include "io/cloud_reader.h"
#include "stages/stage_cloud_io.h"
#include "synth/buildings.h"
#include "synth/cloud_writer.h"
#include "synth/sampling.h"
#include "temporary_files.h"

namespace storey::test {
namespace {

constexpr std::size_t kPoints = 20000;

struct Outcome {
  int status = -1;
  std::string message;
};

/// Runs a program of ours in a directory.
Outcome run(const TemporaryDirectory& directory, const std::string& command) {
  const std::string line = "cd " + directory.path() + " && " + STOREY_BIN + "/" + command +
                           " >stdout 2>stderr </dev/null";
  const int result = std::system(line.c_str());
  return {WIFEXITED(result) ? WEXITSTATUS(result) : -1, readAll(directory.file("stderr"))};
}

void runWell(const TemporaryDirectory& directory, const std::string& command) {
  const Outcome outcome = run(directory, command);
  ASSERT_EQ(outcome.status, 0) << command << ": " << outcome.message;
}

void writeSample(const TemporaryDirectory& directory, const std::string& building,
                 const synth::SamplingOptions& sampling, bool with_normals, bool turned = false) {
  synth::SyntheticCloud cloud =
      synth::sampleBuilding(synth::makeBuilding(building).layers, sampling);
  if (turned) {
    for (Eigen::Vector3d& n : cloud.normals) n = -n;
  }
  synth::writeCloudPly(directory.file("cloud.ply"), cloud, synth::needsDouble(cloud), with_normals);
}

/// The three clouds: far from the origin, turned and tilted; without normals; a small space seen
/// from inside, with outliers.
void writeSample(const TemporaryDirectory& directory, int number) {
  synth::SamplingOptions sampling;
  sampling.points = kPoints;
  if (number == 0) {
    sampling.pose.yaw = 0.4;
    sampling.pose.tilt = 0.07;
    sampling.pose.offset = {512345.6, 5412345.6, 123.4};
    writeSample(directory, "two_towers", sampling, true);
  } else if (number == 1) {
    writeSample(directory, "courtyard", sampling, false);
  } else {
    sampling.pose.scale = 0.001;
    sampling.defects.outliers = 0.05;
    writeSample(directory, "l_shape", sampling, true, true);
  }
}

class Chains : public ::testing::TestWithParam<std::tuple<int, std::string>> {};

TEST_P(Chains, GiveTheModelsOfStoreyReconstructByteForByte) {
  const TemporaryDirectory directory;
  const auto& [sample, extension] = GetParam();
  writeSample(directory, sample);
  for (const char* const folder : {"building_files", "paper_files"}) {
    std::filesystem::create_directory(directory.file(folder));  // an OBJ names its materials' file
  }
  const auto cloud = [&, e = extension](const std::string& stage) { return stage + "." + e; };
  const auto through = [&](const std::string& program, const std::string& in,
                           const std::string& out) {
    runWell(directory, program + " " + cloud(in) + " " + cloud(out) + " -q --threads 2");
  };
  const std::string thinned = sample == 0 ? " --structure-points 15000" : "";
  runWell(directory, "storey_vertical cloud.ply " + cloud("01_upright") +
                         " -q --crs EPSG:25832 --threads 2" + thinned);
  through("storey_sampling", "01_upright", "01_sampled");
  through("storey_planar_confidence", "01_sampled", "02_confidence");
  runWell(directory, "storey_floorplans -q " + cloud("02_confidence") + " building.geojson");
  runWell(directory, "storey_layers -q " + cloud("01_upright") +
                         " building.geojson building.ply building_files/model.obj "
                         "building_fitted.geojson");
  through("storey_classes", "02_confidence", "02_classes");
  through("storey_dominant_directions", "02_classes", "03_directions");
  through("storey_slices", "03_directions", "04_slices");
  through("storey_normals", "04_slices", "05_normals");
  through("storey_labels", "05_normals", "06_labels");
  through("storey_regions", "06_labels", "07_regions");
  through("storey_positions", "07_regions", "08_refined");
  runWell(directory,
          "storey_floorplans -q --method paper " + cloud("08_refined") + " paper.geojson");
  runWell(directory, "storey_layers -q " + cloud("01_upright") +
                         " paper.geojson paper.ply paper_files/model.obj "
                         "paper_fitted.geojson");
  for (const std::string method : {"building", "paper"}) {
    runWell(directory,
            "storey_reconstruct cloud.ply -q --threads 1 --intermediate --crs "
            "EPSG:25832 --method " +
                method + " -o " + method + thinned);
    const auto same = [&](const std::string& ours, const std::string& theirs) {
      const std::string bytes = readAll(directory.file(ours));
      EXPECT_FALSE(bytes.empty()) << ours;
      EXPECT_TRUE(bytes == readAll(directory.file(method + "/" + theirs))) << ours;
    };
    same(method + ".ply", "model.ply");
    same(method + "_files/model.obj", "model.obj");
    same(method + "_files/model.mtl", "model.mtl");
    same(method + "_fitted.geojson", "floorplans.geojson");
    same(method + ".geojson", "09_floorplans.geojson");
    if (extension != "pcd") continue;
    for (const char* const stage :
         {"01_upright", "01_sampled", "02_confidence", "02_classes", "03_directions", "04_slices",
          "05_normals", "06_labels", "07_regions", "08_refined"}) {
      const bool left = std::filesystem::exists(directory.file(method + "/" + cloud(stage)));
      const bool expected = std::string(stage) == "01_sampled"
                                ? !thinned.empty()
                                : method == "paper" || std::string(stage) < "04";
      EXPECT_EQ(left, expected) << stage;
      if (left) same(cloud(stage), cloud(stage));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Clouds, Chains,
                         ::testing::Values(std::make_tuple(0, "pcd"), std::make_tuple(1, "ply"),
                                           std::make_tuple(2, "pcd")));

class StagePrograms : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    directory_ = new TemporaryDirectory;
    writeSample(*directory_, 0);
    runWell(*directory_, "storey_vertical -q cloud.ply upright.pcd --crs 'local grid'");
    runWell(*directory_, "storey_planar_confidence -q upright.pcd confidence.pcd");
    runWell(*directory_, "storey_walls -q confidence.pcd walls.pcd --segments walls.geojson");
  }
  static void TearDownTestSuite() { delete directory_; }

  static TemporaryDirectory* directory_;
};

TemporaryDirectory* StagePrograms::directory_ = nullptr;

constexpr const char* kPrograms[] = {"storey_vertical",
                                     "storey_sampling",
                                     "storey_planar_confidence",
                                     "storey_classes",
                                     "storey_dominant_directions",
                                     "storey_slices",
                                     "storey_normals",
                                     "storey_labels",
                                     "storey_regions",
                                     "storey_positions",
                                     "storey_walls",
                                     "storey_floorplans",
                                     "storey_layers"};

TEST_F(StagePrograms, ExplainThemselves) {
  for (const std::string program : kPrograms) {
    EXPECT_EQ(run(*directory_, program + " --help").status, 0) << program;
    const std::string help = readAll(directory_->file("stdout"));
    EXPECT_EQ(help.rfind("Usage: " + program + " ", 0), 0U) << help;
    EXPECT_EQ(run(*directory_, program + " --version").status, 0) << program;
  }
}

TEST_F(StagePrograms, MistakesEndInOneLineAndTheRightStatus) {
  const auto expect = [&](const std::string& command, int status, const std::string& mentions) {
    const Outcome outcome = run(*directory_, command);
    EXPECT_EQ(outcome.status, status) << command << ": " << outcome.message;
    EXPECT_EQ(outcome.message.find('\n') + 1, outcome.message.size()) << outcome.message;
    EXPECT_NE(outcome.message.find(mentions), std::string::npos) << outcome.message;
  };
  for (const std::string program : kPrograms) {
    const bool plans = program == "storey_floorplans";
    expect(program, 2, "--help");
    expect(program + " --no-such-option", 2, "--no-such-option");
    if (program == "storey_layers") continue;
    expect(program + " missing.pcd out." + (plans ? "geojson" : "pcd"), 66, "missing.pcd");
    expect(program + " upright.pcd out.xyz", 2, "out.xyz");
  }
  expect("storey_vertical cloud.ply nowhere/out.pcd", 73, "nowhere/out.pcd");
  expect("storey_planar_confidence cloud.ply o.pcd --kept-share 2", 2, "--kept-share");
  for (const char* const crs : {"25832", "EPSG:", "EPSG:0", "EPSG:x", "'a\nb'", "a\xff"}) {
    expect(std::string("storey_vertical cloud.ply o.pcd --crs ") + crs, 2, "--crs");
  }
  // Out of their order: which program is missing.
  expect("storey_normals confidence.pcd o.pcd", 65, "storey_slices");
  expect("storey_labels confidence.pcd o.pcd", 65, "storey_dominant_directions");
  expect("storey_regions confidence.pcd o.pcd", 65, "storey_labels");
  expect("storey_floorplans --method paper confidence.pcd o.geojson", 65,
         "storey_dominant_directions");
  expect("storey_layers upright.pcd walls.geojson o.ply", 65, "storey_floorplans");
  expect("storey_layers upright.pcd cloud.ply o.ply", 65, "storey_floorplans");
  EXPECT_FALSE(std::filesystem::exists(directory_->file("o.pcd")));
}

TEST_F(StagePrograms, AModelIsNotMadeOfAnotherCloudsFloorplans) {
  const TemporaryDirectory other;
  writeSample(other, 1);
  runWell(other, "storey_vertical -q cloud.ply upright.pcd");
  runWell(*directory_, "storey_floorplans -q confidence.pcd plans.geojson");
  const Outcome outcome =
      run(*directory_, "storey_layers " + other.file("upright.pcd") + " plans.geojson o.ply");
  EXPECT_EQ(outcome.status, 65);
  EXPECT_NE(outcome.message.find("another frame"), std::string::npos) << outcome.message;
}

TEST_F(StagePrograms, AnUprightCloudOfAnyProgramWillDo) {
  const TemporaryDirectory directory;
  synth::SamplingOptions sampling;
  sampling.points = kPoints;
  writeSample(directory, "l_shape", sampling, true);
  runWell(directory, "storey_floorplans -q cloud.ply plans.geojson");
  runWell(directory, "storey_layers -q cloud.ply plans.geojson model.ply");
  EXPECT_TRUE(std::filesystem::exists(directory.file("model.ply")));
}

// The frame in the header takes the upright points back to where they came from.
TEST_F(StagePrograms, TheFrameLeadsBackToTheInput) {
  const io::LoadedCloud before = io::readCloud(directory_->file("cloud.ply"));
  const stages::StageCloud after = stages::readStageCloud(directory_->file("upright.pcd"));
  EXPECT_EQ(after.state.crs, "local grid");
  ASSERT_EQ(after.points->size(), before.cloud->size());
  const double rounding = 100.0 * 1e-6;  // coordinates below 100 in float, turned once
  for (std::size_t i = 0; i < after.points->size(); ++i) {
    const Eigen::Vector3d there =
        (*before.cloud)[i].getVector3fMap().cast<double>() + before.offset;
    const Eigen::Vector3d here =
        after.state.frame_to_input * (*after.points)[i].getVector3fMap().cast<double>();
    ASSERT_LT((here - there).norm(), rounding) << i;
  }
}

TEST_F(StagePrograms, TheirFilesAreReadByPcl) {
  const stages::StageCloud cloud = stages::readStageCloud(directory_->file("walls.pcd"));
  runWell(*directory_, "storey_walls -q confidence.pcd walls.ply");
  const std::string pcd = directory_->file("walls.pcd");
  const std::string ply = directory_->file("walls.ply");
  pcl::PointCloud<pcl::PointXYZLNormal> labelled[2];
  ASSERT_EQ(pcl::io::loadPCDFile(pcd, labelled[0]), 0);
  ASSERT_EQ(pcl::io::loadPLYFile(ply, labelled[1]), 0);
  pcl::PointCloud<pcl::PointXYZINormal> confident[2];
  ASSERT_EQ(pcl::io::loadPCDFile(pcd, confident[0]), 0);
  ASSERT_EQ(pcl::io::loadPLYFile(ply, confident[1]), 0);
  for (int format = 0; format < 2; ++format) {
    ASSERT_EQ(labelled[format].size(), cloud.points->size());
    for (std::size_t i = 0; i < cloud.points->size(); ++i) {
      const auto& p = labelled[format][i];
      ASSERT_EQ(p.getVector3fMap(), (*cloud.points)[i].getVector3fMap());
      ASSERT_EQ(p.getNormalVector3fMap(), (*cloud.points)[i].getNormalVector3fMap());
      ASSERT_EQ(static_cast<int>(p.label), cloud.groups(stages::Wall)[i] + 1);
      ASSERT_EQ(confident[format][i].intensity, cloud.confidences[i]);
    }
  }
}

// Whatever a comment of ours is changed to, the file is refused, or read with another value.
TEST_F(StagePrograms, CommentsThatMakeNoSenseAreRefused) {
  const std::string good = readAll(directory_->file("confidence.pcd"));
  const auto changed = [&](const std::string& key, const std::string& value) {
    const std::size_t start = good.find("# storey " + key);
    EXPECT_NE(start, std::string::npos) << key;
    const std::size_t end = good.find('\n', start);
    directory_->write("odd.pcd",
                      good.substr(0, start) + "# storey " + key + " " + value + good.substr(end));
    return run(*directory_, "storey_slices -q odd.pcd sliced.pcd");
  };
  for (const auto& [key, value] : std::vector<std::pair<std::string, std::string>>{
           {"noise", "-1"},
           {"noise", "nan"},
           {"noise", "1 2"},
           {"noise", ""},
           {"density", "inf"},
           {"sample_size", "0.5"},
           {"sample_size", "1e300"},
           {"crs", "EPSG:x"},
           {"planar_threshold", "much"},
           {"frame_to_input", "1 0 0 0"},
           {"frame_to_input", "2 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1"},
           {"frame_to_input", "1 0 0 0 0 1 0 0 0 0 -1 0 0 0 0 1"}}) {
    const Outcome outcome = changed(key, value);
    EXPECT_EQ(outcome.status, 65) << key << " " << value << outcome.message;
    EXPECT_NE(outcome.message.find("storey " + key), std::string::npos) << outcome.message;
  }
  EXPECT_EQ(changed("noise", "0.5").status, 0);
}

}  // namespace
}  // namespace storey::test
