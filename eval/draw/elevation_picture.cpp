#include "eval/draw/elevation_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "eval/draw/error_picture.h"
#include "eval/draw/map_picture.h"
#include "eval/draw/paint.h"

namespace eval {
namespace {

constexpr double kShown_mm = 400;
constexpr double kLabelStep_px = 21;
const Colour kFaintEdge{232, 229, 226};

/// A level plane seen from the side.
struct Bar {
  double x0_m = std::numeric_limits<double>::infinity(), x1_m = -x0_m;
  double height_mm = 0;  ///< above the base
  const MapScene::Estimate* plane = nullptr;
  std::string label;
};

void Extend(Bar& bar, const std::vector<Eigen::Vector3d>& points) {
  for (const Eigen::Vector3d& p : points) {
    bar.x0_m = std::min(bar.x0_m, p.x());
    bar.x1_m = std::max(bar.x1_m, p.x());
  }
}

/// Pixels of the panel from metres along x and millimetres of height.
struct ElevationAxes {
  const MapScale& scale;
  cv::Rect2d panel;
  double low_mm, high_mm;
  cv::Point2d At(double x_m, double mm) const {
    const double x = panel.x + (x_m - scale.x0_m) * scale.pixels_per_m;
    return {std::clamp(x, panel.x, panel.x + panel.width),
            panel.y + panel.height * (high_mm - mm) / (high_mm - low_mm)};
  }
};

/// Heights of level planes, estimated and true, above the estimated base.
struct Heights {
  std::vector<Bar> estimated, truth;
  std::vector<std::string> elsewhere;  ///< too far above or below to be drawn
};

std::string StepText(const MapScene& scene, const MapScene::Estimate& plane,
                     const MapScene::Estimate& base, double step_mm) {
  std::string text = std::to_string(plane.id);
  if (!plane.class_name.empty()) text += " " + plane.class_name;
  if (&plane == &base) return text + "  0 (base)";
  text += fmt::format("  {:+.1f} mm", step_mm);
  const MapScene::Truth* true_plane = TrueLevelPlane(scene, plane);
  const MapScene::Truth* true_base = TrueLevelPlane(scene, base);
  if (true_plane == nullptr || true_base == nullptr) return text;
  const double true_step =
      HeightAt(true_plane->pi_v, plane.centre_v) - HeightAt(true_base->pi_v, plane.centre_v);
  return text + fmt::format(" (true {:+.1f})", true_step * 1e3);
}

Heights Measure(const MapScene& scene, const MapScene::Estimate& base) {
  Heights heights;
  for (const MapScene::Estimate& plane : scene.planes) {
    if (!(plane.pi_v.n.z() > kLevel_cos)) continue;
    Bar bar;
    bar.plane = &plane;
    bar.height_mm =
        (HeightAt(plane.pi_v, plane.centre_v) - HeightAt(base.pi_v, plane.centre_v)) * 1e3;
    bar.label = StepText(scene, plane, base, bar.height_mm);
    Extend(bar, plane.vertices_v.size() >= 4 ? plane.vertices_v : plane.hull_v);
    if (!(bar.x0_m <= bar.x1_m)) continue;
    if (std::abs(bar.height_mm) <= kShown_mm) {
      heights.estimated.push_back(bar);
    } else {
      heights.elsewhere.push_back(bar.label);
    }
  }
  for (const MapScene::Truth& plane : scene.truth) {
    if (!(plane.pi_v.n.z() > kLevel_cos)) continue;
    Bar bar;
    const Eigen::Vector3d middle = (plane.vertices_v.front() + plane.vertices_v[2]) / 2;
    bar.height_mm = (HeightAt(plane.pi_v, middle) - HeightAt(base.pi_v, middle)) * 1e3;
    Extend(bar, plane.vertices_v);
    if (std::abs(bar.height_mm) <= kShown_mm) heights.truth.push_back(bar);
  }
  return heights;
}

void PutGrid(cv::Mat& page, const ElevationAxes& axes) {
  const double step = RoundStep(axes.high_mm - axes.low_mm, 8);
  for (double mm = std::ceil(axes.low_mm / step) * step; mm <= axes.high_mm; mm += step) {
    const double y = axes.At(0, mm).y;
    PutLine(page, {axes.panel.x, y}, {axes.panel.x + axes.panel.width, y}, kFaintEdge);
    PutText(page, fmt::format("{:g}", std::abs(mm) < 1e-9 ? 0.0 : mm),
            {axes.panel.x + 6, y - 4}, {8.5, Colour(150, 145, 140), false, Align::kLeft});
  }
}

// Labels from top to bottom in the order of height, none over another.
void PutElevationLabels(cv::Mat& page, const ElevationAxes& axes, std::vector<Bar> bars) {
  const auto fits = static_cast<std::size_t>(axes.panel.height / kLabelStep_px);
  if (bars.size() > fits) {
    std::stable_sort(bars.begin(), bars.end(), [](const Bar& a, const Bar& b) {
      return a.plane->observations > b.plane->observations;
    });
    bars.resize(fits);
  }
  std::stable_sort(bars.begin(), bars.end(),
                   [](const Bar& a, const Bar& b) { return a.height_mm > b.height_mm; });
  std::vector<double> y(bars.size());
  for (std::size_t i = 0; i < bars.size(); ++i) {
    y[i] = axes.At(0, bars[i].height_mm).y;
    if (i > 0) y[i] = std::max(y[i], y[i - 1] + kLabelStep_px);
  }
  double lowest = axes.panel.y + axes.panel.height;
  for (std::size_t i = bars.size(); i-- > 0; lowest = y[i] - kLabelStep_px) {
    y[i] = std::min(y[i], lowest);
  }
  const double edge = axes.panel.x + axes.panel.width;
  for (std::size_t i = 0; i < bars.size(); ++i) {
    const Colour dark = Darker(ColourOfPlane(bars[i].plane->id), 0.75);
    const cv::Point2d end = axes.At(bars[i].x1_m, bars[i].height_mm);
    PutDashedLine(page, end, {edge, end.y}, Darker(dark, 1.0), 1, 2);
    PutLine(page, {edge, end.y}, {edge + 22, y[i]}, dark);
    PutText(page, bars[i].label, {edge + 28, y[i] + 4.5},
            {9.5, kInkColour, false, Align::kLeft});
  }
}

std::string Joined(const std::vector<std::string>& parts) {
  std::string text;
  for (std::size_t i = 0; i < parts.size() && i < 6; ++i)
    text += (i > 0 ? ",  " : "") + parts[i];
  if (parts.size() > 6) text += fmt::format(",  and {} more", parts.size() - 6);
  return text;
}

}  // namespace

void PutElevation(cv::Mat& page, const MapScene& scene, const MapScale& scale,
                  cv::Rect2d panel) {
  const TextStyle title{11.5, kInkColour, true, Align::kLeft};
  PutText(page, "Heights of level planes above the base plane, mm", {panel.x, panel.y - 14},
          title);
  const auto base = BasePlane(scene);
  if (!base) {
    PutText(page, "the map has no level plane", {panel.x, panel.y + 20},
            {10, kInkColour, false, Align::kLeft});
    return;
  }
  const Heights heights = Measure(scene, scene.planes[*base]);
  double low = -5, high = 20;
  for (const auto* bars : {&heights.estimated, &heights.truth}) {
    for (const Bar& bar : *bars) {
      low = std::min(low, bar.height_mm), high = std::max(high, bar.height_mm);
    }
  }
  const double room = 0.07 * (high - low);
  const ElevationAxes axes{scale, panel, low - room, high + room};
  PutGrid(page, axes);
  for (const Bar& bar : heights.estimated) {
    const Colour colour = ColourOfPlane(bar.plane->id);
    const cv::Point2d from = axes.At(bar.x0_m, bar.height_mm),
                      to = axes.At(bar.x1_m, bar.height_mm);
    PutLine(page, from, to, Darker(colour, 0.7), 7);
    PutLine(page, from, to, colour, 5);
  }
  for (const Bar& bar : heights.truth) {
    PutDashedLine(page, axes.At(bar.x0_m, bar.height_mm), axes.At(bar.x1_m, bar.height_mm),
                  kTruthColour, 1, 6);
  }
  PutElevationLabels(page, axes, heights.estimated);
  if (!heights.elsewhere.empty()) {
    PutText(page, "too far above or below to be drawn:  " + Joined(heights.elsewhere),
            {panel.x, panel.y + panel.height + 24}, {9.5, kInkColour, false, Align::kLeft});
  }
}

}  // namespace eval
