// SPDX-License-Identifier: BSD-3-Clause
// storey_reconstruct as a user runs it who asks for simpler models.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <nlohmann/json.hpp>

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

  static Outcome run(const std::string& arguments) {
    const TemporaryDirectory scratch;
    const std::string command = std::string(STOREY_RECONSTRUCT) + " " +
                                directory_->file("cloud.ply") + " -q --threads 1 -o " +
                                scratch.file("out") + " " + arguments + " >" +
                                scratch.file("stdout") + " 2>" + scratch.file("stderr");
    const int result = std::system(command.c_str());
    Outcome outcome{WIFEXITED(result) ? WEXITSTATUS(result) : -1, readAll(scratch.file("stderr")),
                    nullptr};
    if (std::filesystem::exists(scratch.file("out/report.json"))) {
      outcome.report = Json::parse(readAll(scratch.file("out/report.json")));
    }
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

TEST_F(ReconstructProgram, AModelKeepsTheLimitOfItsTypes) {
  const int types = runWell("").report["layers"]["types"].get<int>();
  ASSERT_GT(types, 1);
  const Outcome simpler = runWell("--max-types 1");
  EXPECT_EQ(simpler.report["layers"]["types"], 1);
  EXPECT_EQ(simpler.report["parameters"]["max_types"], 1);
}

}  // namespace
}  // namespace storey::test
