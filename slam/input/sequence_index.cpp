#include "slam/input/sequence_index.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "io/folder_kind.h"
#include "io/input_error.h"
#include "io/number_text.h"
#include "io/path_type.h"
#include "io/stamp_unit.h"
#include "io/text_table.h"
#include "slam/input/pair_images.h"

namespace slam {
namespace {

constexpr double kStampRoundOff_s = 1e-6;  // lists print six decimals

// Two stamps closer than this are one frame: above the round-off of a six-digit stamp in a double
// (2.4e-7 s at 1.3e9 s), far below any camera's frame time.
constexpr double kSameStamp_s = 1e-5;

std::vector<io::TextRecord> ReadImages(const std::filesystem::path& file,
                                       const std::string& form) {
  auto records = io::ReadRecords(file, form,
                                 "a sequence has associations.txt, or rgb.txt and depth.txt "
                                 "(docs/cameras.md says how to list images)");
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
  if (t < io::kMaxStamp_s) return t;
  const char* unit = t < 1e3 * io::kMaxStamp_s   ? "milliseconds: divide by 1e3"
                     : t < 1e6 * io::kMaxStamp_s ? "microseconds: divide by 1e6"
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

double TimeOf(const StampedImage& image) { return image.t; }
double TimeOf(const SequenceEntry& entry) { return entry.timestamp_s; }
const std::string& LineOf(const StampedImage& image) { return image.source; }
const std::string& LineOf(const SequenceEntry& entry) { return entry.rgb_source; }

/// "12 of 300 lines of associations.txt (first associations.txt:7)".
std::string LinesText(const Counted& lines, std::size_t all, const std::string& list) {
  return std::to_string(lines.count()) + " of " + std::to_string(all) + " lines of " + list +
         " (first " + lines.first() + ")";
}

/// Refuses times since the machine was started in a smaller unit, which are no large numbers.
template <typename Line>
void RequireSeconds(const std::filesystem::path& file, const std::vector<Line>& lines) {
  std::vector<double> stamps_s;
  for (const Line& line : lines) stamps_s.push_back(TimeOf(line));
  if (io::CanBeSeconds(stamps_s)) return;
  constexpr double kMicrosecondsASecond = 1e6;  // a longer step is one of nanoseconds
  const double step = io::MedianStep(stamps_s).value_or(0.0);
  throw io::InputError(file.string(),
                       "the timestamps are not in seconds: the median step is " +
                           std::to_string(std::llround(step)) + "; they look like " +
                           (step < kMicrosecondsASecond ? "microseconds: divide by 1e6"
                                                        : "nanoseconds: divide by 1e9"));
}

/// The lines by rising time, of those with one time the first alone.
/// @param warnings  what that moves or leaves out is added
template <typename Line>
std::vector<Line> InOrderOfTime(const std::vector<Line>& lines, const std::string& list,
                                std::vector<std::string>& warnings) {
  Counted earlier, again;
  for (std::size_t i = 1; i < lines.size(); ++i) {
    if (TimeOf(lines[i]) < TimeOf(lines[i - 1])) earlier.Add(LineOf(lines[i]));
  }
  std::vector<Line> sorted = lines, kept;
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const Line& a, const Line& b) { return TimeOf(a) < TimeOf(b); });
  for (Line& line : sorted) {
    if (!kept.empty() && TimeOf(line) <= TimeOf(kept.back()) + kSameStamp_s) {
      again.Add(LineOf(line));
    } else {
      kept.push_back(std::move(line));
    }
  }
  if (earlier.count() > 0) {
    warnings.push_back("sorted by time, for earlier than the line before are " +
                       LinesText(earlier, lines.size(), list));
  }
  if (again.count() > 0) {
    warnings.push_back("left out, for their stamps come again: " +
                       LinesText(again, lines.size(), list));
  }
  return kept;
}

std::vector<SequenceEntry> ReadAssociations(const std::filesystem::path& file,
                                            std::vector<std::string>& warnings) {
  std::vector<SequenceEntry> entries;
  for (const io::TextRecord& r : ReadImages(file, "t_rgb rgb_file t_depth depth_file")) {
    const std::string source = SourceOf(r);
    entries.push_back(
        {StampOf(r, 0), StampOf(r, 2), FileOf(r, 1), FileOf(r, 3), source, source});
  }
  RequireSeconds(file, entries);
  return InOrderOfTime(entries, file.filename().string(), warnings);
}

std::vector<StampedImage> ReadList(const std::filesystem::path& file,
                                   std::vector<std::string>& warnings) {
  std::vector<StampedImage> images;
  for (const io::TextRecord& r : ReadImages(file, "timestamp file")) {
    images.push_back({StampOf(r, 0), FileOf(r, 1), SourceOf(r)});
  }
  RequireSeconds(file, images);
  return InOrderOfTime(images, file.filename().string(), warnings);
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
  std::vector<std::string> warnings;
  const auto list = [&](const char* name) {
    return io::Exists(sequence / name) ? ReadList(sequence / name, warnings)
                                       : std::vector<StampedImage>{};
  };
  const std::vector<StampedImage> rgb = list("rgb.txt"), depth = list("depth.txt");
  Counted apart, unlisted;
  double worst_s = 0;
  for (const SequenceEntry& e : entries) {
    const double dt = std::abs(e.timestamp_s - e.depth_timestamp_s);
    worst_s = std::max(worst_s, dt);
    if (dt > kMaxPairing_s + kStampRoundOff_s) apart.Add(e.rgb_source);
    if (!Lists(rgb, e.timestamp_s, e.rgb) || !Lists(depth, e.depth_timestamp_s, e.depth)) {
      unlisted.Add(e.rgb_source);
    }
  }
  if (apart.count() > 0) {
    warnings.push_back("colour and depth are more than 20 ms apart, up to " +
                       std::to_string(std::lround(1e3 * worst_s)) + " ms, in " +
                       LinesText(apart, entries.size(), "associations.txt"));
  }
  if (unlisted.count() > 0) {
    warnings.push_back("rgb.txt or depth.txt has not the time and file of " +
                       LinesText(unlisted, entries.size(), "associations.txt"));
  }
  return warnings;
}

}  // namespace

SequenceIndex IndexSequence(const std::filesystem::path& sequence) {
  io::RequireSequence(sequence);
  SequenceIndex index;
  std::vector<std::string>& warnings = index.warnings;
  const auto add = [&warnings](const std::vector<std::string>& more) {
    warnings.insert(warnings.end(), more.begin(), more.end());
  };
  if (io::Exists(sequence / "associations.txt")) {
    index.entries = ReadAssociations(sequence / "associations.txt", warnings);
    add(Oddities(sequence, index.entries));
    return index;
  }
  const std::vector<StampedImage> rgb = ReadList(sequence / "rgb.txt", warnings);
  const std::vector<StampedImage> depth = ReadList(sequence / "depth.txt", warnings);
  const ImagePairs made = PairImages(rgb, depth);
  add(made.warnings);
  for (const auto& [i, j] : made.pairs) {
    index.entries.push_back(
        {rgb[i].t, depth[j].t, rgb[i].file, depth[j].file, rgb[i].source, depth[j].source});
  }
  if (index.entries.empty())
    throw io::InputError(
        sequence.string(),
        "no colour image of rgb.txt has a depth image of depth.txt within 20 ms; "
        "check that both lists use one clock");
  return index;
}

}  // namespace slam
