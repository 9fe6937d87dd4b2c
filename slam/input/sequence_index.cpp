#include "slam/input/sequence_index.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "io/folder_kind.h"
#include "io/input_error.h"
#include "io/number_text.h"
#include "io/path_type.h"
#include "io/text_table.h"

namespace slam {
namespace {

constexpr double kMaxPairing_s = 0.02;  // TUM's associate.py
constexpr double kMaxStamp_s = 1e11;    // the year 5138; milliseconds since 1970 are above it

/// One image of rgb.txt or depth.txt.
struct Stamped {
  double t = 0;
  std::string file, source;
};

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

std::vector<SequenceEntry> ReadAssociations(const std::filesystem::path& file) {
  std::vector<SequenceEntry> entries;
  for (const io::TextRecord& r : ReadImages(file, "t_rgb rgb_file t_depth depth_file"))
    entries.push_back({StampOf(r, 0), StampOf(r, 2), FileOf(r, 1), FileOf(r, 3), SourceOf(r)});
  return entries;
}

std::vector<Stamped> ReadList(const std::filesystem::path& file) {
  std::vector<Stamped> images;
  for (const io::TextRecord& r : ReadImages(file, "timestamp file"))
    images.push_back({StampOf(r, 0), FileOf(r, 1), SourceOf(r)});
  return images;
}

/// One more of a kind: "3 frames left out: timestamp repeated, first at rgb.txt:12".
void Count(int& count, const std::string& what, const std::string& source,
           SequenceWarnings& warnings) {
  const std::string rest = what + ", first at ";
  ++count;
  for (std::string& line : warnings.text) {
    const std::size_t at = line.find(rest);
    if (at == std::string::npos) continue;
    line = std::to_string(count).append(" ").append(line.substr(at));
    return;
  }
  warnings.text.push_back("1 " + rest + source);
}

/// Positions of a longest strictly increasing subsequence of `t`; of several the one that is
/// first in dictionary order of positions. O(n log n).
std::vector<std::size_t> LongestIncreasing(const std::vector<double>& t) {
  const std::size_t n = t.size();
  std::vector<std::size_t> length(n);  // longest that starts at i
  std::vector<double> best;            // best[k]: largest start of those of length k + 1
  for (std::size_t i = n; i-- > 0;) {
    const auto it = std::lower_bound(best.begin(), best.end(), t[i],
                                     [](double start, double x) { return start > x; });
    length[i] = static_cast<std::size_t>(it - best.begin()) + 1;
    if (it == best.end())
      best.push_back(t[i]);
    else
      *it = std::max(*it, t[i]);
  }
  // From the front: the first that can still be followed by as many as are wanted.
  std::vector<std::size_t> chosen;
  std::size_t wanted = best.size();
  for (std::size_t i = 0; i < n && wanted > 0; ++i) {
    if (length[i] != wanted || (!chosen.empty() && !(t[i] > t[chosen.back()]))) continue;
    chosen.push_back(i);
    --wanted;
  }
  return chosen;
}

/// Leaves out what repeats or goes back. `Item` has the stamp `stamp(item)` and a source.
template <typename Item, typename Stamp>
std::vector<Item> InOrder(const std::vector<Item>& items, Stamp stamp, SequenceWarnings& w) {
  std::vector<double> t;
  t.reserve(items.size());
  for (const Item& item : items) t.push_back(stamp(item));
  std::vector<Item> kept;
  std::size_t next = 0;
  const std::vector<std::size_t> chosen = LongestIncreasing(t);
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (next < chosen.size() && chosen[next] == i) {
      kept.push_back(items[i]);
      ++next;
    } else if (!kept.empty() && t[i] == stamp(kept.back())) {
      Count(w.repeated, "frames left out: timestamp repeated", items[i].source, w);
    } else {
      Count(w.out_of_order, "frames left out: timestamp out of order", items[i].source, w);
    }
  }
  return kept;
}

/// Pairs colour and depth by nearest time, one to one, nearest pairs first.
std::vector<SequenceEntry> Pair(const std::vector<Stamped>& rgb, std::vector<Stamped> depth,
                                SequenceWarnings& w) {
  std::stable_sort(depth.begin(), depth.end(),
                   [](const Stamped& a, const Stamped& b) { return a.t < b.t; });
  // All pairs within the limit: time between them, colour, depth.
  std::vector<std::tuple<double, std::size_t, std::size_t>> candidates;
  for (std::size_t i = 0; i < rgb.size(); ++i) {
    auto it = std::lower_bound(depth.begin(), depth.end(), rgb[i].t - kMaxPairing_s,
                               [](const Stamped& d, double t) { return d.t < t; });
    double last = -1;
    for (; it != depth.end() && it->t < rgb[i].t + kMaxPairing_s; ++it) {
      const double dt = std::abs(it->t - rgb[i].t);
      if (it->t == last || !(dt < kMaxPairing_s))
        continue;  // a repeated depth stamp: the first
      candidates.emplace_back(dt, i, static_cast<std::size_t>(it - depth.begin()));
      last = it->t;
    }
  }
  // The nearest pairs first, each image once.
  std::sort(candidates.begin(), candidates.end());
  constexpr std::size_t kFree = static_cast<std::size_t>(-1);
  std::vector<std::size_t> depth_of(rgb.size(), kFree);
  std::vector<bool> taken(depth.size(), false);
  for (const auto& [dt, i, j] : candidates) {
    if (depth_of[i] != kFree || taken[j]) continue;
    depth_of[i] = j;
    taken[j] = true;
  }
  // Frames in the order of the colour images; what is left over is counted.
  std::vector<SequenceEntry> entries;
  for (std::size_t i = 0; i < rgb.size(); ++i) {
    if (depth_of[i] == kFree) {
      Count(w.unpaired_rgb, "colour images without depth within 20 ms", rgb[i].source, w);
      continue;
    }
    const Stamped& d = depth[depth_of[i]];
    entries.push_back({rgb[i].t, d.t, rgb[i].file, d.file, rgb[i].source});
  }
  for (std::size_t j = 0; j < depth.size(); ++j)
    if (!taken[j])
      Count(w.unpaired_depth, "depth images without colour within 20 ms", depth[j].source, w);
  return entries;
}

}  // namespace

SequenceIndex IndexSequence(const std::filesystem::path& sequence) {
  io::RequireSequence(sequence);
  SequenceIndex index;
  SequenceWarnings& w = index.warnings;
  if (io::Exists(sequence / "associations.txt")) {
    index.entries = InOrder(
        ReadAssociations(sequence / "associations.txt"),
        [](const SequenceEntry& e) { return e.timestamp_s; }, w);
  } else {
    const auto rgb = InOrder(
        ReadList(sequence / "rgb.txt"), [](const Stamped& s) { return s.t; }, w);
    index.entries = Pair(rgb, ReadList(sequence / "depth.txt"), w);
    if (index.entries.empty())
      throw io::InputError(
          sequence.string(),
          "no colour image of rgb.txt has a depth image of depth.txt within 20 ms; "
          "check that both lists use one clock");
  }
  return index;
}

}  // namespace slam
