// SPDX-License-Identifier: BSD-3-Clause
#include "stages/stage_notes.h"

#include <charconv>
#include <cmath>

#include "io/crs.h"
#include "io/scan.h"

namespace storey::stages {
namespace {

constexpr const char* kFrame = "frame_to_input";  // every file of a stage has it
constexpr std::size_t kSlicesPerLine = 500;       // far below the longest line that readers take
constexpr double kMaxCount = 4294967296.0;        // of points, more than any reader takes
constexpr double kRotationTolerance = 1e-6;

class Note {
 public:
  explicit Note(const char* key) : text_(key) {}

  Note& add(double value) {
    char number[32];
    text_ += ' ';
    text_.append(number, std::to_chars(number, number + sizeof number, value).ptr);
    return *this;
  }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

class StateReader {
 public:
  StateReader(const io::InputFile& file, StageState& state) : file_(file), state_(state) {}

  /// \return whether the note was the frame
  bool read(const std::string& note) {
    const std::size_t end = std::min(note.find(' '), note.size());
    key_ = note.substr(0, end);
    const std::string rest = note.substr(std::min(end + 1, note.size()));
    if (key_ == "crs") {
      if (!io::isCrs(rest)) fail();
      state_.crs = rest;
    }
    if (key_ == "space") state_.inside = rest == "inside";
    if (key_ == "noise") state_.noise = nonNegative(rest);
    if (key_ == "density") state_.density = nonNegative(rest);
    if (key_ == "sample_size") state_.sample_size = count(rest);
    if (key_ == "planar_threshold") {
      state_.planar_threshold = static_cast<float>(nonNegative(rest));
    }
    if (key_ == "directions") readDirections(numbers(rest, 3));
    if (key_ == "slices") readSlices(numbers(rest, 2));
    if (key_ == kFrame) readFrame(numbers(rest, 16));
    return key_ == kFrame;
  }

 private:
  [[noreturn]] void fail() const {
    file_.fail("its comment 'storey " + key_ + "' makes no sense", "run the stage before again");
  }

  /// Finite numbers, a multiple of `group` of them.
  std::vector<double> numbers(const std::string& text, std::size_t group) const {
    std::vector<double> values;
    for (const std::string_view word : io::splitWords(text)) {
      double value = 0.0;
      if (!io::parseNumber(word, value) || !std::isfinite(value)) fail();
      values.push_back(value);
    }
    if (values.empty() || values.size() % group != 0) fail();
    return values;
  }

  double nonNegative(const std::string& text) const {
    const std::vector<double> values = numbers(text, 1);
    if (values.size() != 1 || values[0] < 0.0) fail();
    return values[0];
  }

  std::size_t count(const std::string& text) const {
    const double value = nonNegative(text);
    if (value != std::floor(value) || value > kMaxCount) fail();
    return static_cast<std::size_t>(value);
  }

  void readDirections(const std::vector<double>& values) {
    for (std::size_t i = 0; i < values.size(); i += 3) {
      const Eigen::Vector3d direction(values[i], values[i + 1], values[i + 2]);
      if (std::abs(direction.norm() - 1.0) > kRotationTolerance) fail();
      state_.directions.push_back(direction);
    }
  }

  void readSlices(const std::vector<double>& values) {
    for (std::size_t i = 0; i < values.size(); i += 2) {
      const bool ascends = values[i] < values[i + 1] &&
                           (state_.slices.empty() || state_.slices.back().first < values[i]);
      if (!ascends) fail();
      state_.slices.emplace_back(values[i], values[i + 1]);
    }
  }

  void readFrame(const std::vector<double>& values) {
    if (values.size() != 16) fail();
    const Eigen::Matrix4d matrix =
        Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(values.data());
    const Eigen::Matrix3d rotation = matrix.topLeftCorner<3, 3>();
    const bool rigid = (rotation * rotation.transpose() - Eigen::Matrix3d::Identity()).norm() <
                           kRotationTolerance &&
                       rotation.determinant() > 0.0 &&
                       matrix.row(3) == Eigen::RowVector4d(0.0, 0.0, 0.0, 1.0);
    if (!rigid) fail();
    state_.frame_to_input.matrix() = matrix;
  }

  const io::InputFile& file_;
  StageState& state_;
  std::string key_;
};

}  // namespace

std::vector<std::string> toNotes(const StageState& state) {
  Note frame(kFrame);
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column)
      frame.add(state.frame_to_input.matrix()(row, column));
  }
  std::vector<std::string> notes = {frame.text()};
  if (!state.crs.empty()) notes.push_back("crs " + state.crs);
  notes.push_back(state.inside ? "space inside" : "space outside");
  if (state.noise > 0.0) notes.push_back(Note("noise").add(state.noise).text());
  if (state.density > 0.0) notes.push_back(Note("density").add(state.density).text());
  if (state.sample_size > 0) {
    notes.push_back(Note("sample_size").add(static_cast<double>(state.sample_size)).text());
  }
  if (state.planar_threshold > 0.0f) {
    const auto threshold = static_cast<double>(state.planar_threshold);
    notes.push_back(Note("planar_threshold").add(threshold).text());
  }
  if (!state.directions.empty()) {
    Note note("directions");
    for (const Eigen::Vector3d& d : state.directions) note.add(d.x()).add(d.y()).add(d.z());
    notes.push_back(note.text());
  }
  for (std::size_t first = 0; first < state.slices.size(); first += kSlicesPerLine) {
    Note note("slices");
    const std::size_t end = std::min(first + kSlicesPerLine, state.slices.size());
    for (std::size_t i = first; i < end; ++i) {
      note.add(state.slices[i].first).add(state.slices[i].second);
    }
    notes.push_back(note.text());
  }
  return notes;
}

std::optional<StageState> fromNotes(const std::vector<std::string>& notes,
                                    const io::InputFile& file) {
  StageState state;
  StateReader reader(file, state);
  bool has_frame = false;
  for (const std::string& note : notes) has_frame |= reader.read(note);
  if (!has_frame) return std::nullopt;
  return state;
}

}  // namespace storey::stages
