#include "eval/check/check_image_lists.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "eval/formats/sequence/images.h"

namespace eval {
namespace {

constexpr double kStampRoundOff_s = 1e-6;  // stamps are printed with six decimals

// An association must name an image that its list has under that time.
void CheckAgainstList(Folder& folder, const ListedImage& image, const std::string& list,
                      const std::vector<ListedImage>& images) {
  const bool listed = std::any_of(images.begin(), images.end(), [&](const ListedImage& other) {
    return other.file == image.file &&
           std::abs(other.stamp_s - image.stamp_s) <= kStampRoundOff_s;
  });
  if (listed) return;
  folder.Tell("associations.txt", image.line,
              fmt::format("{:.6f} {} is not in {}", image.stamp_s, image.file, list),
              "make the associations from the lists again, or delete associations.txt");
}

void CheckApart(Folder& folder, const SequenceFrame& frame) {
  const double apart_s = std::abs(frame.stamp_s - frame.depth_stamp_s);
  if (apart_s <= kMaxAssociation_s + kStampRoundOff_s) return;
  folder.Tell(
      "associations.txt", frame.line,
      fmt::format("colour and depth are {:.1f} ms apart; at most {:.0f} ms belong together",
                  apart_s * 1e3, kMaxAssociation_s * 1e3),
      "drop the line or pair the colour image with a nearer depth image");
}

}  // namespace

void CheckListedFiles(Folder& folder, const std::string& list,
                      const std::vector<ListedImage>& images) {
  for (const ListedImage& image : images) {
    if (folder.Has(image.file)) continue;
    folder.Tell(list, image.line, "names " + image.file + ", which does not exist",
                "restore the image or drop the line");
  }
}

cv::Size CheckListedImages(Folder& folder, const std::vector<ListedImage>& rgb,
                           const std::vector<ListedImage>& depth, cv::Size size) {
  std::set<std::string> done;
  const auto check_all = [&](const std::vector<ListedImage>& images, const ImageKind& kind) {
    for (const ListedImage& listed : images) {
      // A missing one is the list's fault, told there.
      if (!folder.Has(listed.file) || !done.insert(listed.file).second) continue;
      ImageKind wanted = kind;
      wanted.size = size;
      const cv::Mat image = ReadImage(folder, listed.file, wanted);
      if (size.empty()) size = image.size();
    }
  };
  check_all(rgb, {CV_8U, kAnyColour, {}});
  check_all(depth, {CV_16U, 1, {}});
  return size;
}

std::vector<ListedImage> ReadListOrPairs(Folder& folder, const std::string& list) {
  if (folder.Has(list) || !folder.Has("associations.txt")) return ReadImageList(folder, list);
  Folder apart(folder.root(), OnFault::kCollect);  // what is wrong with it is told elsewhere
  std::vector<ListedImage> images;
  for (const SequenceFrame& frame : ReadAssociations(apart)) {
    images.push_back(list == "rgb.txt"
                         ? ListedImage{frame.stamp_s, frame.rgb, frame.line}
                         : ListedImage{frame.depth_stamp_s, frame.depth, frame.line});
  }
  return images;
}

std::vector<SequenceFrame> CheckAssociations(Folder& folder,
                                             const std::vector<ListedImage>& rgb,
                                             const std::vector<ListedImage>& depth) {
  if (!folder.Has("associations.txt")) return AssociateByTime(folder, rgb, depth);
  std::vector<SequenceFrame> frames = ReadAssociations(folder);
  for (const SequenceFrame& frame : frames) {
    CheckAgainstList(folder, {frame.stamp_s, frame.rgb, frame.line}, "rgb.txt", rgb);
    CheckAgainstList(folder, {frame.depth_stamp_s, frame.depth, frame.line}, "depth.txt",
                     depth);
    CheckApart(folder, frame);
  }
  return frames;
}

}  // namespace eval
