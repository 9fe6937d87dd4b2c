#include "slam/input/sequence_index.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "io/folder_kind.h"
#include "io/input_error.h"
#include "io/number_text.h"
#include "io/path_type.h"
#include "io/text_table.h"
#include "slam/input/pair_images.h"

namespace slam {
namespace {

constexpr double kStampRoundOff_s = 1e-6;  // lists print six decimals
constexpr double kMaxStamp_s = 1e11;  // the year 5138; milliseconds since 1970 are above it

std::vector<io::TextRecord> ReadImages(const std::filesystem::path& file,
                                       const std::string& form) {
  auto records =
      io::ReadRecords(file, form, "a sequence has associations.txt, or rgb.txt and depth.txt");
  if (records.empty())
    throw io::InputError(file.string(), "names no image; expected lines `" + form + "`");
  return records;
}

double StampOf(const io::TextRecord& record, std::size_t field) {
  const std::string& text = record.fields[field];
  const double t = io::ParseNumber(text).value_or(-1);
  if (t < 0)
    throw io::InputError(record.where,
                         "timestamp `" + text + "` is not a number of seconds >= 0");
  if (t < kMaxStamp_s) return t;
  const char* unit = t < 1e3 * kMaxStamp_s   ? "milliseconds: divide by 1e3"
                     : t < 1e6 * kMaxStamp_s ? "microseconds: divide by 1e6"
                                             : "nanoseconds: divide by 1e9";
  throw io::InputError(record.where,
                       "timestamp `" + text + "` is not in seconds; it looks like " + unit);
}

std::string FileOf(const io::TextRecord& record, std::size_t field) {
  const auto path = std::filesystem::path(record.fields[field]).lexically_normal();
  if (path.is_absolute() || path.empty() || *path.begin() == "..")
    throw io::InputError(record.where, "file `" + record.fields[field] +
                                           "` must lie inside the sequence folder");
  return path.generic_string();
}

std::string SourceOf(const io::TextRecord& record) {
  return std::filesystem::path(record.where).filename().string();
}

/// Time goes on from line to line.
class StampOrder {
 public:
  void Next(double t, const io::TextRecord& record, std::size_t field) {
    if (t <= last_) {
      throw io::InputError(
          record.where, "timestamp `" + record.fields[field] + "` " +
                            (t == last_ ? "is that of the line before; drop one of the two"
                                        : "is earlier than that of the line before; sort the "
                                          "lines by time"));
    }
    last_ = t;
  }

 private:
  double last_ = -1;
};

std::vector<SequenceEntry> ReadAssociations(const std::filesystem::path& file) {
  std::vector<SequenceEntry> entries;
  StampOrder order;
  for (const io::TextRecord& r : ReadImages(file, "t_rgb rgb_file t_depth depth_file")) {
    entries.push_back({StampOf(r, 0), StampOf(r, 2), FileOf(r, 1), FileOf(r, 3), SourceOf(r)});
    order.Next(entries.back().timestamp_s, r, 0);
  }
  return entries;
}

std::vector<StampedImage> ReadList(const std::filesystem::path& file) {
  std::vector<StampedImage> images;
  StampOrder order;
  for (const io::TextRecord& r : ReadImages(file, "timestamp file")) {
    images.push_back({StampOf(r, 0), FileOf(r, 1), SourceOf(r)});
    order.Next(images.back().t, r, 0);
  }
  return images;
}

/// "12 of 300 lines of associations.txt (first associations.txt:7)".
std::string LinesText(const Counted& lines, std::size_t all) {
  return std::to_string(lines.count()) + " of " + std::to_string(all) +
         " lines of associations.txt (first " + lines.first() + ")";
}

/// Whether a list that is there has the image under that time.
bool Lists(const std::vector<StampedImage>& list, double t, const std::string& file) {
  if (list.empty()) return true;
  const auto it = std::lower_bound(list.begin(), list.end(), t - kStampRoundOff_s,
                                   [](const StampedImage& s, double x) { return s.t < x; });
  return it != list.end() && it->t <= t + kStampRoundOff_s && it->file == file;
}

/// What is odd about pairs that are given, and yet can be used.
std::vector<std::string> Oddities(const std::filesystem::path& sequence,
                                  const std::vector<SequenceEntry>& entries) {
  const auto list = [&](const char* name) {
    return io::Exists(sequence / name) ? ReadList(sequence / name)
                                       : std::vector<StampedImage>{};
  };
  const std::vector<StampedImage> rgb = list("rgb.txt"), depth = list("depth.txt");
  Counted apart, unlisted;
  double worst_s = 0;
  for (const SequenceEntry& e : entries) {
    const double dt = std::abs(e.timestamp_s - e.depth_timestamp_s);
    worst_s = std::max(worst_s, dt);
    if (dt > kMaxPairing_s + kStampRoundOff_s) apart.Add(e.source);
    if (!Lists(rgb, e.timestamp_s, e.rgb) || !Lists(depth, e.depth_timestamp_s, e.depth)) {
      unlisted.Add(e.source);
    }
  }
  std::vector<std::string> warnings;
  if (apart.count() > 0) {
    warnings.push_back("colour and depth are more than 20 ms apart, up to " +
                       std::to_string(std::lround(1e3 * worst_s)) + " ms, in " +
                       LinesText(apart, entries.size()));
  }
  if (unlisted.count() > 0) {
    warnings.push_back("rgb.txt or depth.txt has not the time and file of " +
                       LinesText(unlisted, entries.size()));
  }
  return warnings;
}

}  // namespace

SequenceIndex IndexSequence(const std::filesystem::path& sequence) {
  io::RequireSequence(sequence);
  if (io::Exists(sequence / "associations.txt")) {
    SequenceIndex index{ReadAssociations(sequence / "associations.txt"), {}};
    index.warnings = Oddities(sequence, index.entries);
    return index;
  }
  const std::vector<StampedImage> rgb = ReadList(sequence / "rgb.txt");
  const std::vector<StampedImage> depth = ReadList(sequence / "depth.txt");
  ImagePairs made = PairImages(rgb, depth);
  SequenceIndex index{{}, std::move(made.warnings)};
  for (const auto& [i, j] : made.pairs) {
    index.entries.push_back({rgb[i].t, depth[j].t, rgb[i].file, depth[j].file, rgb[i].source});
  }
  if (index.entries.empty())
    throw io::InputError(
        sequence.string(),
        "no colour image of rgb.txt has a depth image of depth.txt within 20 ms; "
        "check that both lists use one clock");
  return index;
}

}  // namespace slam
