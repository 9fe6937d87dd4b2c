#include "eval/formats/run/timing.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <numeric>

#include "eval/formats/stamps.h"
#include "eval/formats/text_records.h"
#include "io/number_text.h"

namespace eval {
namespace {

void CheckHeader(Folder& folder, const std::string& file, const io::TextRecord& header) {
  if (header.fields.front() != "timestamp") {
    folder.Tell(file, header.line, "expected a header \"timestamp,<module>,...\"",
                "write the header timestamp,orb,od,mdc,epi,pp,da,po,upm,mt");
  }
  for (const char* name : {"orb", "od", "mdc", "epi", "pp", "da", "po", "upm", "mt"}) {
    if (std::count(header.fields.begin(), header.fields.end(), name) == 1) continue;
    folder.Tell(file, header.line, fmt::format("has not exactly one column `{}`", name),
                "write the header timestamp,orb,od,mdc,epi,pp,da,po,upm,mt", Severity::kFlaw);
  }
  for (const char* name :
       {"fps", "peak_rss_mb"}) {  // figures of metrics.json beside the modules
    if (std::count(header.fields.begin(), header.fields.end(), name) == 0) continue;
    folder.Tell(file, header.line,
                fmt::format("`{}` is the name of a figure, not of a module", name),
                "rename the column");
  }
}

constexpr double kMax_ms = 1e9;  // eleven days for a frame

/// Numbers of a row; NaN for an empty cell, nothing when one is at fault.
std::optional<std::vector<double>> ReadRow(Folder& folder, const std::string& file,
                                           const io::TextRecord& record,
                                           const std::vector<std::string>& columns) {
  if (record.fields.size() != columns.size()) {
    folder.Tell(file, record.line,
                fmt::format("has {} cells; expected {}", record.fields.size(), columns.size()),
                "write one cell a column");
    return std::nullopt;
  }
  std::vector<double> row;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const std::string& cell = record.fields[i];
    const auto value = cell.empty() && i > 0 ? std::numeric_limits<double>::quiet_NaN()
                                             : io::ParseNumber(cell);
    if (!value || (i > 0 && (*value < 0 || *value > kMax_ms))) {
      folder.Tell(file, record.line, fmt::format("{} is `{}`", columns[i], cell),
                  "write milliseconds, a number from 0 to 1e9");
      return std::nullopt;
    }
    row.push_back(*value);
  }
  return row;
}

}  // namespace

Timing ReadTiming(Folder& folder, const std::string& file) {
  Timing timing;
  const std::vector<io::TextRecord> records = ReadCommaRecords(folder, file);
  if (records.empty()) {
    folder.Tell(file, 0, "is empty", "write the header and a row for each frame");
    return timing;
  }
  const std::vector<std::string>& columns = records.front().fields;
  CheckHeader(folder, file, records.front());
  timing.modules.assign(columns.begin() + 1, columns.end());
  StampOrder order(folder, file, Severity::kWarning, Severity::kWarning);
  for (auto record = records.begin() + 1; record != records.end(); ++record) {
    const auto row = ReadRow(folder, file, *record, columns);
    if (!row) continue;
    // The first row of a frame counts, as the first of any records of one time.
    if (!order.Next(row->front(), record->line)) continue;
    timing.stamps_s.push_back(row->front());
    timing.rows_ms.emplace_back(row->begin() + 1, row->end());
  }
  order.Finish();
  std::vector<std::size_t> by_time(timing.stamps_s.size());
  std::iota(by_time.begin(), by_time.end(), 0);
  std::stable_sort(by_time.begin(), by_time.end(), [&](std::size_t a, std::size_t b) {
    return timing.stamps_s[a] < timing.stamps_s[b];
  });
  Timing sorted{timing.modules, {}, {}};
  for (const std::size_t i : by_time) {
    sorted.stamps_s.push_back(timing.stamps_s[i]);
    sorted.rows_ms.push_back(std::move(timing.rows_ms[i]));
  }
  return sorted;
}

}  // namespace eval
