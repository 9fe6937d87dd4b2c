#include "eval/draw/frame_picture.h"

#include <algorithm>
#include <map>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "eval/draw/paint.h"
#include "eval/draw/plane_name.h"

namespace eval {
namespace {

const Colour kBadTint{150, 150, 150};
const Colour kChip{28, 24, 22};
constexpr double kSmallShare = 0.006;   // of the image: a bad plane below it gets a dot alone
constexpr int kGapClosed_px = 5;        // of the picture: holes and notches that are noise
constexpr double kMinBoundary_px = 40;  // length of a boundary that is worth a line

std::vector<cv::Point2d> Scaled(std::vector<cv::Point2d> points, double zoom) {
  // Pixel centres are whole in both images, so the corner at -0.5 stays where it is.
  for (cv::Point2d& p : points) p = {(p.x + 0.5) * zoom - 0.5, (p.y + 0.5) * zoom - 0.5};
  return points;
}

cv::Mat Brush(int side_px) {
  return cv::getStructuringElement(cv::MORPH_ELLIPSE, {side_px, side_px});
}

/// The pixel of a segment farthest from its boundary, or its middle where that is nearly as
/// far.
std::optional<cv::Point2d> MiddleOf(const cv::Mat& mask) {
  cv::Mat padded, distance;
  cv::copyMakeBorder(mask, padded, 1, 1, 1, 1, cv::BORDER_CONSTANT, cv::Scalar(0));
  cv::distanceTransform(padded, distance, cv::DIST_L2, 3);
  double furthest = 0;
  cv::Point at;
  cv::minMaxLoc(distance, nullptr, &furthest, nullptr, &at);
  if (!(furthest > 0)) return std::nullopt;
  const cv::Moments sums = cv::moments(padded, true);
  const cv::Point middle(cvRound(sums.m10 / sums.m00), cvRound(sums.m01 / sums.m00));
  constexpr double kNearlyAsFar = 0.6;
  if (distance.at<float>(middle) > kNearlyAsFar * furthest) at = middle;
  return cv::Point2d(at.x - 1, at.y - 1);
}

/// A frame at the size of its picture: where its planes are in it.
class FrameView {
 public:
  FrameView(const FrameScene& scene, int width_px)
      : scene_(scene),
        zoom_(static_cast<double>(width_px) / scene.rgb.cols),
        size_(width_px, std::max(1, cvRound(scene.rgb.rows * zoom_))) {
    if (scene.labels) cv::resize(*scene.labels, labels_, size_, 0, 0, cv::INTER_NEAREST);
  }

  double zoom() const { return zoom_; }
  cv::Size size() const { return size_; }
  bool segmented() const { return !labels_.empty(); }

  PlaneName NameOf(const RunFramePlane& plane) const {
    static const std::vector<RunMapPlane> kNoMap;
    return NameOfPlane(plane, scene_.map == nullptr ? kNoMap : *scene_.map);
  }
  Colour ColourOf(const RunFramePlane& plane) const {
    return NameOf(plane).colour.value_or(kBadTint);
  }
  cv::Mat MaskOf(const RunFramePlane& plane) const { return labels_ == plane.index + 1; }

  std::optional<cv::Point2d> PixelOf(const Eigen::Vector3d& p_c) const {
    if (!scene_.camera) return std::nullopt;
    const auto pixel = Project(*scene_.camera, p_c);
    return pixel ? std::optional(Scaled({*pixel}, zoom_)[0]) : std::nullopt;
  }
  std::vector<cv::Point2d> Outline(const std::vector<Eigen::Vector3d>& points_c) const {
    if (!scene_.camera) return {};
    return Scaled(ProjectOutline(*scene_.camera, points_c), zoom_);
  }

  /// The hull of the map plane as this frame's camera sees it.
  std::vector<cv::Point2d> HullOf(const RunFramePlane& plane) const {
    if (!plane.map_plane || !scene_.T_wc || scene_.map == nullptr) return {};
    const RunMapPlane* map_plane = FinalPlane(*scene_.map, *plane.map_plane);
    if (map_plane == nullptr) return {};
    const Pose T_cw = Inverse(*scene_.T_wc);
    std::vector<Eigen::Vector3d> hull_c;
    for (const Eigen::Vector3d& p_w : map_plane->hull_w) hull_c.push_back(T_cw * p_w);
    return Outline(hull_c);
  }

