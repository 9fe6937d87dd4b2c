#include "eval/draw/map_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "eval/draw/elevation_picture.h"
#include "eval/draw/error_picture.h"
#include "eval/draw/label_layout.h"
#include "eval/draw/paint.h"

namespace eval {
namespace {

constexpr int kPage_px = 1640, kMapHeader_px = 76, kMargin_px = 30, kColumn_px = 340;
// Planes that look shorter have no label: level ones, and others, which from above are lines.
constexpr double kMinLevelSide_px = 14, kMinOtherSide_px = 60;
constexpr double kBesideLabel_px = 10;
constexpr int kMaxTop_px = 1000, kMaxEmpty_px = 400, kLegendHeight_px = 240, kMapGap_px = 56,
              kElevation_px = 460;
const Colour kFrame{215, 211, 208};
const Colour kRunPath{40, 70, 225}, kTruthPath{120, 115, 110}, kWarningColour{40, 40, 215};

bool IsLevel(const Plane& pi_v) { return pi_v.n.z() > kLevel_cos; }
/// Within 25 degrees: what noise makes of a small top.
bool IsNearlyLevel(const Plane& pi_v) { return pi_v.n.z() > 0.906; }
/// Within 17 degrees of upright: from above a mere line.
bool IsSteep(const Plane& pi_v) { return std::abs(pi_v.n.z()) < 0.3; }

// Planes are painted from below, so that a book lies on its desk.
void PutPlanes(cv::Mat& view, const MapScene& scene, const MapScale& scale) {
  for (const MapScene::Estimate& plane : scene.planes) {
    const Colour colour = ColourOfPlane(plane.id);
    const std::vector<cv::Point2d> hull = scale.At(plane.hull_v);
    const bool steep = IsSteep(plane.pi_v);
    // A slanted plane hides what is under it, and tells little from above.
    if (steep) FillArea(view, hull, colour, 0.75);
    if (IsNearlyLevel(plane.pi_v)) FillArea(view, hull, LevelFill(plane.id), kLevelOpacity);
    PutPath(view, hull, true, Darker(colour, 0.8), steep ? 2 : 1);
  }
}

void PutTruth(cv::Mat& view, const MapScene& scene, const MapScale& scale) {
  for (const MapScene::Truth& plane : scene.truth) {
    if (plane.pi_v.n.z() < -0.5) continue;  // undersides lie under what is drawn
    const std::vector<cv::Point2d> outline = scale.At(plane.vertices_v);
    if (IsLevel(plane.pi_v)) {
      for (std::size_t i = 0; i < outline.size(); ++i) {
        PutDashedLine(view, outline[i], outline[(i + 1) % outline.size()], kTruthColour, 1, 6);
      }
    }
  }
}

void PutFaces(cv::Mat& view, const MapScene& scene, const MapScale& scale) {
  for (const MapScene::Estimate& plane : scene.planes) {
    if (plane.vertices_v.size() != 4) continue;
    PutPath(view, scale.At(plane.vertices_v), true, Darker(ColourOfPlane(plane.id), 0.75), 3);
  }
}

void PutVertices(cv::Mat& view, const MapScene& scene, const MapScale& scale) {
  for (const MapScene::Estimate& plane : scene.planes) {
    const Colour dark = Darker(ColourOfPlane(plane.id), 0.55);
    for (const cv::Point2d& corner : scale.At(plane.vertices_v)) {
      PutRingedDot(view, corner, 4.4, kWhite, dark);
    }
  }
}

void PutPaths(cv::Mat& view, const MapScene& scene, const MapScale& scale) {
  const std::vector<cv::Point2d> truth = scale.At(scene.truth_path_v);
  const std::vector<cv::Point2d> run = scale.At(scene.run_path_v);
  PutPath(view, truth, false, kTruthPath, 4);
  PutPath(view, run, false, kRunPath, 2);
  if (run.empty()) return;
  PutRingedDot(view, run.front(), 6, kWhite, kRunPath);
  PutDot(view, run.back(), 4, kRunPath);
}

// The upright box around an outline, pixels.
double LongestSide(const std::vector<cv::Point2d>& outline) {
  double low_x = 1e9, low_y = 1e9, high_x = -1e9, high_y = -1e9;
  for (const cv::Point2d& p : outline) {
    low_x = std::min(low_x, p.x), high_x = std::max(high_x, p.x);
    low_y = std::min(low_y, p.y), high_y = std::max(high_y, p.y);
  }
  return std::max(high_x - low_x, high_y - low_y);
}

/// The planes in the order in which they are labelled: level ones before others, large before
/// small.
std::vector<const MapScene::Estimate*> ByRank(const MapScene& scene) {
  std::vector<const MapScene::Estimate*> planes;
  for (const MapScene::Estimate& plane : scene.planes) planes.push_back(&plane);
  std::stable_sort(planes.begin(), planes.end(), [](const auto* a, const auto* b) {
    const bool a_level = IsNearlyLevel(a->pi_v), b_level = IsNearlyLevel(b->pi_v);
    return a_level != b_level ? a_level : a->area_m2 > b->area_m2;
  });
  return planes;
}

void PutLabels(cv::Mat& view, const std::vector<MapLabel>& labels) {
  for (const MapLabel& label : labels) {
    const cv::Point2d a = label.place.tl(), b = label.place.br();
    FillArea(view, {a, {b.x, a.y}, b, {a.x, b.y}}, kWhite, 0.85);
    FillArea(view, {a, {a.x + 4, a.y}, {a.x + 4, b.y}, {a.x, b.y}}, ColourOfPlane(label.id), 1);
    PutText(view, label.text, {a.x + kBesideLabel_px, b.y - 4.5},
            {label.height_px, kInkColour, label.bold, Align::kLeft});
  }
}

void PutScaleBar(cv::Mat& page, const MapScale& scale) {
  const double length_m = RoundStep(scale.page.width / scale.pixels_per_m, 6);
  const double length = length_m * scale.pixels_per_m;
  const cv::Point2d from(scale.page.x, scale.page.y + scale.page.height + 18);
  const cv::Point2d to = from + cv::Point2d(length, 0);
  PutLine(page, from, to, kInkColour, 2);
  for (const cv::Point2d& end : {from, to}) {
    PutLine(page, end - cv::Point2d(0, 5), end + cv::Point2d(0, 5), kInkColour, 2);
  }
  const std::string text =
      length_m < 1 ? fmt::format("{:g} mm", length_m * 1e3) : fmt::format("{:g} m", length_m);
  PutText(page, text, to + cv::Point2d(10, 5), {10, kInkColour, false, Align::kLeft});
}

// One entry of the legend: `draw` paints the sample into a strip of 36 px.
template <typename Draw>
void PutEntry(cv::Mat& page, cv::Point2d& at, const std::string& text, Draw draw) {
  draw(at + cv::Point2d(0, -5));
  PutText(page, text, at + cv::Point2d(48, 0), {10, kInkColour, false, Align::kLeft});
  at.y += 26;
}

/// What the frame of the drawing is.
std::vector<std::string> MapNotes(const MapScene& scene) {
  std::vector<std::string> notes{fmt::format("{} map planes", scene.planes.size())};
  notes.emplace_back(scene.on_truth ? "laid on the true camera poses"
                                    : "not laid on true camera poses");
  if (scene.levelled) notes.emplace_back("turned until the main level plane is level");
  return notes;
}

void PutMapLegend(cv::Mat& page, const MapScene& scene, cv::Point2d at) {
  const Colour sample = ColourOfPlane(3), dark = Darker(sample, 0.55),
               face = Darker(sample, 0.75);
  const cv::Point2d right(36, 0);
  PutEntry(page, at, "estimated plane, colour by id", [&](cv::Point2d p) {
    const std::vector<cv::Point2d> box{p + cv::Point2d(0, -7), p + cv::Point2d(36, -7),
                                       p + cv::Point2d(36, 7), p + cv::Point2d(0, 7)};
    FillArea(page, box, LevelFill(3), kLevelOpacity);
    PutPath(page, box, true, Darker(sample, 0.8));
  });
  PutEntry(page, at, "its face from four vertices", [&](cv::Point2d p) {
    PutLine(page, p, p + right, face, 3);
    PutRingedDot(page, p, 4.4, kWhite, dark);
    PutRingedDot(page, p + right, 4.4, kWhite, dark);
  });
  PutEntry(page, at, "estimated camera path", [&](cv::Point2d p) {
    PutLine(page, p, p + right, kRunPath, 2);
    PutRingedDot(page, p, 6, kWhite, kRunPath);
  });
  if (!scene.truth_path_v.empty()) {
    PutEntry(page, at, "true camera path",
             [&](cv::Point2d p) { PutLine(page, p, p + right, kTruthPath, 4); });
  }
  if (!scene.truth.empty()) {
    PutEntry(page, at, "true level face",
             [&](cv::Point2d p) { PutDashedLine(page, p, p + right, kTruthColour, 1, 6); });
  }
  at.y += 10;
  const TextStyle note{9.5, kInkColour, false, Align::kLeft};
  for (const std::string& line : MapNotes(scene)) {
    PutText(page, line, at, note);
    at.y += 22;
  }
}

void PutMapTitle(cv::Mat& page, const RunTitle& title) {
  const TextStyle bold{14, kInkColour, true, Align::kLeft};
  TextStyle warning = bold;
  warning.colour = kWarningColour;
  const double width = kPage_px - 2.0 * kMargin_px;
  const double warning_width =
      title.warning.empty() ? 0 : TextWidth(title.warning, warning) + 24;
  const std::string name =
      Fitted("Map of " + title.run + ", seen from above", bold, width - warning_width);
  PutText(page, name, {kMargin_px * 1.0, 34}, bold);
  PutText(page, title.warning, {kMargin_px + TextWidth(name, bold) + 24, 34}, warning);
  PutText(page, Fitted(title.figures, {10.5}, width), {kMargin_px * 1.0, 58},
          {10.5, kInkColour, false, Align::kLeft});
}

/// The map from above. A picture of its own: nothing that is cut off spills over the page.
cv::Mat DrawMapView(const MapScene& scene, MapScale scale) {
  cv::Mat view(static_cast<int>(scale.page.height), static_cast<int>(scale.page.width), CV_8UC3,
               cv::Scalar(250, 249, 248));
  scale.page.x = scale.page.y = 0;
  PutPlanes(view, scene, scale);
  PutFaces(view, scene, scale);
  PutTruth(view, scene, scale);
  PutVertices(view, scene, scale);
  PutPaths(view, scene, scale);
  PutLabels(view, LabelsOfMap(scene, scale));
  if (scene.planes.empty()) {
    PutText(view, "the run mapped no plane", {view.cols / 2.0, view.rows / 2.0},
            {13, kWarningColour, true, Align::kCentre});
  }
  return view;
}

}  // namespace

cv::Scalar LevelFill(int id) {
  constexpr double kShare = 0.6;  // of the plane's colour, the rest is white
  return ColourOfPlane(id) * kShare + kWhite * (1 - kShare);
}

std::vector<MapLabel> LabelsOfMap(const MapScene& scene, const MapScale& scale) {
  const cv::Rect2d view(0, 0, scale.page.width, scale.page.height);
  LabelLayout layout({4, 4, view.width - 8, view.height - 8});
  std::vector<MapLabel> labels;
  for (const MapScene::Estimate* plane : ByRank(scene)) {
    const cv::Point2d at = scale.At(OpenPoint(scene, *plane, scale));
    const bool level = IsNearlyLevel(plane->pi_v);
    const double side = LongestSide(scale.At(plane->hull_v));
    const bool shown = side >= (level ? kMinLevelSide_px : kMinOtherSide_px);
    if (!view.contains(at) || !shown) continue;
    MapLabel label{plane->id, std::to_string(plane->id), {}, level ? 10.5 : 9.0, level};
    if (level && !plane->class_name.empty()) label.text.append(" ").append(plane->class_name);
    const TextStyle style{label.height_px, kInkColour, label.bold, Align::kLeft};
    const cv::Size2d size(TextWidth(label.text, style) + kBesideLabel_px + 6,
                          label.height_px + 9);
    // Farther off than its plane is long, a label would name another one.
    const auto place = layout.Place(at, size, side > kMinOtherSide_px ? 3 : 1);
    if (!place) continue;
    label.place = *place;
    labels.push_back(label);
  }
  return labels;
}

cv::Mat DrawMap(const MapScene& scene, const RunTitle& title) {
  const double left = kMargin_px, top = kMapHeader_px;
  const double width = kPage_px - 2.0 * kMargin_px - kColumn_px;
  const bool empty = scene.planes.empty();
  const MapScale scale =
      FitMap(scene, {left, top, width, empty ? kMaxEmpty_px * 1.0 : kMaxTop_px * 1.0});
  const cv::Mat view = DrawMapView(scene, scale);
  const int below = kMapHeader_px + std::max(view.rows, kLegendHeight_px) + kMapGap_px;
  cv::Mat page(below + (empty ? 0 : kElevation_px), kPage_px, CV_8UC3, kWhite);
  view.copyTo(page(cv::Rect(kMargin_px, kMapHeader_px, view.cols, view.rows)));
  const double x1 = left + view.cols, y1 = top + view.rows;
  PutPath(page, {{left - 0.5, top - 0.5}, {x1, top - 0.5}, {x1, y1}, {left - 0.5, y1}}, true,
          kFrame);
  PutMapTitle(page, title);
  PutScaleBar(page, scale);
  PutMapLegend(page, scene, {x1 + 24, top + 22});
  if (!empty)
    PutElevation(page, scene, scale, {left, below + 34.0, width, kElevation_px - 70.0});
  return page;
}

}  // namespace eval
