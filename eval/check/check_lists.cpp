#include "eval/check/check_lists.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "eval/check/checked_text.h"
#include "io/number_text.h"

namespace eval {
namespace {

constexpr double kMaxPairDifference_s = 0.02;  // formats.md, associations.txt
constexpr double kStampRoundOff_s = 1e-6;      // stamps are printed with six decimals

bool Escapes(const std::string& file) {
  const std::filesystem::path path = std::filesystem::path(file).lexically_normal();
  return path.is_absolute() || (!path.empty() && *path.begin() == "..");
}

void CheckListedFile(FolderCheck& check, const std::string& list, const ListedImage& image) {
  if (Escapes(image.file)) {
    check.Add(list, image.line, "names " + image.file + ", which is outside the folder",
              "write the path relative to the folder");
  } else if (!check.Has(image.file)) {
    check.Add(list, image.line, "names " + image.file + ", which does not exist",
              "restore the image or drop the line");
  }
}

std::vector<double> Stamps(const std::vector<ListedImage>& images) {
  std::vector<double> stamps;
  for (const ListedImage& image : images) stamps.push_back(image.stamp_s);
  return stamps;
}

// Reports when an association names an image that its list does not have under that time.
void CheckAgainstList(FolderCheck& check, const ListedImage& image, const std::string& list,
                      const std::vector<ListedImage>& images) {
  const bool listed = std::any_of(images.begin(), images.end(), [&](const ListedImage& other) {
    return other.file == image.file &&
           std::abs(other.stamp_s - image.stamp_s) <= kStampRoundOff_s;
  });
  if (listed) return;
  check.Add("associations.txt", image.line,
            fmt::format("{:.6f} {} is not in {}", image.stamp_s, image.file, list),
            "make the associations from the lists again, or delete associations.txt");
}

void CheckPair(FolderCheck& check, const ListedPair& pair) {
  const double apart = std::abs(pair.rgb.stamp_s - pair.depth.stamp_s);
  if (apart <= kMaxPairDifference_s + kStampRoundOff_s) return;
  check.Add("associations.txt", pair.rgb.line,
            fmt::format("colour and depth are {:.1f} ms apart; at most 20 ms belong together",
                        apart * 1e3),
            "drop the line or pair the colour image with a nearer depth image");
}

std::vector<ListedPair> PairByTime(FolderCheck& check, const std::vector<ListedImage>& rgb,
                                   const std::vector<ListedImage>& depth) {
  std::vector<ListedPair> pairs;
  std::vector<double> stamps = Stamps(depth);
  if (!std::is_sorted(stamps.begin(), stamps.end())) return pairs;  // reported already
  for (const ListedImage& image : rgb) {
    const auto near = NearestStamp(stamps, image.stamp_s, kMaxPairDifference_s);
    if (near) pairs.push_back({image, depth[*near]});
  }
  if (pairs.empty() && !rgb.empty() && !depth.empty()) {
    check.Add("depth.txt", 0, "no depth image is within 20 ms of a colour image",
              "bring both lists to one clock, or give the pairs in associations.txt");
  }
  return pairs;
}

}  // namespace

std::vector<ListedImage> CheckImageList(FolderCheck& check, const std::string& list) {
  std::vector<ListedImage> images;
  if (!check.Require(list, "list the images as lines of `timestamp file`")) return images;
  StampOrder order(check, list);
  std::set<std::string> seen;
  for (const CheckedLine& line : RecordsToCheck(check, list)) {
    const auto stamp = io::ParseNumber(line.words[0]);
    if (line.words.size() != 2 || !stamp) {
      check.Add(list, line.number, "expected `timestamp file`, found `" + line.text + "`",
                "write the time in seconds, a blank and the file");
      continue;
    }
    const ListedImage image{*stamp, line.words[1], line.number};
    order.Next(*stamp, line.number);
    if (!seen.insert(image.file).second) {
      check.Add(list, line.number, "names " + image.file + " a second time", "drop the line");
    }
    CheckListedFile(check, list, image);
    images.push_back(image);
  }
  order.Finish();
  if (images.empty()) check.Add(list, 0, "lists no image", "list at least one");
  return images;
}

std::vector<ListedPair> CheckAssociations(FolderCheck& check,
                                          const std::vector<ListedImage>& rgb,
                                          const std::vector<ListedImage>& depth) {
  const std::string file = "associations.txt";
  if (!check.Has(file)) return PairByTime(check, rgb, depth);
  std::vector<ListedPair> pairs;
  StampOrder order(check, file);
  for (const CheckedLine& line : RecordsToCheck(check, file)) {
    const auto rgb_s = io::ParseNumber(line.words[0]);
    const auto depth_s =
        line.words.size() == 4 ? io::ParseNumber(line.words[2]) : std::optional<double>();
    if (!rgb_s || !depth_s) {
      check.Add(file, line.number,
                "expected `t_rgb rgb t_depth depth`, found `" + line.text + "`",
                "write two times in seconds, each followed by its file");
      continue;
    }
    const ListedPair pair{{*rgb_s, line.words[1], line.number},
                          {*depth_s, line.words[3], line.number}};
    order.Next(*rgb_s, line.number);
    CheckAgainstList(check, pair.rgb, "rgb.txt", rgb);
    CheckAgainstList(check, pair.depth, "depth.txt", depth);
    CheckPair(check, pair);
    pairs.push_back(pair);
  }
  order.Finish();
  if (pairs.empty()) {
    check.Add(file, 0, "pairs no images", "pair them, or delete the file to pair by time");
  }
  return pairs;
}

}  // namespace eval