  /// Where a label of the plane belongs.
  std::optional<cv::Point2d> PlaceOf(const RunFramePlane& plane) const {
    if (segmented()) {
      if (const auto middle = MiddleOf(MaskOf(plane))) return middle;
    }
    const auto at = PixelOf(plane.centroid_c);
    const bool seen =
        at && at->x >= 0 && at->y >= 0 && at->x < size_.width && at->y < size_.height;
    return seen ? at : std::nullopt;
  }

 private:
  const FrameScene& scene_;
  double zoom_;
  cv::Size size_;
  cv::Mat labels_;
};

class FramePainter {
 public:
  FramePainter(const FrameScene& scene, int width_px) : scene_(scene), view_(scene, width_px) {
    cv::resize(scene.rgb, image_, view_.size(), 0, 0,
               view_.zoom() < 1 ? cv::INTER_AREA : cv::INTER_CUBIC);
  }

  cv::Mat Paint() {
    if (scene_.frame == nullptr) return image_;
    std::vector<const RunFramePlane*> planes;
    for (const RunFramePlane& plane : scene_.frame->planes) planes.push_back(&plane);
    std::stable_sort(planes.begin(), planes.end(),
                     [](const auto* a, const auto* b) { return a->pixels > b->pixels; });
    if (view_.segmented()) {
      for (const RunFramePlane* plane : planes) PaintSegment(*plane);
      for (const RunFramePlane* plane : planes) PaintLines(*plane);
      for (const RunFramePlane* plane : planes) PaintFace(*plane);
    } else {
      PaintOutlines(planes);
    }
    for (const RunFramePlane* plane : planes) PaintVertices(*plane);
    PaintLabels();
    return image_;
  }

 private:
  double ShareOf(const RunFramePlane& plane) const {
    return plane.pixels / (static_cast<double>(scene_.rgb.cols) * scene_.rgb.rows);
  }

  void PaintSegment(const RunFramePlane& plane) {
    const bool in_map = view_.NameOf(plane).colour.has_value();
    const Colour colour = view_.ColourOf(plane);
    const cv::Mat mask = view_.MaskOf(plane);
    FillMask(image_, mask, colour, in_map ? 0.42 : 0.28);
    cv::Mat closed;
    cv::morphologyEx(mask, closed, cv::MORPH_CLOSE, Brush(kGapClosed_px));
    std::vector<std::vector<cv::Point>> contours;
    cv::findContours(closed, contours, cv::RETR_CCOMP, cv::CHAIN_APPROX_NONE);
    for (const auto& contour : contours) {
      if (static_cast<double>(contour.size()) < kMinBoundary_px) continue;
      cv::polylines(image_, contour, true, colour, in_map ? 2 : 1, cv::LINE_AA);
    }
  }

  // Outlines of map planes, each once, by a face if there is one; small ones over large ones.
  void PaintOutlines(const std::vector<const RunFramePlane*>& planes) {
    const auto is_face = [](const RunFramePlane& plane) {
      return plane.vertices_c.size() == 4;
    };
    const auto map_plane_of = [&](const RunFramePlane& plane) -> std::optional<int> {
      if (!plane.map_plane || plane.bad) return std::nullopt;
      const RunMapPlane* last =
          scene_.map == nullptr ? nullptr : FinalPlane(*scene_.map, *plane.map_plane);
      return last == nullptr ? *plane.map_plane : last->id;
    };
    std::map<int, const RunFramePlane*> shown;
    for (const RunFramePlane* plane : planes) {
      const auto id = map_plane_of(*plane);
      if (!id) continue;
      const RunFramePlane*& best = shown[*id];
      if (best == nullptr || (is_face(*plane) && !is_face(*best))) best = plane;
    }
    for (const RunFramePlane* plane : planes) {
      const auto id = map_plane_of(*plane);
      if (!id || shown.at(*id) != plane) continue;
      const bool has_face = is_face(*plane);
      const auto outline = has_face ? view_.Outline(plane->vertices_c) : view_.HullOf(*plane);
      const Colour colour = view_.ColourOf(*plane);
      if (has_face || ShareOf(*plane) >= kLargeShare) {
        PutHaloedPath(image_, outline, true, colour, 2);
      } else {
        PutPath(image_, outline, true, colour, 1);
      }
    }
  }

