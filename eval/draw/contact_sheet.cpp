#include "eval/draw/contact_sheet.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "eval/draw/frame_picture.h"
#include "eval/draw/paint.h"
#include "eval/draw/plane_name.h"
#include "eval/draw/run_title.h"
#include "eval/draw/sheet_header.h"
#include "eval/formats/sequence/images.h"
#include "io/input_error.h"

namespace eval {
namespace {

const Colour kPage{40, 34, 31}, kPale{215, 208, 202}, kWarning{90, 110, 255};
constexpr int kTile_px = 600, kGap_px = 14, kCaption_px = 30;
constexpr int kMaxTileHeight_px = 1500;  // an image that is a mere column fills no wall

template <typename Records>
const typename Records::value_type* OfFrame(const Records& records, double frame_s,
                                            bool synthetic) {
  const auto found = FindFrame(StampsOf(records), frame_s, synthetic);
  return found ? &records[*found] : nullptr;
}

FrameScene Collect(const Run& run, const Sequence& sequence, const SequenceFrame& frame,
                   const std::optional<Camera>& camera) {
  FrameScene scene;
  scene.rgb = ReadColour(sequence.folder / frame.rgb);
  if (camera && scene.rgb.size() != cv::Size(camera->width, camera->height)) {
    throw io::InputError(
        (sequence.folder / frame.rgb).string(),
        fmt::format(
            "is {} x {}, the camera {} x {}; restore the image, or name its camera with "
            "--camera",
            scene.rgb.cols, scene.rgb.rows, camera->width, camera->height));
  }
  scene.labels = ReadSegmentation(run, frame.stamp_s);
  if (scene.labels && scene.labels->size() != scene.rgb.size()) {
    throw io::InputError(
        (run.folder / "segmentation").string(),
        fmt::format("the image at {:.6f} s is {} x {}, that of the sequence {} x {}; is "
                    "this the right sequence?",
                    frame.stamp_s, scene.labels->cols, scene.labels->rows, scene.rgb.cols,
                    scene.rgb.rows));
  }
  scene.frame = OfFrame(run.frames, frame.stamp_s, sequence.synthetic);
  const StampedPose* pose = OfFrame(run.trajectory, frame.stamp_s, sequence.synthetic);
  if (pose != nullptr) scene.T_wc = pose->T_wc;
  scene.map = &run.map;
  scene.camera = camera;
  return scene;
}

std::string Counts(const RunFrame* frame, bool tracked) {
  if (frame == nullptr) return "no planes on record";
  if (!tracked) return fmt::format("{} planes", frame->planes.size());
  int counts[4] = {};
  for (const RunFramePlane& plane : frame->planes) ++counts[static_cast<int>(MarkOf(plane))];
  const auto of = [&](DecisionMark mark) { return counts[static_cast<int>(mark)]; };
  return fmt::format("{} planes: {} matched, {} new, {} not trusted", frame->planes.size(),
                     of(DecisionMark::kMatched), of(DecisionMark::kNew),
                     of(DecisionMark::kBad));
}

void PutCaption(cv::Mat& page, cv::Point corner, int width_px, std::size_t index,
                double since_first_s, const FrameScene& scene) {
  const cv::Point2d base(corner.x + 2, corner.y + kCaption_px - 10);
  const TextStyle bold{11, kWhite, true, Align::kLeft};
  const std::string name = fmt::format("frame {}", index);
  PutText(page, name, base, bold);
  const TextStyle plain{10, kPale, false, Align::kLeft};
  const cv::Point2d after = base + cv::Point2d(TextWidth(name, bold) + 14, 0);
  const std::string time = fmt::format("{:.2f} s", since_first_s);
  PutText(page, time, after, plain);
  if (!scene.T_wc) {
    PutText(page, "not tracked", after + cv::Point2d(TextWidth(time, plain) + 14, 0),
            {10, kWarning, true, Align::kLeft});
  }
  PutText(page, Counts(scene.frame, scene.T_wc.has_value()),
          base + cv::Point2d(width_px - 4, 0), {10, kPale, false, Align::kRight});
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

std::size_t FramesSeen(const Run& run, const Sequence& sequence) {
  const std::size_t all = sequence.frames.size();
  if (!run.info.interrupted) return all;
  if (run.frames.empty()) {  // a run without planes counts its frames at least
    return run.info.frames ? std::min(all, static_cast<std::size_t>(*run.info.frames)) : all;
  }
  const double last_s = run.frames.back().stamp_s + kSameStamp_s;
  return static_cast<std::size_t>(
      std::count_if(sequence.frames.begin(), sequence.frames.end(),
                    [&](const SequenceFrame& frame) { return frame.stamp_s <= last_s; }));
}

cv::Mat ContactSheet(const Run& run, const Sequence& sequence,
                     const std::optional<Camera>& camera, int frames) {
  const std::vector<std::size_t> indices =
      SpreadEvenly(FramesSeen(run, sequence), static_cast<std::size_t>(std::max(frames, 1)));
  if (indices.empty()) throw io::InputError(sequence.folder.string(), "has no frames to draw");
  const int columns = std::min(3, static_cast<int>(indices.size()));
  const int rows = (static_cast<int>(indices.size()) + columns - 1) / columns;
  // A single frame has the room of two.
  const int tile_width = columns == 1 ? 2 * kTile_px : kTile_px;
  const int page_width = columns * (tile_width + kGap_px) + kGap_px;
  const SheetHeader header = HeaderOf(TitleOf(run, sequence), run, page_width - 2 * kGap_px);
  const int top = static_cast<int>(HeightOf(header)) + kGap_px;

  cv::Mat page;
  int tile_height = 0;
  for (std::size_t k = 0; k < indices.size(); ++k) {
    const SequenceFrame& frame = sequence.frames[indices[k]];
    const FrameScene scene = Collect(run, sequence, frame, camera);
    const cv::Mat tile = DrawFrame(scene, tile_width);
    if (page.empty()) {
      tile_height = std::min(tile.rows, kMaxTileHeight_px);
      page = cv::Mat(top + rows * (tile_height + kCaption_px + kGap_px), page_width, CV_8UC3,
                     kPage);
    }
    const int column = static_cast<int>(k) % columns, row = static_cast<int>(k) / columns;
    const cv::Point corner(kGap_px + column * (tile_width + kGap_px),
                           top + row * (tile_height + kCaption_px + kGap_px));
    PutCaption(page, corner, tile_width, indices[k],
               frame.stamp_s - sequence.frames.front().stamp_s, scene);
    const cv::Rect place(corner + cv::Point(0, kCaption_px),
                         cv::Size(tile.cols, std::min(tile.rows, tile_height)));
    tile(cv::Rect({0, 0}, place.size())).copyTo(page(place));
  }
  PutHeader(page, header, {kGap_px + 2.0, kGap_px * 1.0});
  return page;
}

}  // namespace eval
