#include "eval/check/check_truth_frames.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "eval/check/check_truth_depth.h"
#include "eval/formats/sequence/frame_truth.h"
#include "eval/formats/sequence/images.h"
#include "eval/formats/sequence/sequence_agreement.h"
#include "eval/formats/stamped_files.h"

namespace eval {
namespace {

const std::string kFrames = "gt/frames.jsonl";
// A box may be given by pixel centres, by pixel edges, or rounded outwards.
constexpr double kBoxRounding_px = 1.0;

/// A list of a frame against the image that shows its ids.
class ListCheck {
 public:
  ListCheck(Folder& folder, int line, std::string list, std::string image_file)
      : folder_(folder),
        line_(line),
        list_(std::move(list)),
        image_file_(std::move(image_file)) {}

  template <typename Visible>
  void Run(const std::vector<Visible>& ids, const cv::Mat& image) {
    std::map<int, PixelSet> seen = PixelsOfIds(image);
    for (std::size_t i = 0; i < ids.size(); ++i) {
      pointer_ = fmt::format("/{}/{}", list_, i);
      if (ids[i].id == 0) continue;  // at fault, which has been told
      CheckEntry(ids[i], seen[ids[i].id]);
      seen.erase(ids[i].id);
    }
    pointer_ = "/" + list_;
    for (const auto& [id, where] : seen) {
      Tell(
          "",
          fmt::format("lacks id {}, which {} shows in {} pixels", id, image_file_, where.count),
          "list every id that the image shows");
    }
  }

 private:
  void Tell(const std::string& key, std::string what, std::string mend) {
    folder_.Tell({kFrames, line_, pointer_ + key, std::move(what), std::move(mend)});
  }

  void CheckEntry(const VisiblePlane& listed, const PixelSet& seen) {
    if (listed.pixels < 0 || listed.pixels == seen.count) return;  // negative: told already
    Tell("/pixels",
         fmt::format("is {}, but {} shows {}", listed.pixels, image_file_, seen.count),
         "count the pixels of the id image");
  }

  void CheckEntry(const VisibleObject& listed, const PixelSet& seen) {
    CheckEntry(static_cast<const VisiblePlane&>(listed), seen);
    if (seen.count == 0 || !listed.visible_box_px) return;
    const Box shown{1.0 * seen.x0, 1.0 * seen.y0, 1.0 * seen.x1, 1.0 * seen.y1};
    for (std::size_t i = 0; i < shown.size(); ++i) {
      if (std::abs((*listed.visible_box_px)[i] - shown[i]) <= kBoxRounding_px) continue;
      Tell("/visible_box",
           fmt::format("is {}, but the id image shows {} to {} by {} to {}",
                       *listed.visible_box_px, seen.x0, seen.x1, seen.y0, seen.y1),
           "compute it from gt/object_id, as x0 y0 x1 y1");
      return;
    }
  }

  Folder& folder_;
  int line_;
  std::string list_, image_file_, pointer_;
};

// The object image must show the owner of the plane that the plane image shows.
void CheckOwners(Folder& folder, const SceneTruth& scene, const cv::Mat& plane_ids,
                 const cv::Mat& object_ids, const std::string& file) {
  if (plane_ids.empty() || object_ids.empty() || plane_ids.size() != object_ids.size()) return;
  long wrong = 0;
  std::set<int> unknown;
  for (int y = 0; y < plane_ids.rows; ++y) {
    for (int x = 0; x < plane_ids.cols; ++x) {
      const int plane = plane_ids.at<unsigned short>(y, x);
      if (plane == 0) continue;
      const TruthPlane* found = scene.FindPlane(plane);
      if (found == nullptr) {
        unknown.insert(plane);
      } else if (found->object != object_ids.at<unsigned short>(y, x)) {
        ++wrong;
      }
    }
  }
  if (wrong > 0) {
    folder.Tell(
        file, 0,
        fmt::format("{} pixels show a plane whose object is not the one in gt/object_id",
                    wrong),
        "render both id images from the same ray");
  }
  for (const int id : unknown) {
    folder.Tell(file, 0, fmt::format("shows plane {}, which is not in gt/scene.json", id),
                "write image and scene from the same truth");
  }
}

/// The image of ids of a frame, by its time; where there is none, what it should be called.
std::string IdFile(const StampedFiles& files, const std::string& folder,
                   const ListedImage& frame) {
  const auto found = files.Find(frame.stamp_s);
  const std::filesystem::path name =
      found ? found->filename() : std::filesystem::path(frame.file).filename();
  return folder + "/" + name.string();
}

/// The lists and id images of the frames, one after the other.
class FramesCheck {
 public:
  FramesCheck(Folder& folder, const SequenceTruth& truth)
      : folder_(folder),
        truth_(truth),
        depth_(folder, truth),
        plane_files_(folder.root() / "gt/plane_id"),
        object_files_(folder.root() / "gt/object_id") {
    for (const ListedImage& image : truth.rgb) images_[image.stamp_s] = image;
    for (const auto& [stamp, image] : images_) stamps_.push_back(stamp);
  }

  void Frame(const FrameTruth& told) {
    const auto near = NearestStamp(stamps_, told.stamp_s, kSameInstant_s);
    if (near) Check(images_.at(stamps_[*near]), &told);  // else it has been told
  }

  /// The id images alone, where gt/frames.jsonl is missing.
  void IdImages() {
    for (const auto& [stamp, image] : images_) Check(image, nullptr);
  }

  void Finish() { depth_.Finish(); }

 private:
  void Check(const ListedImage& image, const FrameTruth* told) {
    const std::string plane_file = IdFile(plane_files_, "gt/plane_id", image);
    const std::string object_file = IdFile(object_files_, "gt/object_id", image);
    const cv::Mat plane_ids = IdImage(plane_files_, plane_file, told);
    const cv::Mat object_ids = IdImage(object_files_, object_file, told);
    const auto& scene = truth_.scene;
    if (told != nullptr && !object_ids.empty()) {
      ListCheck(folder_, told->line, "objects", object_file).Run(told->objects, object_ids);
    }
    if (told != nullptr && !plane_ids.empty()) {
      ListCheck(folder_, told->line, "planes", plane_file).Run(told->planes, plane_ids);
    }
    if (scene) CheckOwners(folder_, *scene, plane_ids, object_ids, plane_file);
    depth_.Frame(image.stamp_s, plane_ids);
  }

  cv::Mat IdImage(const StampedFiles& others, const std::string& file, const FrameTruth* told) {
    const char* const mend = "write the id image of every frame";
    if (folder_.Has(file)) return ReadImage(folder_, file, {CV_16U, 1, truth_.size});
    if (told != nullptr) {
      folder_.Tell(kFrames, told->line, "has no " + file, mend);
    } else if (!others.empty()) {
      folder_.Tell(file, 0, "is missing, though other frames have theirs", mend);
    }
    return {};
  }

  Folder& folder_;
  const SequenceTruth& truth_;
  TruthDepthCheck depth_;
  StampedFiles plane_files_, object_files_;
  std::map<double, ListedImage> images_;
  std::vector<double> stamps_;
};

}  // namespace

void CheckTruthFrames(Folder& folder, const SequenceTruth& truth) {
  FramesCheck frames(folder, truth);
  if (folder.Has(kFrames)) {
    const std::vector<FrameTruth> told = ReadFrameTruth(folder);
    TellFrameTruth(folder, truth.frames_s(), told, truth.scene ? &*truth.scene : nullptr);
    for (const FrameTruth& frame : told) frames.Frame(frame);
  } else {
    frames.IdImages();
  }
  frames.Finish();
}

}  // namespace eval