  // Edge lines are infinite; they are shown along the boundary of their segment.
  void PaintLines(const RunFramePlane& plane) {
    if (!scene_.camera || plane.bad || plane.lines_c.empty()) return;
    cv::Mat closed, outside, inside, drawn = image_.clone();
    cv::morphologyEx(view_.MaskOf(plane), closed, cv::MORPH_CLOSE, Brush(kGapClosed_px));
    cv::dilate(closed, outside, Brush(9));
    cv::erode(closed, inside, Brush(9));
    for (const auto& [P, V] : plane.lines_c) {
      if (!(V.norm() > 0)) continue;
      const Eigen::Vector3d foot = P + V * (V.dot(plane.centroid_c - P) / V.squaredNorm());
      const Eigen::Vector3d reach = V.normalized() * 3.0;
      std::vector<cv::Point2d> ends;
      for (int i = -60; i <= 60; ++i) {
        if (const auto pixel = view_.PixelOf(foot + reach * (i / 60.0))) ends.push_back(*pixel);
      }
      PutPath(drawn, ends, false, kWhite, 1);
    }
    drawn.copyTo(image_, outside & ~inside);
  }

  void PaintFace(const RunFramePlane& plane) {
    if (plane.vertices_c.size() != 4) return;
    PutHaloedPath(image_, view_.Outline(plane.vertices_c), true, kWhite, 1);
  }

  void PaintVertices(const RunFramePlane& plane) {
    const bool outlined = view_.segmented() || plane.map_plane;
    if (plane.bad || !outlined) return;
    for (const Eigen::Vector3d& vertex : plane.vertices_c) {
      const auto pixel = view_.PixelOf(vertex);
      if (!pixel) continue;
      PutRingedDot(image_, *pixel, 4.6, view_.ColourOf(plane), kBlack);
      PutDot(image_, *pixel, 1.4, kWhite);
    }
  }

  void PaintLabels() {
    const std::vector<PlaneLabel> labels = LabelsOfFrame(scene_, view_.size().width);
    std::vector<LabelWish> wishes;
    wishes.reserve(labels.size());
    for (const PlaneLabel& label : labels) wishes.push_back(label.wish);
    const std::vector<PlacedLabel> placed = PlaceLabels(wishes, view_.size());
    for (const PlacedLabel& label : placed) {
      if (!label.needs_leader) continue;
      const cv::Point2d at = wishes[label.wish].at;
      const cv::Point2d chip(label.place.x + label.place.width / 2,
                             label.place.y + label.place.height / 2);
      PutHaloedPath(image_, {at, chip}, false, kWhite, 1);
      PutDot(image_, at, 2.5, kWhite);
    }
    for (const PlacedLabel& label : placed)
      PaintLabel(*labels[label.wish].plane, label, wishes[label.wish].text);
  }

  void PaintLabel(const RunFramePlane& plane, const PlacedLabel& label,
                  const std::string& text) {
    const Colour mark = eval::ColourOf(MarkOf(plane));
    const cv::Point2d corner(label.place.x, label.place.y);
    const double width = label.place.width, height = label.place.height;
    if (!label.is_chip) {
      // Planes without a decision are many and tell least.
      const double share = MarkOf(plane) == DecisionMark::kOpen ? 0.65 : 1.0;
      PutRingedDot(image_, corner + cv::Point2d(width / 2, height / 2), kDotRadius_px * share,
                   mark, kChip);
      return;
    }
    const auto box = [&](double x1) {
      return std::vector<cv::Point2d>{corner, corner + cv::Point2d(x1, 0),
                                      corner + cv::Point2d(x1, height),
                                      corner + cv::Point2d(0, height)};
    };
    FillArea(image_, box(width), kChip, 0.82);
    FillArea(image_, box(5), view_.ColourOf(plane), 1.0);
    PutDot(image_, corner + cv::Point2d(13, height / 2), 4, mark);
    PutText(image_, text, corner + cv::Point2d(21, (height + kChipText_px) / 2),
            {kChipText_px, kWhite, false, Align::kLeft});
  }

  const FrameScene& scene_;
  FrameView view_;
  cv::Mat image_;
};

}  // namespace

cv::Mat DrawFrame(const FrameScene& scene, int width_px) {
  return FramePainter(scene, width_px).Paint();
}

std::vector<PlaneLabel> LabelsOfFrame(const FrameScene& scene, int width_px) {
  const FrameView view(scene, width_px);
  const double area = static_cast<double>(scene.rgb.cols) * scene.rgb.rows;
  std::vector<PlaneLabel> labels;
  for (const RunFramePlane& plane : scene.frame->planes) {
    const auto at = view.PlaceOf(plane);
    if (!at) continue;
    const double share = plane.pixels / area;
    const bool dot = plane.bad && share < kSmallShare;
    labels.push_back({&plane, {*at, dot ? "" : view.NameOf(plane).text, share}});
  }
  return labels;
}

}  // namespace eval
