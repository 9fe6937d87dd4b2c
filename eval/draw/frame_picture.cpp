#include "eval/draw/frame_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "eval/draw/label_layout.h"
#include "eval/draw/paint.h"
#include "eval/draw/run_gauge.h"

namespace eval {
namespace {

const Colour kBadTint{150, 150, 150};
const Colour kChip{28, 24, 22};
constexpr double kChipText_px = 9;
constexpr double kSmallShare = 0.006;  // of the image: a bad plane below it gets a dot alone

std::vector<cv::Point2d> Scaled(std::vector<cv::Point2d> points, double zoom) {
  // Pixel centres are whole in both images, so the corner at -0.5 stays where it is.
  for (cv::Point2d& p : points) p = {(p.x + 0.5) * zoom - 0.5, (p.y + 0.5) * zoom - 0.5};
  return points;
}

class FramePainter {
 public:
  FramePainter(const FrameScene& scene, int width_px)
      : scene_(scene), zoom_(static_cast<double>(width_px) / scene.rgb.cols) {
    cv::resize(scene.rgb, image_, {width_px, cvRound(scene.rgb.rows * zoom_)}, 0, 0,
               zoom_ < 1 ? cv::INTER_AREA : cv::INTER_CUBIC);
    if (scene.labels) {
      cv::resize(*scene.labels, labels_, image_.size(), 0, 0, cv::INTER_NEAREST);
    }
  }

  cv::Mat Paint() {
    if (scene_.frame == nullptr) return image_;
    std::vector<const RunFramePlane*> planes;
    for (const RunFramePlane& plane : scene_.frame->planes) planes.push_back(&plane);
    std::stable_sort(planes.begin(), planes.end(),
                     [](const auto* a, const auto* b) { return a->pixels > b->pixels; });
    for (const RunFramePlane* plane : planes) PaintArea(*plane);
    for (const RunFramePlane* plane : planes) PaintEdges(*plane);
    LabelLayout layout({2, 2, image_.cols - 4.0, image_.rows - 4.0});
    for (const RunFramePlane* plane : planes) PaintChip(*plane, layout);
    return image_;
  }

 private:
  struct Identity {
    std::string text;
    std::optional<Colour> colour;
  };

  // A plane that was merged later is painted as the plane it ended up in: one surface, one
  // colour.
  Identity IdentityOf(const RunFramePlane& plane) const {
    if (!plane.map_plane) return {"", std::nullopt};
    const RunMapPlane* last =
        scene_.map == nullptr ? nullptr : FinalPlane(*scene_.map, *plane.map_plane);
    const int id = last == nullptr ? *plane.map_plane : last->id;
    const std::string text = id == *plane.map_plane
                                 ? std::to_string(id)
                                 : fmt::format("{}>{}", *plane.map_plane, id);
    return {text, ColourOfPlane(id)};
  }

  Colour ColourOf(const RunFramePlane& plane) const {
    return IdentityOf(plane).colour.value_or(kBadTint);
  }

  cv::Mat MaskOf(const RunFramePlane& plane) const {
    return labels_.empty() ? cv::Mat() : cv::Mat(labels_ == plane.index + 1);
  }

  std::vector<cv::Point2d> Outline(const std::vector<Eigen::Vector3d>& points_c) const {
    if (!scene_.camera) return {};
    return Scaled(ProjectOutline(*scene_.camera, points_c), zoom_);
  }

  // What stands in for the segment when it was not saved.
  std::vector<cv::Point2d> FallbackOutline(const RunFramePlane& plane) const {
    if (plane.vertices_c.size() >= 3) return Outline(plane.vertices_c);
    if (!plane.map_plane || !scene_.T_wc || scene_.map == nullptr) return {};
    const RunMapPlane* map_plane = FinalPlane(*scene_.map, *plane.map_plane);
    if (map_plane == nullptr) return {};
    const Pose T_cw = Inverse(*scene_.T_wc);
    std::vector<Eigen::Vector3d> hull_c;
    for (const Eigen::Vector3d& p_w : map_plane->hull_w) hull_c.push_back(T_cw * p_w);
    return Outline(hull_c);
  }

  void PaintArea(const RunFramePlane& plane) {
    const bool bad = !IdentityOf(plane).colour;
    const Colour colour = ColourOf(plane);
    const cv::Mat mask = MaskOf(plane);
    if (mask.empty()) {
      const std::vector<cv::Point2d> outline = FallbackOutline(plane);
      FillArea(image_, outline, colour, bad ? 0.22 : 0.36);
      PutPath(image_, outline, true, colour, 2);
      return;
    }
    FillMask(image_, mask, colour, bad ? 0.28 : 0.42);
    std::vector<std::vector<cv::Point>> contours;
    cv::findContours(mask, contours, cv::RETR_CCOMP, cv::CHAIN_APPROX_NONE);
    const double least = 12 * zoom_;  // specks have no boundary worth a line
    for (const auto& contour : contours) {
      if (static_cast<double>(contour.size()) < least) continue;
      cv::polylines(image_, contour, true, colour, bad ? 1 : 2, cv::LINE_AA);
    }
  }

