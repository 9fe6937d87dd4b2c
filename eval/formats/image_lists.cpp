#include "eval/formats/image_lists.h"

#include <algorithm>
#include <set>

#include "eval/formats/stamps.h"
#include "eval/formats/text_records.h"
#include "io/number_text.h"

namespace eval {
namespace {

void SortImages(std::vector<ListedImage>& images) {
  std::stable_sort(
      images.begin(), images.end(),
      [](const ListedImage& a, const ListedImage& b) { return a.stamp_s < b.stamp_s; });
}

}  // namespace

std::vector<ListedImage> ReadImageList(Folder& folder, const std::string& list) {
  std::vector<ListedImage> images;
  if (!folder.Require(list, "list the images as lines of `timestamp file`")) return images;
  StampOrder order(folder, list);
  std::set<std::string> seen;
  for (const io::TextRecord& record : ReadTextRecords(folder, list)) {
    const auto stamp = io::ParseNumber(record.fields[0]);
    if (record.fields.size() != 2 || !stamp) {
      folder.Tell(list, record.line, "expected `timestamp file`, found " + TextOf(record),
                  "write the time in seconds, a blank and the file");
      continue;
    }
    images.push_back({*stamp, record.fields[1], record.line});
    order.Next(*stamp, record.line);
    if (seen.insert(images.back().file).second) continue;
    folder.Tell(list, record.line, "names " + images.back().file + " a second time",
                "drop the line", Severity::kFlaw);
  }
  order.Finish();
  if (images.empty()) {
    folder.Tell(list, 0, "lists no image", "list at least one", Severity::kFlaw);
  }
  return images;
}

std::vector<SequenceFrame> ReadAssociations(Folder& folder) {
  const std::string file = "associations.txt";
  std::vector<SequenceFrame> frames;
  StampOrder order(folder, file);
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
    order.Next(*rgb_s, record.line);
    frames.push_back({*rgb_s, fields[1], *depth_s, fields[3], record.line});
  }
  order.Finish();
  if (frames.empty()) {
    folder.Tell(file, 0, "pairs no images", "pair them, or delete the file to pair by time",
                Severity::kFlaw);
  }
  return frames;
}

std::vector<SequenceFrame> AssociateByTime(std::vector<ListedImage> rgb,
                                           std::vector<ListedImage> depth) {
  SortImages(rgb);
  SortImages(depth);
  const std::vector<double> stamps_s = StampsOf(depth);
  std::vector<SequenceFrame> frames;
  for (const ListedImage& image : rgb) {
    const auto near = NearestStamp(stamps_s, image.stamp_s, kMaxAssociation_s);
    if (!near) continue;
    frames.push_back({image.stamp_s, image.file, depth[*near].stamp_s, depth[*near].file});
  }
  return frames;
}

}  // namespace eval
