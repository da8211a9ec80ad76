// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "cli/command_line.h"
#include "io/failure.h"

namespace storey::cli {
namespace {

enum class Colour { Red, Green };

struct Values {
  std::string input;
  std::vector<std::string> rest;
  std::string name;
  double length = 0.5;
  double share = 0.85;
  int count = 3;
  unsigned int threads = 0;
  Eigen::Vector3d up = Eigen::Vector3d::Zero();
  Colour colour = Colour::Green;
  bool quiet = false;
};

struct Parsed {
  Values values;
  bool go_on = false;
  bool length_given = false;
  std::string printed;
  std::string failure;
};

Parsed parse(std::vector<std::string> words) {
  Parsed parsed;
  Values& v = parsed.values;
  CommandLine line("prog", {"INPUT [options]", "--list"}, "Does something.");
  line.argument("input", v.input, "the cloud");
  line.arguments("rest", v.rest, "more");
  line.text("name", v.name, "a name");
  line.number("length,l", v.length, kNonNegative, "a length");
  line.number("share", v.share, kPositiveShare, "a share");
  line.whole("count", v.count, 0, "a number");
  line.vector("up", v.up, "a direction");
  line.choice<Colour>("colour", v.colour, {{"red", Colour::Red}, {"green", Colour::Green}}, "a");
  line.flag("quiet,q", v.quiet, "say nothing");
  line.threads(v.threads);
  words.insert(words.begin(), "prog");
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  testing::internal::CaptureStdout();
  try {
    parsed.go_on = line.parse(static_cast<int>(arguments.size()), arguments.data());
    parsed.length_given = line.given("length");
  } catch (const io::Failure& failure) {
    EXPECT_EQ(failure.status(), io::Usage);
    parsed.failure = failure.what();
  }
  parsed.printed = testing::internal::GetCapturedStdout();
  return parsed;
}

TEST(CommandLine, LeavesDefaultsAlone) {
  const Parsed parsed = parse({});
  EXPECT_TRUE(parsed.go_on) << parsed.failure;
  EXPECT_EQ(parsed.values.length, 0.5);
  EXPECT_EQ(parsed.values.share, 0.85);
  EXPECT_EQ(parsed.values.count, 3);
  EXPECT_EQ(parsed.values.colour, Colour::Green);
  EXPECT_TRUE(parsed.values.up.isZero());
  EXPECT_FALSE(parsed.length_given);
}

TEST(CommandLine, ReadsEveryKind) {
  const Parsed parsed = parse({"a.ply", "-l", "2.5e-3", "--count=7", "--up", "-1,0,+2.5", "b",
                               "--colour", "red", "-q", "--name", "x y", "--threads", "2", "c"});
  ASSERT_TRUE(parsed.go_on) << parsed.failure;
  const Values& v = parsed.values;
  EXPECT_EQ(v.input, "a.ply");
  EXPECT_EQ(v.rest, (std::vector<std::string>{"b", "c"}));
  EXPECT_EQ(v.length, 2.5e-3);
  EXPECT_EQ(v.count, 7);
  EXPECT_EQ(v.up, Eigen::Vector3d(-1.0, 0.0, 2.5));
  EXPECT_EQ(v.colour, Colour::Red);
  EXPECT_TRUE(v.quiet);
  EXPECT_EQ(v.name, "x y");
  EXPECT_EQ(v.threads, 2U);
  EXPECT_TRUE(parsed.length_given);
}

TEST(CommandLine, RefusesWhatIsOutOfItsRangeAndNamesIt) {
  const std::vector<std::pair<std::vector<std::string>, std::string>> wrong = {
      {{"--length", "-1"}, "--length is '-1', expected a finite number >= 0"},
      {{"--length", "nan"}, "--length is 'nan'"},
      {{"--length", "inf"}, "--length is 'inf'"},
      {{"--length", "1e999"}, "--length is '1e999'"},
      {{"--length", "2m"}, "--length is '2m'"},
      {{"--length", "1,5"}, "--length is '1,5'"},
      {{"--share", "0"}, "--share is '0', expected a finite number > 0 and <= 1"},
      {{"--share", "1.01"}, "--share is '1.01'"},
      {{"--count", "6.5"}, "--count is '6.5', expected a whole number >= 0"},
      {{"--count", "2147483648"}, "--count is '2147483648'"},
      {{"--threads", "-1"}, "--threads is '-1'"},
      {{"--up", "1,2"}, "--up is '1,2', expected three finite numbers X,Y,Z"},
      {{"--up", "1,2,3,4"}, "--up is"},
      {{"--up", "1,2,inf"}, "--up is"},
      {{"--colour", "blue"}, "--colour is 'blue', expected one of red, green"},
      {{"--quie"}, "--quie"},
      {{"--count"}, "--count"},
      {{"--quiet=yes"}, "--quiet"},
      {{"--nothing"}, "--nothing"}};
  for (const auto& [words, message] : wrong) {
    const Parsed parsed = parse(words);
    EXPECT_FALSE(parsed.go_on) << words[0];
    EXPECT_NE(parsed.failure.find(message), std::string::npos) << parsed.failure;
    EXPECT_NE(parsed.failure.find("see prog --help"), std::string::npos) << parsed.failure;
  }
}

TEST(CommandLine, HelpNamesEveryOptionWithItsDefault) {
  const Parsed parsed = parse({"--help", "--count", "many"});
  EXPECT_FALSE(parsed.go_on);
  EXPECT_EQ(parsed.failure, "");
  for (const char* const text :
       {"Usage: prog INPUT", "\n  or:  prog --list", "Does something.", "input", "--length",
        "(=0.5)", "(=0.85)", "(=green)", "--help", "--version", "--threads", "X,Y,Z"}) {
    EXPECT_NE(parsed.printed.find(text), std::string::npos) << text << " in\n" << parsed.printed;
  }
}

TEST(CommandLine, PrintsItsVersion) {
  const Parsed parsed = parse({"--version"});
  EXPECT_FALSE(parsed.go_on);
  EXPECT_EQ(parsed.printed.rfind("storey ", 0), 0U);
}

TEST(RunMain, GivesTheStatusOfAFailureAndOneLine) {
  testing::internal::CaptureStderr();
  EXPECT_EQ(runMain("prog", []() -> int { throw io::Failure(io::BadInput, "f", "is odd", ""); }),
            65);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "prog: f: is odd\n");
}

}  // namespace
}  // namespace storey::cli
