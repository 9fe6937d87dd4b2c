#include "eval/check/check_truth_frames.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "eval/check/check_detections.h"
#include "eval/check/check_images.h"
#include "eval/check/check_truth_depth.h"
#include "eval/check/checked_json.h"
#include "eval/check/checked_text.h"

namespace eval {
namespace {

const std::string kFile = "gt/frames.jsonl";
// A box may be given by pixel centres, by pixel edges, or rounded outwards.
constexpr double kBoxRounding_px = 1.0;

/// Where an id is seen in an id image.
struct Seen {
  long pixels = 0;
  int x0 = 1 << 20, y0 = 1 << 20, x1 = -1, y1 = -1;  ///< first and last pixel
};

std::map<int, Seen> CountIds(const cv::Mat& ids) {
  std::map<int, Seen> seen;
  for (int y = 0; y < ids.rows; ++y) {
    const auto* row = ids.ptr<unsigned short>(y);
    for (int x = 0; x < ids.cols; ++x) {
      if (row[x] == 0) continue;
      Seen& id = seen[row[x]];
      ++id.pixels;
      id.x0 = std::min(id.x0, x), id.x1 = std::max(id.x1, x);
      id.y0 = std::min(id.y0, y), id.y1 = std::max(id.y1, y);
    }
  }
  return seen;
}

void CheckVisibleBox(const CheckedJson& record, const Seen& seen) {
  const auto box = record.Numbers("visible_box", 4);
  if (!box) return;
  const std::array<int, 4> first_last{seen.x0, seen.y0, seen.x1, seen.y1};
  for (std::size_t i = 0; i < 4; ++i) {
    if (std::abs((*box)[i] - first_last[i]) <= kBoxRounding_px) continue;
    record.ReportAt(
        "visible_box",
        fmt::format("is [{}, {}, {}, {}], but the id image shows {} to {} by {} to {}",
                    (*box)[0], (*box)[1], (*box)[2], (*box)[3], seen.x0, seen.x1, seen.y0,
                    seen.y1),
        "compute it from gt/object_id, as x0 y0 x1 y1");
    return;
  }
}

// A list of frames.jsonl against the image that shows its ids; `known` are the ids of the
// scene.
template <typename Known>
void CheckSeen(const CheckedJson& record, const std::string& list, const cv::Mat& ids,
               const Known* known, const std::string& image_file) {
  std::map<int, Seen> seen = CountIds(ids);
  for (const CheckedJson& item : record.Items(list)) {
    const auto id = item.Integer("id");
    const auto pixels = item.Integer("pixels");
    if (!id) continue;
    if (known != nullptr && known->count(static_cast<int>(*id)) == 0) {
      item.ReportAt("id", fmt::format("{} is not in gt/scene.json", *id), "mend the id");
    }
    const auto found = seen.find(static_cast<int>(*id));
    const Seen here = found == seen.end() ? Seen{} : found->second;
    if (pixels && *pixels != here.pixels && !ids.empty()) {
      item.ReportAt("pixels",
                    fmt::format("is {}, but {} shows {}", *pixels, image_file, here.pixels),
                    "count the pixels of the id image");
    }
    if (list == "objects" && here.pixels > 0 && item.Has("visible_box")) {
      CheckVisibleBox(item, here);
    }
    seen.erase(static_cast<int>(*id));
  }
  for (const auto& [id, where] : seen) {
    record.ReportAt(
        list,
        fmt::format("lacks id {}, which {} shows in {} pixels", id, image_file, where.pixels),
        "list every id that the image shows");
  }
}

void CheckObjectNumbers(const CheckedJson& record) {
  for (const CheckedJson& object : record.Items("objects")) {
    const auto fraction = object.Number("visible_fraction");
    if (fraction && !(*fraction >= 0 && *fraction <= 1)) {
      object.ReportAt("visible_fraction", fmt::format("is {}; expected 0 to 1", *fraction),
                      "divide visible by amodal pixels");
    }
    if (object.Has("amodal_box")) CheckBox(object, "amodal_box", {}, true);
  }
}

// The object image must show the owner of the plane that the plane image shows.
void CheckOwners(FolderCheck& check, const CheckedScene& scene, const cv::Mat& plane_ids,
                 const cv::Mat& object_ids, const std::string& file) {
  if (plane_ids.empty() || object_ids.empty() || plane_ids.size() != object_ids.size()) return;
  long wrong = 0;
  std::set<int> unknown;
  for (int y = 0; y < plane_ids.rows; ++y) {
    for (int x = 0; x < plane_ids.cols; ++x) {
      const int plane = plane_ids.at<unsigned short>(y, x);
      if (plane == 0) continue;
      const auto found = scene.planes.find(plane);
      if (found == scene.planes.end()) {
        unknown.insert(plane);
      } else if (found->second.object != object_ids.at<unsigned short>(y, x)) {
        ++wrong;
      }
    }
  }
  if (wrong > 0) {
    check.Add(file, 0,
              fmt::format("{} pixels show a plane whose object is not the one in gt/object_id",
                          wrong),
              "render both id images from the same ray");
  }
  for (const int id : unknown) {
    check.Add(file, 0, fmt::format("shows plane {}, which is not in gt/scene.json", id),
              "write image and scene from the same truth");
  }
}

cv::Mat IdImage(FolderCheck& check, const std::string& file, int line, cv::Size size) {
  if (check.Has(file)) return CheckImage(check, file, {CV_16U, 1, size});
  check.Add(kFile, line, "has no " + file, "write the id image of every frame");
  return {};
}

class FramesVisitor {
 public:
  FramesVisitor(FolderCheck& check, const SequenceTruth& truth)
      : check_(check), truth_(truth), order_(check, kFile), depth_(check, truth) {
    for (const ListedImage& image : truth.rgb) images_[image.stamp_s] = image;
    for (const auto& [stamp, image] : images_) stamps_.push_back(stamp);
  }

