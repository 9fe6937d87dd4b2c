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

constexpr int kPage_px = 1640, kMapHeader_px = 64, kMargin_px = 30, kColumn_px = 340;
constexpr int kMaxTop_px = 1000, kMapGap_px = 56, kElevation_px = 460;
const Colour kFrame{215, 211, 208};
const Colour kRunPath{40, 70, 225}, kTruthPath{120, 115, 110};

bool IsLevel(const Plane& pi_v) { return pi_v.n.z() > kLevel_cos; }

// Planes are painted from below, so that a book lies on its desk.
void PutPlanes(cv::Mat& view, const MapScene& scene, const MapScale& scale) {
  for (const MapScene::Estimate& plane : scene.planes) {
    const Colour colour = ColourOfPlane(plane.id);
    const std::vector<cv::Point2d> hull = scale.At(plane.hull_v);
    const bool steep = std::abs(plane.pi_v.n.z()) < 0.3;
    FillArea(view, hull, colour, steep ? 0.75 : 0.5);
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

// Small planes and steep ones that are mere lines stay without a label where they would hide
// others.
void PutLabels(cv::Mat& view, const MapScene& scene, const MapScale& scale) {
  LabelLayout layout(cv::Rect2d(4, 4, view.cols - 8.0, view.rows - 8.0));
  for (auto plane = scene.planes.rbegin(); plane != scene.planes.rend(); ++plane) {
    if (plane->hull_v.empty() && plane->vertices_v.empty()) continue;
    const cv::Point2d at = scale.At(plane->centre_v);
    if (at.x < 0 || at.y < 0 || at.x > view.cols || at.y > view.rows) continue;
    const bool level = std::abs(plane->pi_v.n.z()) > 0.5;
    if (LongestSide(scale.At(plane->hull_v)) < (level ? 14 : 60)) continue;
    const TextStyle style{level ? 9.5 : 8.0, kInkColour, level, Align::kCentre};
    const std::string text = level && !plane->class_name.empty()
                                 ? fmt::format("{} {}", plane->id, plane->class_name)
                                 : std::to_string(plane->id);
    const double height = style.height_px + 7;
    const auto place = layout.Place(at, {TextWidth(text, style) + 10, height}, 3);
    if (!place) continue;
    const cv::Point2d a(place->x, place->y), b(place->x + place->width, place->y + height);
    FillArea(view, {a, {b.x, a.y}, b, {a.x, b.y}}, kWhite, 0.8);
    PutText(view, text, {(a.x + b.x) / 2, b.y - 3.5}, style);
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

void PutLegend(cv::Mat& page, const MapScene& scene, cv::Point2d at) {
  const Colour sample = ColourOfPlane(3), dark = Darker(sample, 0.55),
               face = Darker(sample, 0.75);
  const cv::Point2d right(36, 0);
  PutEntry(page, at, "estimated plane, colour by id", [&](cv::Point2d p) {
    const std::vector<cv::Point2d> box{p + cv::Point2d(0, -7), p + cv::Point2d(36, -7),
                                       p + cv::Point2d(36, 7), p + cv::Point2d(0, 7)};
    FillArea(page, box, sample, 0.5);
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
  for (const std::string& line :
       {std::string(scene.on_truth ? "aligned rigidly to the truth, z of the truth up"
                                   : "no truth: largest plane laid level"),
        fmt::format("{} map planes", scene.planes.size())}) {
    PutText(page, line, at, note);
    at.y += 22;
  }
}

}  // namespace

cv::Mat DrawMap(const MapScene& scene, const std::string& title) {
  const double width = kPage_px - 2.0 * kMargin_px - kColumn_px;
  const MapScale scale =
      FitMap(scene, {static_cast<double>(kMargin_px), static_cast<double>(kMapHeader_px), width,
                     static_cast<double>(kMaxTop_px)});
  const int top = kMapHeader_px + static_cast<int>(scale.page.height);
  cv::Mat page(std::max(top, kMapHeader_px + 240) + kMapGap_px + kElevation_px, kPage_px,
               CV_8UC3, kWhite);
  PutText(page, title, {static_cast<double>(kMargin_px), 38},
          {13, kInkColour, true, Align::kLeft});

  // The view is a picture of its own: nothing that is cut off spills over the page.
  cv::Mat view(static_cast<int>(scale.page.height), static_cast<int>(scale.page.width), CV_8UC3,
               cv::Scalar(250, 249, 248));
  MapScale inner = scale;
  inner.page.x = inner.page.y = 0;
  PutPlanes(view, scene, inner);
  PutFaces(view, scene, inner);
  PutTruth(view, scene, inner);
  PutVertices(view, scene, inner);
  PutPaths(view, scene, inner);
  PutLabels(view, scene, inner);
  view.copyTo(page(cv::Rect(kMargin_px, kMapHeader_px, view.cols, view.rows)));
  const double x1 = kMargin_px + view.cols, y1 = kMapHeader_px + view.rows;
  PutPath(page,
          {{kMargin_px - 0.5, kMapHeader_px - 0.5},
           {x1, kMapHeader_px - 0.5},
           {x1, y1},
           {kMargin_px - 0.5, y1}},
          true, kFrame);
  PutScaleBar(page, scale);
  PutLegend(page, scene, {x1 + 24, kMapHeader_px + 22.0});

  const double below = std::max(top, kMapHeader_px + 240) + kMapGap_px;
  PutElevation(page, scene, scale,
               {static_cast<double>(kMargin_px), below + 34, width, kElevation_px - 70.0});
  return page;
}

}  // namespace eval
