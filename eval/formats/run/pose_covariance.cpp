#include "eval/formats/run/pose_covariance.h"

#include <algorithm>
#include <optional>

#include "eval/formats/covariance.h"
#include "eval/formats/pose/pose_record.h"
#include "eval/formats/stamps.h"
#include "eval/formats/text_records.h"

namespace eval {
namespace {

constexpr std::size_t kFields = 1 + 21;

/// Nothing when the line is at fault, which is told.
std::optional<PoseCovariance> ReadLine(Folder& folder, const std::string& file,
                                       const io::TextRecord& record) {
  const auto v = NumbersOf(record);
  if (!v || v->size() != kFields) {
    folder.Tell(file, record.line,
                "expected a stamp and 21 finite numbers, found " + TextOf(record),
                "write the upper triangle of the covariance row by row, or drop the line",
                Severity::kWarning);
    return std::nullopt;
  }
  PoseCovariance read{v->front(), Matrix6d::Zero(), record.line};
  std::size_t next = 1;
  for (int i = 0; i < 6; ++i) {
    for (int j = i; j < 6; ++j) read.of_xi(i, j) = read.of_xi(j, i) = (*v)[next++];
  }
  if (!IsCovariance(read.of_xi)) {
    folder.Tell(file, record.line, "is no covariance: some direction has a negative variance",
                "write the upper triangle row by row, metres and radians");
    return std::nullopt;
  }
  return read;
}

}  // namespace

std::optional<std::vector<PoseCovariance>> ReadPoseCovariances(Folder& folder,
                                                               const std::string& file) {
  std::vector<PoseCovariance> covariances;
  StampOrder order(folder, file);
  const auto records = ReadTextRecords(folder, file, Severity::kWarning);
  for (const io::TextRecord& record : records) {
    const auto read = ReadLine(folder, file, record);
    if (!read) continue;
    order.Next(read->stamp_s, read->line);
    covariances.push_back(*read);
  }
  order.Finish();
  if (covariances.empty() && !records.empty()) return std::nullopt;
  std::stable_sort(
      covariances.begin(), covariances.end(),
      [](const PoseCovariance& a, const PoseCovariance& b) { return a.stamp_s < b.stamp_s; });
  return covariances;
}

}  // namespace eval
