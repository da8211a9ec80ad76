// SPDX-License-Identifier: BSD-3-Clause
#include "cli/command_line.h"

#include <malloc.h>
#include <pcl/console/print.h>

#include <boost/program_options.hpp>
#include <charconv>
#include <cmath>
#include <deque>
#include <iostream>

#include "io/failure.h"
#include "io/scan.h"

namespace storey::cli {
namespace {

namespace po = boost::program_options;

// What one stage frees the next one takes again. Given back to the system in between, every page of
// it would be cleared and mapped anew: an eighth of the time of a large cloud.
void keepFreedMemory() {
#ifdef __GLIBC__
  mallopt(M_MMAP_MAX, 0);
  mallopt(M_TRIM_THRESHOLD, std::numeric_limits<int>::max());
#endif
}

std::string shortest(double value) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

// The name for messages, of "long,s".
std::string longName(const std::string& names) { return names.substr(0, names.find(',')); }

std::string headingOf(const std::string& program, const std::vector<std::string>& usages,
                      const std::string& description) {
  std::string text;
  for (const std::string& usage : usages) {
    text +=
        (text.empty() ? "Usage: " : "  or:  ") + program + " " + usage + "\n";  // as help2man wants
  }
  return text + "\n" + description + "\n";
}

std::string expectation(const Range& range, bool whole) {
  std::string text = whole ? "a whole number" : "a finite number";
  if (range.least > -std::numeric_limits<double>::max()) {
    text += (range.above_least ? " > " : " >= ") + shortest(range.least);
  }
  if (range.most <= 1.0) text += " and <= " + shortest(range.most);
  return text;
}

}  // namespace

struct CommandLine::Declarations {
  std::string heading;
  std::string arguments;                      // their part of the help
  std::deque<po::options_description> shown;  // group by group
  po::options_description hidden;             // the arguments: options without a name in the help
  po::positional_options_description positional;
  po::variables_map given;

  void argument(const std::string& name, int count, const po::value_semantic* value,
                const std::string& text) {
    hidden.add_options()(name.c_str(), value);
    positional.add(name.c_str(), count);
    const std::string column = "  " + name;
    arguments += column + std::string(column.size() < 16 ? 16 - column.size() : 1, ' ') + text;
    arguments += '\n';
  }

