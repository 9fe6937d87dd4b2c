#include "eval/formats/sequence/frame_truth.h"

#include <algorithm>

#include "eval/formats/sequence/scene_truth.h"
#include "eval/formats/stamps.h"

namespace eval {
namespace {

VisibleObject ReadVisibleObject(const JsonRecord& record) {
  VisibleObject object;
  object.id = record.Integer("id", 1, kMaxId).value_or(0);
  object.pixels = record.Integer("pixels", 0).value_or(-1);
  // What nothing shows of has no box.
  const JsonRecord box_holder = object.pixels > 0 ? record.Expected() : record.Optional();
  object.visible_box_px = ReadBox(box_holder, "visible_box", {}, true);
  // In no figure; wrong ones are told.
  ReadBox(box_holder, "amodal_box", {}, true);
  record.Expected().Number("visible_fraction", io::Interval("[0, 1]"));
  return object;
}

}  // namespace

std::vector<FrameTruth> ReadFrameTruth(Folder& folder) {
  const std::string file = "gt/frames.jsonl";
  std::vector<FrameTruth> frames;
  StampOrder order(folder, file);
  VisitJsonLines(folder, file, [&](const JsonRecord& root) {
    FrameTruth frame;
    frame.line = root.line();
    for (const JsonRecord& record : root.Items("objects")) {
      frame.objects.push_back(ReadVisibleObject(record));
    }
    for (const JsonRecord& record : root.Items("planes")) {
      frame.planes.push_back({record.Integer("id", 1, kMaxId).value_or(0),
                              record.Integer("pixels", 0).value_or(-1)});
    }
    const auto stamp_s = root.Number("timestamp");
    if (!stamp_s) return;
    order.Next(*stamp_s, root.line());
    frame.stamp_s = *stamp_s;
    frames.push_back(std::move(frame));
  });
  order.Finish();
  std::stable_sort(frames.begin(), frames.end(), [](const FrameTruth& a, const FrameTruth& b) {
    return a.stamp_s < b.stamp_s;
  });
  return frames;
}

}  // namespace eval
