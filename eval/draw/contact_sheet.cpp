#include "eval/draw/contact_sheet.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "eval/draw/frame_picture.h"
#include "eval/draw/paint.h"
#include "eval/formats/images.h"
#include "io/input_error.h"

namespace eval {
namespace {

const Colour kPage{40, 34, 31}, kPale{215, 208, 202}, kWarning{90, 110, 255};
constexpr int kTile_px = 600, kGap_px = 14, kCaption_px = 28, kHeader_px = 84;

template <typename Items, typename Stamp>
const typename Items::value_type* FindByStamp(const Items& items, double stamp_s,
                                              Stamp stamp_of) {
  const auto found = std::find_if(items.begin(), items.end(), [&](const auto& item) {
    return std::abs(stamp_of(item) - stamp_s) < kSameStamp_s;
  });
  return found == items.end() ? nullptr : &*found;
}

FrameScene Collect(const Run& run, const Sequence& sequence, const SequenceFrame& frame,
                   const std::optional<Camera>& camera) {
  FrameScene scene;
  scene.rgb = ReadColour(sequence.folder / frame.rgb);
  scene.labels = ReadSegmentation(run, frame.stamp_s);
  scene.frame = FindByStamp(run.frames, frame.stamp_s, [](const auto& f) { return f.stamp_s; });
  const StampedPose* pose =
      FindByStamp(run.trajectory, frame.stamp_s, [](const auto& p) { return p.stamp_s; });
  if (pose != nullptr) scene.T_wc = pose->T_wc;
  scene.map = &run.map;
  scene.camera = camera;
  return scene;
}

std::string Counts(const RunFrame* frame) {
  if (frame == nullptr) return "";
  int matched = 0, made = 0, bad = 0;
  for (const RunFramePlane& plane : frame->planes) {
    if (plane.bad) {
      ++bad;
    } else {
      matched += plane.decision == "matched";
      made += plane.decision == "new";
    }
  }
  return fmt::format("{} planes: {} matched, {} new, {} bad", frame->planes.size(), matched,
                     made, bad);
}

void PutCaption(cv::Mat& page, cv::Point corner, std::size_t index, double stamp_s,
                const FrameScene& scene) {
  const cv::Point2d base(corner.x + 2, corner.y + kCaption_px - 9);
  const TextStyle bold{10, kWhite, true, Align::kLeft};
  const std::string name = fmt::format("frame {}", index);
  PutText(page, name, base, bold);
  const TextStyle plain{9.5, kPale, false, Align::kLeft};
  const cv::Point2d after = base + cv::Point2d(TextWidth(name, bold) + 14, 0);
  const std::string time = fmt::format("{:.6f} s", stamp_s);
  PutText(page, time, after, plain);
  if (!scene.T_wc) {
    PutText(page, "not tracked", after + cv::Point2d(TextWidth(time, plain) + 14, 0),
            {9.5, kWarning, true, Align::kLeft});
  }
  PutText(page, Counts(scene.frame), base + cv::Point2d(kTile_px - 4, 0),
          {9.5, kPale, false, Align::kRight});
}

void PutHeader(cv::Mat& page, const Run& run, const Sequence& sequence, int planes) {
  const std::string run_name =
      std::filesystem::absolute(run.folder).lexically_normal().string();
  const std::string title = fmt::format(
      "{}  on  {}", std::filesystem::path(run_name).filename().string(),
      std::filesystem::absolute(sequence.folder).lexically_normal().filename().string());
  PutText(page, title, {kGap_px + 2.0, 38}, {15, kWhite, true, Align::kLeft});
  PutText(page,
          fmt::format("variant {}   tracked {} of {} frames   {} map planes",
                      run.info.variant.empty() ? "?" : run.info.variant, run.trajectory.size(),
                      sequence.frames.size(), planes),
          {kGap_px + 2.0, 66}, {10.5, kPale, false, Align::kLeft});
  double x = page.cols - kGap_px;
  const std::vector<std::pair<Colour, const char*>> marks{{kOpenMark, "no decision"},
                                                          {kBadMark, "bad, with the reason"},
                                                          {kNewMark, "new map plane"},
                                                          {kMatchedMark, "matched"}};
  const TextStyle style{10.5, kPale, false, Align::kLeft};
  for (const auto& [colour, text] : marks) {
    x -= TextWidth(text, style);
    PutText(page, text, {x, 66}, style);
    PutDot(page, {x - 12, 61}, 4.5, colour);
    x -= 40;
  }
  PutText(page, "chip: map plane and class; colour: the map plane",
          {page.cols - kGap_px * 1.0, 38}, {10.5, kPale, false, Align::kRight});
}

int LivePlanes(const Run& run) {
  return static_cast<int>(std::count_if(run.map.begin(), run.map.end(), [](const auto& plane) {
    return !plane.merged_into.has_value();
  }));
}

}  // namespace

std::vector<std::size_t> SpreadEvenly(std::size_t total, std::size_t count) {
  std::vector<std::size_t> indices;
  count = std::min(total, count);
  for (std::size_t i = 0; i < count; ++i) {
    indices.push_back(count == 1 ? 0 : (i * (total - 1) + (count - 1) / 2) / (count - 1));
  }
  return indices;
}

cv::Mat ContactSheet(const Run& run, const Sequence& sequence,
                     const std::optional<Camera>& camera, int frames) {
  const std::vector<std::size_t> indices =
      SpreadEvenly(sequence.frames.size(), static_cast<std::size_t>(std::max(frames, 1)));
  const int columns = std::max(1, std::min(3, static_cast<int>(indices.size())));
  const int rows = (static_cast<int>(indices.size()) + columns - 1) / columns;
  cv::Mat page;
  int tile_height = 0;
  for (std::size_t k = 0; k < indices.size(); ++k) {
    const SequenceFrame& frame = sequence.frames[indices[k]];
    const FrameScene scene = Collect(run, sequence, frame, camera);
    const cv::Mat tile = DrawFrame(scene, kTile_px);
    if (page.empty()) {
      tile_height = tile.rows;
      page = cv::Mat(kHeader_px + rows * (tile_height + kCaption_px + kGap_px),
                     std::max(columns, 2) * (kTile_px + kGap_px) + kGap_px, CV_8UC3, kPage);
    }
    const int column = static_cast<int>(k) % columns, row = static_cast<int>(k) / columns;
    const cv::Point corner(kGap_px + column * (kTile_px + kGap_px),
                           kHeader_px + row * (tile_height + kCaption_px + kGap_px));
    PutCaption(page, corner, indices[k], frame.stamp_s, scene);
    const cv::Rect place = cv::Rect(corner + cv::Point(0, kCaption_px), tile.size()) &
                           cv::Rect({0, 0}, page.size());
    tile(cv::Rect({0, 0}, place.size())).copyTo(page(place));
  }
  if (page.empty()) throw io::InputError(sequence.folder.string(), "has no frames to draw");
  PutHeader(page, run, sequence, LivePlanes(run));
  return page;
}

}  // namespace eval
