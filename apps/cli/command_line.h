// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace storey::cli {

/// What a number may be; infinite and undefined ones never are.
struct Range {
  double least = -std::numeric_limits<double>::max();
  double most = std::numeric_limits<double>::max();
  bool above_least = false;  ///< the least itself is not allowed
};
constexpr Range kAnyNumber{};
constexpr Range kNonNegative{0.0};
constexpr Range kPositive{0.0, std::numeric_limits<double>::max(), true};
constexpr Range kShare{0.0, 1.0};
constexpr Range kPositiveShare{0.0, 1.0, true};

template <typename T>
struct Choice {
  const char* name;
  T value;
};

/// The command line of a storey program: declared once, and that gives the parsing, the checks of
/// the values, `--help` with the defaults, and `--version`. What an option's variable holds when it
/// is declared is its default. All mistakes end in an `io::Failure` (Usage) that names the option.
/// Options are not guessed from shortened names, and numbers do not depend on the locale.
class CommandLine {
 public:
  /// \param usages what follows the program's name, one entry for each way to call it
  CommandLine(const std::string& program, const std::vector<std::string>& usages,
              const std::string& description);
  ~CommandLine();
  CommandLine(const CommandLine&) = delete;
  CommandLine& operator=(const CommandLine&) = delete;

  /// The next argument without a name of its own; whether it must be there is up to the program.
  void argument(const std::string& name, std::string& value, const std::string& text);
  /// All arguments that are left.
  void arguments(const std::string& name, std::vector<std::string>& values,
                 const std::string& text);

  /// The options that follow are listed under a heading of their own.
  void group(const std::string& heading);

  // Options, "long" or "long,s" with a short name. `text` says the unit.
  void flag(const std::string& names, bool& value, const std::string& text);
  void text(const std::string& names, std::string& value, const std::string& text);
  void texts(const std::string& names, std::vector<std::string>& values, const std::string& text);
  void number(const std::string& names, double& value, const Range& range, const std::string& text);
  /// Three numbers X,Y,Z.
  void vector(const std::string& names, Eigen::Vector3d& value, const std::string& text);

  /// A whole number from `least` to the greatest of its type, 2^53 at most.
  template <typename Integer>
  void whole(const std::string& names, Integer& value, Integer least, const std::string& text) {
    constexpr double kExactInDouble = 9007199254740992.0;
    const double most =
        std::min(kExactInDouble, static_cast<double>(std::numeric_limits<Integer>::max()));
    addWhole(
        names, static_cast<double>(value), {static_cast<double>(least), most},
        [&value](double number) { value = static_cast<Integer>(number); }, text);
  }

  template <typename T>
  void choice(const std::string& names, T& value, const std::vector<Choice<T>>& choices,
              const std::string& text) {
    std::vector<std::string> words;
    std::size_t initial = 0;
    for (std::size_t i = 0; i < choices.size(); ++i) {
      words.emplace_back(choices[i].name);
      if (choices[i].value == value) initial = i;
    }
    addChoice(
        names, words, initial, [&value, choices](std::size_t i) { value = choices[i].value; },
        text);
  }

  /// `--threads`, 0 (the default) = all cores.
  void threads(unsigned int& value);

  /// Reads the command line into the variables. \return false if help or the version was asked for
  /// and printed
  bool parse(int argc, char** argv);

  /// Whether the last `parse` met this option.
  bool given(const std::string& name) const;

  [[noreturn]] void fail(const std::string& reason) const;

 private:
  struct Declarations;  // keeps Boost out of this header

  void addWhole(const std::string& names, double initial, const Range& range,
                std::function<void(double)> take, const std::string& text);
  void addChoice(const std::string& names, const std::vector<std::string>& words,
                 std::size_t initial, std::function<void(std::size_t)> take,
                 const std::string& text);
  double parseNumber(const std::string& name, const std::string& word, const Range& range,
                     bool whole) const;
  Eigen::Vector3d parseVector(const std::string& name, const std::string& words) const;

  std::string program_;
  std::unique_ptr<Declarations> declared_;
};

/// `main` of every program: runs it and gives its exit status (`io::ExitStatus`). Whatever is
/// thrown, and nothing that a library would print, ends as one line on stderr.
int runMain(const char* program, const std::function<int()>& body);

}  // namespace storey::cli
