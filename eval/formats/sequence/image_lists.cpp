#include "eval/formats/sequence/image_lists.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>
#include <tuple>

#include "eval/formats/stamps.h"
#include "eval/formats/text_records.h"
#include "io/number_text.h"

namespace eval {
namespace {

/// Whether the file lies in the folder; else a fault.
bool IsInside(Folder& folder, const std::string& list, int line, const std::string& file) {
  const std::filesystem::path path = std::filesystem::path(file).lexically_normal();
  if (!path.is_absolute() && !path.empty() && *path.begin() != "..") return true;
  folder.Tell(list, line, "names " + file + ", which is outside the folder",
              "write the path relative to the folder");
  return false;
}

/// By rising stamp, the first of equal ones alone.
template <typename Stamped>
void SortByStamp(std::vector<Stamped>& items) {
  std::stable_sort(items.begin(), items.end(),
                   [](const Stamped& a, const Stamped& b) { return a.stamp_s < b.stamp_s; });
  const auto repeated = std::unique(
      items.begin(), items.end(),
      [](const Stamped& a, const Stamped& b) { return b.stamp_s <= a.stamp_s + kSameStamp_s; });
  items.erase(repeated, items.end());
}

}  // namespace

std::vector<ListedImage> ReadImageList(Folder& folder, const std::string& list) {
  std::vector<ListedImage> images;
  if (!folder.Require(list, "list the images as lines of `timestamp file`")) return images;
  StampOrder order(folder, list, Severity::kWarning, Severity::kWarning);
  std::set<std::string> seen;
  for (const io::TextRecord& record : ReadTextRecords(folder, list)) {
    const auto stamp = io::ParseNumber(record.fields[0]);
    if (record.fields.size() != 2 || !stamp) {
      folder.Tell(list, record.line, "expected `timestamp file`, found " + TextOf(record),
                  "write the time in seconds, a blank and the file");
      continue;
    }
    if (!IsInside(folder, list, record.line, record.fields[1])) continue;
    images.push_back({*stamp, record.fields[1], record.line});
    order.Next(*stamp, record.line);
    if (seen.insert(images.back().file).second) continue;
    folder.Tell(list, record.line, "names " + images.back().file + " a second time",
                "drop the line", Severity::kWarning);
  }
  order.Finish();
  if (images.empty()) folder.Tell(list, 0, "lists no image", "list at least one");
  return images;
}

std::vector<SequenceFrame> ReadAssociations(Folder& folder) {
  const std::string file = "associations.txt";
  std::vector<SequenceFrame> frames;
  StampOrder order(folder, file, Severity::kWarning, Severity::kWarning);
  for (const io::TextRecord& record : ReadTextRecords(folder, file)) {
    const std::vector<std::string>& fields = record.fields;
    const auto rgb_s = io::ParseNumber(fields[0]);
    const auto depth_s = fields.size() == 4 ? io::ParseNumber(fields[2]) : std::nullopt;
    if (!rgb_s || !depth_s) {
      folder.Tell(file, record.line,
                  "expected `t_rgb rgb t_depth depth`, found " + TextOf(record),
                  "write two times in seconds, each followed by its file");
      continue;
    }
    if (!IsInside(folder, file, record.line, fields[1]) ||
        !IsInside(folder, file, record.line, fields[3])) {
      continue;
    }
    order.Next(*rgb_s, record.line);
    frames.push_back({*rgb_s, fields[1], *depth_s, fields[3], record.line});
  }
  order.Finish();
  if (frames.empty()) {
    folder.Tell(file, 0, "pairs no images", "pair them, or delete the file to pair by time");
  }
  return frames;
}

std::vector<SequenceFrame> AssociateByTime(Folder& folder, std::vector<ListedImage> rgb,
                                           std::vector<ListedImage> depth) {
  SortByStamp(rgb);
  SortByStamp(depth);
  // All pairs within the limit: time between them, colour, depth.
  std::vector<std::tuple<double, std::size_t, std::size_t>> candidates;
  for (std::size_t i = 0; i < rgb.size(); ++i) {
    auto near = std::lower_bound(
        depth.begin(), depth.end(), rgb[i].stamp_s - kMaxAssociation_s,
        [](const ListedImage& image, double stamp_s) { return image.stamp_s < stamp_s; });
    for (; near != depth.end(); ++near) {
      const double apart_s = near->stamp_s - rgb[i].stamp_s;
      if (!(apart_s < kMaxAssociation_s)) break;
      if (!(std::abs(apart_s) < kMaxAssociation_s)) continue;
      candidates.emplace_back(std::abs(apart_s), i, near - depth.begin());
    }
  }
  // The nearest pairs first, each image once.
  std::sort(candidates.begin(), candidates.end());
  std::vector<const ListedImage*> depth_of(rgb.size(), nullptr);
  std::vector<bool> taken(depth.size(), false);
  for (const auto& [apart_s, i, j] : candidates) {
    if (depth_of[i] != nullptr || taken[j]) continue;
    depth_of[i] = &depth[j];
    taken[j] = true;
  }
  std::vector<SequenceFrame> frames;
  for (std::size_t i = 0; i < rgb.size(); ++i) {
    if (depth_of[i] == nullptr) continue;
    frames.push_back({rgb[i].stamp_s, rgb[i].file, depth_of[i]->stamp_s, depth_of[i]->file});
  }
  if (frames.empty() && !rgb.empty() && !depth.empty()) {
    folder.Tell("depth.txt", 0, "no depth image is within 20 ms of a colour image",
                "bring both lists to one clock, or give the pairs in associations.txt");
  }
  return frames;
}

std::vector<SequenceFrame> ReadFrames(Folder& folder) {
  if (!folder.Has("associations.txt")) {
    const std::vector<ListedImage> depth = ReadImageList(folder, "depth.txt");
    return AssociateByTime(folder, ReadImageList(folder, "rgb.txt"), depth);
  }
  std::vector<SequenceFrame> frames = ReadAssociations(folder);
  SortByStamp(frames);
  return frames;
}

}  // namespace eval