  void option(const std::string& names, const po::value_semantic* value, const std::string& text) {
    shown.back().add_options()(names.c_str(), value, text.c_str());
  }
};

CommandLine::CommandLine(const std::string& program, const std::vector<std::string>& usages,
                         const std::string& description)
    : program_(program), declared_(new Declarations) {
  declared_->heading = headingOf(program, usages, description);
  group("options");
}

CommandLine::~CommandLine() = default;

void CommandLine::argument(const std::string& name, std::string& value, const std::string& text) {
  declared_->argument(name, 1, po::value(&value), text);
}

void CommandLine::arguments(const std::string& name, std::vector<std::string>& values,
                            const std::string& text) {
  declared_->argument(name, -1, po::value(&values), text);
}

void CommandLine::group(const std::string& heading) { declared_->shown.emplace_back(heading); }

void CommandLine::flag(const std::string& names, bool& value, const std::string& text) {
  declared_->option(names, po::bool_switch(&value)->default_value(value), text);
}

void CommandLine::text(const std::string& names, std::string& value, const std::string& text) {
  auto* const semantic = po::value(&value);
  if (!value.empty()) semantic->default_value(value);
  declared_->option(names, semantic, text);
}

void CommandLine::texts(const std::string& names, std::vector<std::string>& values,
                        const std::string& text) {
  declared_->option(names, po::value(&values)->composing(), text);
}

void CommandLine::number(const std::string& names, double& value, const Range& range,
                         const std::string& text) {
  const auto take = [this, &value, range, name = longName(names)](const std::string& word) {
    value = parseNumber(name, word, range, false);
  };
  declared_->option(names, po::value<std::string>()->default_value(shortest(value))->notifier(take),
                    text);
}

void CommandLine::vector(const std::string& names, Eigen::Vector3d& value,
                         const std::string& text) {
  const auto take = [this, &value, name = longName(names)](const std::string& words) {
    value = parseVector(name, words);
  };
  declared_->option(names, po::value<std::string>()->value_name("X,Y,Z")->notifier(take), text);
}

void CommandLine::addWhole(const std::string& names, double initial, const Range& range,
                           std::function<void(double)> take, const std::string& text) {
  const auto checked = [this, range, take = std::move(take), name = longName(names)](
                           const std::string& word) { take(parseNumber(name, word, range, true)); };
  declared_->option(
      names, po::value<std::string>()->default_value(shortest(initial))->notifier(checked), text);
}

void CommandLine::addChoice(const std::string& names, const std::vector<std::string>& words,
                            std::size_t initial, std::function<void(std::size_t)> take,
                            const std::string& text) {
  const auto checked = [this, words, take = std::move(take),
                        name = longName(names)](const std::string& word) {
    std::string expected;
    for (std::size_t i = 0; i < words.size(); ++i) {
      if (word == words[i]) return take(i);
      expected += (i == 0 ? "" : ", ") + words[i];
    }
    fail("--" + name + " is '" + word + "', expected one of " + expected);
  };
  declared_->option(
      names, po::value<std::string>()->default_value(words[initial])->notifier(checked), text);
}

void CommandLine::threads(unsigned int& value) {
  whole("threads", value, 0u, "number of threads [0 = all cores]");
}

double CommandLine::parseNumber(const std::string& name, const std::string& word,
                                const Range& range, bool whole) const {
  double value = 0.0;
  const bool good = io::parseNumber(word, value) && std::isfinite(value) && value <= range.most &&
                    (range.above_least ? value > range.least : value >= range.least) &&
                    (!whole || value == std::floor(value));
  if (!good) fail("--" + name + " is '" + word + "', expected " + expectation(range, whole));
  return value;
}

Eigen::Vector3d CommandLine::parseVector(const std::string& name, const std::string& words) const {
  Eigen::Vector3d vector;
  std::size_t begin = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const std::size_t end = axis < 2 ? words.find(',', begin) : words.size();
    const bool good = end != std::string::npos && begin <= end &&
                      io::parseNumber(words.substr(begin, end - begin), vector[axis]) &&
                      std::isfinite(vector[axis]);
    if (!good) fail("--" + name + " is '" + words + "', expected three finite numbers X,Y,Z");
    begin = end + 1;
  }
  return vector;
}

bool CommandLine::parse(int argc, char** argv) {
  group("general");
  declared_->shown.back().add_options()("help,h", "print this and exit")(
      "version", "print the version and exit");
  po::options_description all;
  for (const po::options_description& shown : declared_->shown) {
    if (!shown.options().empty()) all.add(shown);
  }
  po::options_description with_arguments;
  with_arguments.add(all).add(declared_->hidden);
  po::variables_map& given = declared_->given;
  try {
    const int style =
        po::command_line_style::default_style & ~po::command_line_style::allow_guessing;
    po::store(po::command_line_parser(argc, argv)
                  .options(with_arguments)
                  .positional(declared_->positional)
                  .style(style)
                  .run(),
              given);
    if (given.count("help") != 0) {
      std::cout << declared_->heading;
      if (!declared_->arguments.empty()) std::cout << "\narguments:\n" << declared_->arguments;
      std::cout << all;
      return false;
    }
    if (given.count("version") != 0) {
      std::cout << "storey " << STOREY_VERSION << '\n';
      return false;
    }
    po::notify(given);
  } catch (const po::error& error) {
    fail(error.what());
  }
  return true;
}

bool CommandLine::given(const std::string& name) const {
  const auto found = declared_->given.find(name);
  return found != declared_->given.end() && !found->second.defaulted();
}

void CommandLine::fail(const std::string& reason) const {
  throw io::Failure(io::Usage, "", reason, "see " + program_ + " --help");
}

int runMain(const char* program, const std::function<int()>& body) {
  keepFreedMemory();
  pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS);
  return io::runMain(program, body);
}

}  // namespace storey::cli
