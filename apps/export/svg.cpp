// SPDX-License-Identifier: BSD-3-Clause
#include "export/svg.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "export/number_text.h"
#include "io/model_io.h"
#include "io/output_file.h"

namespace storey::exports {
namespace {

// Of the drawing, in its own unit (pixels).
constexpr double kPlanSize = 420.0;
constexpr double kMargin = 36.0;
constexpr double kTitleHeight = 40.0;
constexpr double kFontSize = 12.0;
constexpr double kCharacterWidth = 0.6 * kFontSize;  // of a sans-serif digit

// Strokes within a plan are scaled with it: not all programs know strokes that are not.
std::string styleOf(double scale) {
  const auto scaled = [&](double pixels) { return numberText(pixels / scale); };
  return "<style>.plans .floor{fill:#ece8de}.plans .wall{stroke:#23272b;stroke-width:" +
         scaled(2.0) + ";stroke-linecap:square}.plans .hypothetical{stroke:#c0392b;" +
         "stroke-linecap:butt;stroke-dasharray:" + scaled(6.0) + " " + scaled(4.0) +
         "}.plans .length{font-size:10px;fill:#555;text-anchor:middle}" +
         ".plans .bar{stroke:#23272b;stroke-width:3}</style>\n";
}

Eigen::Vector2d toPlan(const Eigen::Isometry3d& frame, const Eigen::Vector2d& corner) {
  return (frame * Eigen::Vector3d(corner.x(), corner.y(), 0.0)).head<2>();
}

std::string attribute(const char* name, double value) {
  return std::string(" ") + name + "=\"" + numberText(value) + "\"";
}

std::string escaped(const std::string& text) {
  std::string xml;
  for (const char c : text) {
    xml += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : std::string(1, c);
  }
  return xml;
}

// 1, 2 or 5 times a power of ten, at most the given length.
double roundLength(double length) {
  const double power = std::pow(10.0, std::floor(std::log10(length)));
  return length >= 5.0 * power ? 5.0 * power : length >= 2.0 * power ? 2.0 * power : power;
}

class Drawing {
 public:
  explicit Drawing(const Exported& exported)
      : model_(exported.model), crs_(exported.crs), frame_(io::planFrame(exported.local_to_input)) {
    for (const FloorplanLayer& storey : model_.storeys) {
      for (const FloorplanComponent& component : storey.plan.components) {
        for (const Eigen::Vector2d& v : component.outer.vertices) box_.extend(toPlan(frame_, v));
      }
    }
    const double extent = box_.sizes().maxCoeff();
    scale_ = kPlanSize / extent;
    decimals_ = std::max(0, 3 - static_cast<int>(std::floor(std::log10(extent))));
    columns_ =
        static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(model_.storeys.size()))));
    cell_ = scale_ * box_.sizes() + Eigen::Vector2d(2.0 * kMargin, 2.0 * kMargin + kTitleHeight);
  }

  std::string draw() {
    const std::size_t rows = (model_.storeys.size() + columns_ - 1) / columns_;
    const std::string width = fixed(static_cast<double>(columns_) * cell_.x(), 0);
    const double bar_top = static_cast<double>(rows) * cell_.y();
    const std::string height = fixed(bar_top + kTitleHeight, 0);
    text_ = "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"plans\" width=\"" + width +
            "\" height=\"" + height + "\" viewBox=\"0 0 " + width + " " + height +
            "\" font-family=\"sans-serif\" font-size=\"" + fixed(kFontSize, 0) + "\">\n" +
            "<title>Floorplans</title>\n<desc>relative to " + numberText(box_.min().x()) + " " +
            numberText(box_.min().y()) + (crs_.empty() ? "" : " in " + escaped(crs_)) +
            "</desc>\n" + styleOf(scale_);
    for (std::size_t k = 0; k < model_.storeys.size(); ++k) drawStorey(k);
    drawBar(bar_top);
    return text_ + "</svg>\n";
  }

 private:
  static std::string fixed(double value, int decimals) {
    char text[400];  // the largest double has 309 digits
    std::snprintf(text, sizeof text, "%.*f", decimals, value);
    return text;
  }
  std::string measure(double length) const { return fixed(length, decimals_); }

  void drawStorey(std::size_t k) {
    const FloorplanLayer& storey = model_.storeys[k];
    const double foot = frame_.translation().z();
    const Eigen::Vector2d corner(static_cast<double>(k % columns_) * cell_.x(),
                                 static_cast<double>(k / columns_) * cell_.y());
    // Where the corner that coordinates are relative to lies in the drawing.
    const Eigen::Vector2d origin =
        corner + Eigen::Vector2d(kMargin, kMargin + kTitleHeight + scale_ * box_.sizes().y());
    text_ +=
        "<g id=\"storey_" + std::to_string(k) + "\"" +
        attribute("data-z-min", foot + storey.z_min) +
        attribute("data-z-max", foot + storey.z_max) + attribute("data-area", area(storey.plan)) +
        attribute("data-perimeter", perimeter(storey.plan)) + ">\n<text x=\"" +
        fixed(corner.x() + kMargin, 1) + "\" y=\"" + fixed(corner.y() + 0.5 * kTitleHeight, 1) +
        "\">storey " + std::to_string(k) + ": height " + measure(foot + storey.z_min) + " to " +
        measure(foot + storey.z_max) + ", area " + measure(area(storey.plan)) +
        "</text>\n<g transform=\"matrix(" + numberText(scale_) + " 0 0 " + numberText(-scale_) +
        " " + fixed(origin.x(), 1) + " " + fixed(origin.y(), 1) + ")\">\n";
    for (const FloorplanComponent& component : storey.plan.components) drawFloor(component);
    forEachRing(storey, [&](const FloorplanRing& ring) { drawWalls(storey, ring); });
    text_ += "</g>\n";
    forEachRing(storey, [&](const FloorplanRing& ring) { writeLengths(ring, origin); });
    text_ += "</g>\n";
  }

  template <typename Action>
  static void forEachRing(const FloorplanLayer& storey, Action action) {
    for (const FloorplanComponent& component : storey.plan.components) {
      action(component.outer);
      std::for_each(component.holes.begin(), component.holes.end(), action);
    }
  }

  Eigen::Vector2d relative(const FloorplanRing& ring, std::size_t i) const {
    return toPlan(frame_, ring.vertices[i % ring.size()]) - box_.min();
  }

  void drawFloor(const FloorplanComponent& component) {
    text_ += "<path class=\"floor\" fill-rule=\"evenodd\" d=\"";
    const auto append = [&](const FloorplanRing& ring) {
      for (std::size_t i = 0; i < ring.size(); ++i) {
        const Eigen::Vector2d p = relative(ring, i);
        text_ += (i == 0 ? "M" : "L") + numberText(p.x()) + " " + numberText(p.y());
      }
      text_ += "Z";
    };
    append(component.outer);
    std::for_each(component.holes.begin(), component.holes.end(), append);
    text_ += "\"/>\n";
  }

  void drawWalls(const FloorplanLayer& storey, const FloorplanRing& ring) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Eigen::Vector2d a = relative(ring, i);
      const Eigen::Vector2d b = relative(ring, i + 1);
      const PolyhedralFace* face = io::wallFaceAt(model_, storey, ring, i);
      const bool guessed = ring.edges[i].hypothetical || (face != nullptr && face->hypothetical);
      text_ += std::string("<line class=\"wall") + (guessed ? " hypothetical\"" : "\"") +
               attribute("data-wall", ring.edges[i].wall) +
               attribute("data-length", (b - a).norm()) + attribute("x1", a.x()) +
               attribute("y1", a.y()) + attribute("x2", b.x()) + attribute("y2", b.y()) +
               "><title>wall " + std::to_string(ring.edges[i].wall) + ", length " +
               measure((b - a).norm()) + "</title></line>\n";
    }
  }

  // Beside each wall that is longer than what is written, outside the building.
  void writeLengths(const FloorplanRing& ring, const Eigen::Vector2d& origin) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Eigen::Vector2d a = relative(ring, i);
      const Eigen::Vector2d along = relative(ring, i + 1) - a;
      const std::string length = measure(along.norm());
      if (scale_ * along.norm() < kCharacterWidth * static_cast<double>(length.size())) continue;
      const Eigen::Vector2d outward = Eigen::Vector2d(along.y(), -along.x()).normalized();
      const Eigen::Vector2d middle = scale_ * (a + 0.5 * along) + 0.8 * kFontSize * outward;
      double angle = std::atan2(-along.y(), along.x()) * 180.0 / M_PI;  // y runs down
      if (angle > 90.0) angle -= 180.0;                                 // never upside down
      if (angle <= -90.0) angle += 180.0;
      text_ += "<text class=\"length\" dy=\"0.35em\" transform=\"translate(" +
               fixed(origin.x() + middle.x(), 1) + " " + fixed(origin.y() - middle.y(), 1) +
               ") rotate(" + fixed(angle, 1) + ")\">" + length + "</text>\n";
    }
  }

  void drawBar(double top) {
    const double length = roundLength(0.5 * box_.sizes().maxCoeff());
    const std::string y = fixed(top + 0.4 * kTitleHeight, 1);
    text_ += "<g id=\"scale_bar\"" + attribute("data-length", length) +
             "><line class=\"bar\" x1=\"" + fixed(kMargin, 1) + "\" x2=\"" +
             fixed(kMargin + scale_ * length, 3) + "\" y1=\"" + y + "\" y2=\"" + y +
             "\"/><text x=\"" + fixed(kMargin, 1) + "\" y=\"" +
             fixed(top + 0.4 * kTitleHeight + 1.3 * kFontSize, 1) + "\">" + numberText(length) +
             "</text></g>\n";
  }

  const PolyhedralModel& model_;
  const std::string& crs_;
  Eigen::Isometry3d frame_;
  Eigen::AlignedBox2d box_;  ///< of all plans
  double scale_ = 1.0;       ///< drawing units a unit of the cloud
  int decimals_ = 0;         ///< of written lengths: four digits of the extent
  std::size_t columns_ = 1;
  Eigen::Vector2d cell_;  ///< size of the place of a storey in the drawing
  std::string text_;
};

}  // namespace

std::string drawFloorplans(const Exported& exported) { return Drawing(exported).draw(); }

void writeSvg(const std::string& path, const Exported& exported) {
  io::OutputFile file(path);
  file.write(drawFloorplans(exported));
  file.commit();
}

}  // namespace storey::exports
