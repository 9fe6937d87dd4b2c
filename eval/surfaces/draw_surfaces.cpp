#include "eval/surfaces/draw_surfaces.h"

#include <fmt/format.h>

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <set>

#include "eval/draw/paint.h"
#include "eval/formats/sequence/images.h"
#include "eval/planes/frame_evidence.h"
#include "eval/surfaces/surface_plan.h"

namespace eval {
namespace {

const Colour kPaper{40, 34, 31}, kPaleText{215, 208, 202}, kNoLandmark{150, 150, 150};
constexpr int kFrames = 9, kColumns = 3, kTileWidth_px = 480, kGap_px = 10, kPlanWidth_px = 900;
constexpr double kTint = 0.5;

cv::Mat ColourOf(const DepthViews& views, std::size_t i) {
  cv::Mat image = ReadColour(views.folder() / views.FrameOf(i).rgb);
  const cv::Size size(views.camera().width, views.camera().height);
  if (image.size() != size) cv::resize(image, image, size);
  return image;
}

/// Tints the labelled pixels, draws their borders, and names each label at its thickest place.
template <typename ColourOf, typename NameOf>
void TintLabels(cv::Mat& image, const cv::Mat1w& labels, const ColourOf& colour_of,
                const NameOf& name_of) {
  std::set<int> ids(labels.begin(), labels.end());
  ids.erase(0);
  for (const int id : ids) {
    const cv::Mat mask = labels == id;
    FillMask(image, mask, colour_of(id), kTint);
    cv::Mat1b inner;
    cv::erode(mask, inner, cv::Mat::ones(3, 3, CV_8U));
    image.setTo(Darker(colour_of(id)), mask & ~inner);
  }
  constexpr double kMinThickness_px = 9;  // for a name to fit in
  for (const int id : ids) {
    cv::Mat1b framed;
    cv::copyMakeBorder(labels == id, framed, 1, 1, 1, 1, cv::BORDER_CONSTANT, 0);
    cv::Mat1f thickness;
    cv::distanceTransform(framed, thickness, cv::DIST_L2, cv::DIST_MASK_3);
    double most = 0;
    cv::Point at;
    cv::minMaxLoc(thickness, nullptr, &most, nullptr, &at);
    if (most < kMinThickness_px) continue;
    const cv::Point2d base(at.x, at.y + 6);
    PutText(image, name_of(id), base + cv::Point2d(1, 1), {13, kBlack, true, Align::kCentre});
    PutText(image, name_of(id), base, {13, kWhite, true, Align::kCentre});
  }
}

cv::Mat TintedFrame(const cv::Mat1w& labels, const DepthViews& views, std::size_t i) {
  cv::Mat image = ColourOf(views, i);
  TintLabels(
      image, labels, [](int id) { return ColourOfPlane(id); },
      [](int id) { return std::to_string(id); });
  return image;
}

/// Lines "id, area, flatness" in the columns that there is room for, the largest surfaces first;
/// the last line says how many more there are.
void PutList(cv::Mat& page, const SurfaceFile& file, cv::Point corner, int height_px) {
  constexpr int kLine_px = 24, kColumn_px = 290;
  const int rows = std::max(1, height_px / kLine_px);
  const auto base_of = [&](std::size_t i) {
    return cv::Point2d(corner.x + kColumn_px * (int(i) / rows),
                       corner.y + kLine_px * (int(i) % rows + 1));
  };
  const TextStyle style{9.5, kPaleText, false, Align::kLeft};
  const auto room = static_cast<std::size_t>(rows * (kPlanWidth_px / kColumn_px));
  const std::size_t all = file.surfaces.size(), listed = all <= room ? all : room - 1;
  for (std::size_t i = 0; i < listed; ++i) {
    const Surface& surface = file.surfaces[i];
    PutDot(page, base_of(i) + cv::Point2d(8, -5), 7, ColourOfPlane(CountedAs(surface)));
    PutText(page,
            fmt::format("{}{}: {:.2f} m2, flat to {:.1f} mm", surface.id,
                        surface.same_as != 0 ? fmt::format(" (in {})", surface.same_as) : "",
                        AreaOf(surface), 1e3 * surface.flatness_m),
            base_of(i) + cv::Point2d(24, 0), style);
  }
  if (listed < all)
    PutText(page, fmt::format("and {} more", all - listed),
            base_of(listed) + cv::Point2d(24, 0), style);
}

}  // namespace

cv::Mat DrawSurfaces(const SurfaceFile& file, const DepthViews& views) {
  const SurfaceLabeller labeller(file);
  const int tile_height = kTileWidth_px * views.camera().height / views.camera().width;
  const int rows = (kFrames + kColumns - 1) / kColumns;
  const int frames_width = kColumns * (kTileWidth_px + kGap_px);
  const int height = std::max(900, rows * (tile_height + kGap_px) + kGap_px);
  cv::Mat page(height, kPlanWidth_px + 2 * kGap_px + frames_width, CV_8UC3, kPaper);

  constexpr double kPlanShare = 0.62;  // of the height; the list has the rest
  const int plan_height = int(kPlanShare * height);
  const cv::Mat plan = DrawPlan(file, views, {kPlanWidth_px, plan_height});
  plan.copyTo(page(cv::Rect({kGap_px, kGap_px}, plan.size())));
  PutList(page, file, {2 * kGap_px, plan_height + 2 * kGap_px},
          height - plan_height - 4 * kGap_px);

  for (int tile = 0; tile < kFrames; ++tile) {
    const std::size_t i = (2 * std::size_t(tile) + 1) * views.size() / (2 * kFrames);
    const DepthView view = views.Read(i);
    cv::Mat frame = TintedFrame(labeller.Label(view, views.rays()), views, i);
    cv::resize(frame, frame, {kTileWidth_px, tile_height}, 0, 0, cv::INTER_AREA);
    PutText(frame, fmt::format("{:.6f} s", view.stamp_s), {8, tile_height - 8.0},
            {9.5, kWhite, true, Align::kLeft});
    const cv::Point corner(
        2 * kGap_px + kPlanWidth_px + (tile % kColumns) * (kTileWidth_px + kGap_px),
        kGap_px + (tile / kColumns) * (tile_height + kGap_px));
    frame.copyTo(page(cv::Rect(corner, frame.size())));
  }
  return page;
}

cv::Mat DrawCutSurfaces(const cv::Mat1w& surfaces, const Run& run, const DepthViews& views,
                        const FrameWholeness& frame) {
  cv::Mat left = TintedFrame(surfaces, views, frame.view);
  cv::Mat right = ColourOf(views, frame.view);
  const double stamp_s = views.StampOf(frame.view);
  const FinalLandmarks final_landmarks(run);
  std::map<int, int> landmarks;
  if (const auto at = FindStamp(StampsOf(run.frames), stamp_s)) {
    for (const RunFramePlane& plane : run.frames[*at].planes) {
      if (!Decided(plane)) continue;
      if (const auto id = final_landmarks.Of(plane.map_plane)) landmarks[plane.index + 1] = *id;
    }
  }
  TintLabels(
      right, *ReadSegmentation(run, stamp_s),
      [&](int label) {
        return landmarks.count(label) != 0 ? ColourOfPlane(landmarks.at(label)) : kNoLandmark;
      },
      [&](int label) {
        return landmarks.count(label) != 0 ? std::to_string(landmarks.at(label)) : "-";
      });
  cv::Mat both;
  cv::hconcat(left, right, both);
  // Small images are drawn larger: what stands below each half is as long as 640 pixels hold.
  constexpr int kCaption_px = 640;
  const int zoom = (kCaption_px + left.cols - 1) / left.cols;
  cv::resize(both, both, {}, zoom, zoom, cv::INTER_NEAREST);
  PutText(both,
          fmt::format("{:.6f} s: surfaces; {:.0f} % in their largest segments", stamp_s,
                      100.0 * double(frame.in_largest) / double(frame.pixels)),
          {8, both.rows - 10.0}, {10, kWhite, true, Align::kLeft});
  PutText(both, "segments, by landmark (- none)", {zoom * left.cols + 8.0, both.rows - 10.0},
          {10, kWhite, true, Align::kLeft});
  return both;
}

std::vector<FrameWholeness> WorstFrames(const SurfaceScore& score, std::size_t count) {
  std::vector<FrameWholeness> frames = score.by_frame;
  const auto lost = [](const FrameWholeness& frame) { return frame.pixels - frame.in_largest; };
  frames.erase(std::remove_if(frames.begin(), frames.end(),
                              [&](const FrameWholeness& frame) { return lost(frame) <= 0; }),
               frames.end());
  std::stable_sort(frames.begin(), frames.end(),
                   [&](const auto& a, const auto& b) { return lost(a) > lost(b); });
  frames.resize(std::min(frames.size(), count));
  return frames;
}

}  // namespace eval