  void Visit(const CheckedJson& record, int line) {
    CheckObjectNumbers(record);
    const auto stamp = record.Number("timestamp");
    if (!stamp) return;
    order_.Next(*stamp, line);
    const auto near = NearestStamp(stamps_, *stamp, kSameInstant_s);
    if (!near) {
      record.ReportAt("timestamp", fmt::format("{:.6f} is no time of rgb.txt", *stamp),
                      "use the time of the colour image");
      return;
    }
    const ListedImage& image = images_.at(stamps_[*near]);
    done_.insert(image.stamp_s);
    const std::string name = std::filesystem::path(image.file).filename().string();
    const std::string plane_file = "gt/plane_id/" + name, object_file = "gt/object_id/" + name;
    const cv::Mat plane_ids = IdImage(check_, plane_file, line, truth_.size);
    const cv::Mat object_ids = IdImage(check_, object_file, line, truth_.size);
    CheckIds(record, plane_ids, object_ids, plane_file, object_file);
    depth_.Frame(image.stamp_s, plane_ids);
  }

  void Finish() {
    order_.Finish();
    for (const auto& [stamp, image] : images_) {
      if (done_.count(stamp) != 0) continue;
      check_.Add(kFile, 0, fmt::format("lacks the frame {:.6f} of rgb.txt", stamp),
                 "write the truth of every frame");
    }
    depth_.Finish();
  }

 private:
  void CheckIds(const CheckedJson& record, const cv::Mat& plane_ids, const cv::Mat& object_ids,
                const std::string& plane_file, const std::string& object_file) {
    const CheckedScene* scene = truth_.scene ? &*truth_.scene : nullptr;
    if (!object_ids.empty()) {
      CheckSeen(record, "objects", object_ids, scene ? &scene->objects : nullptr, object_file);
    }
    if (!plane_ids.empty()) {
      CheckSeen(record, "planes", plane_ids, scene ? &scene->planes : nullptr, plane_file);
    }
    if (scene) CheckOwners(check_, *scene, plane_ids, object_ids, plane_file);
  }

  FolderCheck& check_;
  const SequenceTruth& truth_;
  StampOrder order_;
  TruthDepthCheck depth_;
  std::map<double, ListedImage> images_;
  std::vector<double> stamps_;
  std::set<double> done_;
};

}  // namespace

void CheckTruthFrames(FolderCheck& check, const SequenceTruth& truth) {
  if (!check.Has(kFile)) return;
  FramesVisitor frames(check, truth);
  VisitJsonLines(check, kFile,
                 [&](const CheckedJson& record, int line) { frames.Visit(record, line); });
  frames.Finish();
}

}  // namespace eval