  // Edge lines are infinite; they are shown where they run along their segment.
  void PaintLines(const RunFramePlane& plane) {
    const cv::Mat mask = MaskOf(plane);
    if (mask.empty() || !scene_.camera || plane.bad) return;
    cv::Mat near, drawn = image_.clone();
    cv::dilate(mask, near, cv::getStructuringElement(cv::MORPH_ELLIPSE, {9, 9}));
    for (const auto& [P, V] : plane.lines_c) {
      if (!(V.norm() > 0)) continue;
      const Eigen::Vector3d foot = P + V * (V.dot(plane.centroid_c - P) / V.squaredNorm());
      const Eigen::Vector3d reach = V.normalized() * 3.0;
      std::vector<cv::Point2d> ends;
      for (int i = -60; i <= 60; ++i) {
        const auto pixel = Project(*scene_.camera, foot + reach * (i / 60.0));
        if (pixel) ends.push_back(Scaled({*pixel}, zoom_)[0]);
      }
      PutPath(drawn, ends, false, kWhite, 1);
    }
    drawn.copyTo(image_, near);
  }

  void PaintEdges(const RunFramePlane& plane) {
    PaintLines(plane);
    if (!scene_.camera || plane.vertices_c.empty()) return;
    const Colour colour = ColourOf(plane);
    if (plane.vertices_c.size() == 4) {
      const std::vector<cv::Point2d> face = Outline(plane.vertices_c);
      PutPath(image_, face, true, kBlack, 3);
      PutPath(image_, face, true, kWhite, 1);
    }
    for (const Eigen::Vector3d& vertex : plane.vertices_c) {
      const auto pixel = Project(*scene_.camera, vertex);
      if (pixel) PutRingedDot(image_, Scaled({*pixel}, zoom_)[0], 4.6, colour, kBlack);
      if (pixel) PutDot(image_, Scaled({*pixel}, zoom_)[0], 1.4, kWhite);
    }
  }

  // Where a label belongs: the middle of the segment, or, when that is outside or close to the
  // boundary, the pixel farthest from it.
  std::optional<cv::Point2d> Anchor(const RunFramePlane& plane) const {
    const cv::Mat mask = MaskOf(plane);
    if (!mask.empty()) {
      cv::Mat padded, distance;
      cv::copyMakeBorder(mask, padded, 1, 1, 1, 1, cv::BORDER_CONSTANT, cv::Scalar(0));
      cv::distanceTransform(padded, distance, cv::DIST_L2, 3);
      double furthest = 0;
      cv::Point at;
      cv::minMaxLoc(distance, nullptr, &furthest, nullptr, &at);
      const cv::Moments sums = cv::moments(padded, true);
      if (sums.m00 > 0) {
        const cv::Point middle(cvRound(sums.m10 / sums.m00), cvRound(sums.m01 / sums.m00));
        if (distance.at<float>(middle) > 0.6 * furthest) at = middle;
      }
      if (furthest > 0) return cv::Point2d(at.x - 1, at.y - 1);
    }
    if (!scene_.camera) return std::nullopt;
    const auto pixel = Project(*scene_.camera, plane.centroid_c);
    if (!pixel) return std::nullopt;
    const cv::Point2d at = Scaled({*pixel}, zoom_)[0];
    const bool seen = at.x >= 0 && at.y >= 0 && at.x < image_.cols && at.y < image_.rows;
    return seen ? std::optional(at) : std::nullopt;
  }

  static Colour MarkOf(const RunFramePlane& plane) {
    if (plane.bad) return kBadMark;
    if (plane.decision == "matched") return kMatchedMark;
    return plane.decision == "new" ? kNewMark : kOpenMark;
  }

  std::string ChipText(const RunFramePlane& plane) const {
    std::string text = IdentityOf(plane).text;
    // What a bad plane was linked to tells less than why it is bad, and the chips of a toy are
    // many.
    if (plane.bad && !plane.map_plane) return *plane.bad;
    if (plane.plane_class) text += (text.empty() ? "" : " ") + *plane.plane_class;
    if (plane.bad) text += (text.empty() ? "" : ": ") + *plane.bad;
    if (text.empty()) text = "no decision";
    return text;
  }

  void PaintChip(const RunFramePlane& plane, LabelLayout& layout) {
    const auto anchor = Anchor(plane);
    if (!anchor) return;
    if (plane.bad && plane.pixels < kSmallShare * scene_.rgb.cols * scene_.rgb.rows) {
      PutRingedDot(image_, *anchor, 5.5, MarkOf(plane), kChip);
      return;
    }
    const TextStyle style{kChipText_px, kWhite, false, Align::kLeft};
    const std::string text = ChipText(plane);
    const double height = kChipText_px + 9;
    const auto place = layout.Place(*anchor, {TextWidth(text, style) + 25, height});
    if (!place) return;
    const cv::Point2d corner(place->x, place->y);
    const auto box = [&](double x0, double x1) {
      return std::vector<cv::Point2d>{corner + cv::Point2d(x0, 0), corner + cv::Point2d(x1, 0),
                                      corner + cv::Point2d(x1, height),
                                      corner + cv::Point2d(x0, height)};
    };
    FillArea(image_, box(0, place->width), kChip, 0.78);
    FillArea(image_, box(0, 4), ColourOf(plane), 1.0);
    PutDot(image_, corner + cv::Point2d(12, height / 2), 3.6, MarkOf(plane));
    PutText(image_, text, corner + cv::Point2d(20, height - 4.5), style);
  }

  const FrameScene& scene_;
  double zoom_;
  cv::Mat image_;
  cv::Mat labels_;
};

}  // namespace

cv::Mat DrawFrame(const FrameScene& scene, int width_px) {
  return FramePainter(scene, width_px).Paint();
}

}  // namespace eval
