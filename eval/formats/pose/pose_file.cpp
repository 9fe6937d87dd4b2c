#include "eval/formats/pose/pose_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "eval/formats/pose/pose_record.h"
#include "eval/formats/pose/trajectory.h"
#include "eval/formats/stamps.h"
#include "io/path_type.h"

namespace eval {
namespace {

constexpr std::size_t kKittiFields = 12;
constexpr std::size_t kEurocFields = 8;  // its own truth has velocities and biases behind them
constexpr double kNanoseconds = 1e9;     // in a second

constexpr StampFaults kAsTheyStand{Severity::kFatal, Severity::kWarning};

/// Fields of a record that was split at blanks, split at commas.
io::TextRecord AtCommas(const io::TextRecord& record) {
  io::TextRecord split{record.where, record.line, {}};
  const std::string text = fmt::format("{}", fmt::join(record.fields, " "));
  const auto trimmed = [](std::string field) {
    field.erase(0, std::min(field.find_first_not_of(' '), field.size()));
    field.erase(field.find_last_not_of(' ') + 1);
    return field;
  };
  for (std::size_t from = 0; from <= text.size();) {
    const std::size_t comma = std::min(text.find(',', from), text.size());
    split.fields.push_back(trimmed(text.substr(from, comma - from)));
    from = comma + 1;
  }
  return split;
}

PoseFileKind KindOf(const std::string& file, Folder& folder, const io::TextRecord& first) {
  const std::size_t fields = first.fields.size();
  for (const std::string& field : first.fields) {
    if (field.find(',') != std::string::npos) return PoseFileKind::kEuroc;
  }
  if (fields == kKittiFields) return PoseFileKind::kKitti;
  if (fields != kTumFields) {
    folder.Tell(file, first.line,
                "expected eight numbers (TUM), twelve (KITTI) or numbers between commas "
                "(EuRoC), found " +
                    std::to_string(fields) + " fields: " + TextOf(first),
                "write `t tx ty tz qx qy qz qw`, seconds and metres, on each line");
  }
  return PoseFileKind::kTum;
}

Trajectory ReadKitti(Folder& folder, const std::string& file,
                     const std::vector<io::TextRecord>& records) {
  Trajectory poses;
  for (const io::TextRecord& record : records) {
    const auto v = NumbersOf(record);
    if (!v || v->size() != kKittiFields) {
      folder.Tell(file, record.line,
                  "expected the first three rows of a pose, twelve finite numbers, found " +
                      TextOf(record),
                  "write r11 r12 r13 tx r21 r22 r23 ty r31 r32 r33 tz");
      continue;
    }
    const Eigen::Map<const Eigen::Matrix<double, 3, 4, Eigen::RowMajor>> rows(v->data());
    const auto T_wc = PoseFrom({folder, file, record.line}, Eigen::Vector3d(rows.col(3)),
                               Eigen::Matrix3d(rows.leftCols<3>()));
    if (T_wc) poses.push_back({static_cast<double>(poses.size()), *T_wc, record.line});
  }
  return poses;
}

std::optional<StampedPose> ReadEurocPose(Folder& folder, const std::string& file,
                                         io::TextRecord record) {
  record = AtCommas(record);
  // Columns behind the pose may be empty.
  if (record.fields.size() > kEurocFields) record.fields.resize(kEurocFields);
  const auto v = NumbersOf(record);
  if (!v || v->size() != kEurocFields) {
    folder.Tell(
        file, record.line,
        "expected `ns, x, y, z, qw, qx, qy, qz`, eight finite numbers, found " + TextOf(record),
        "write what EuRoC's data.csv holds, its header behind a #");
    return std::nullopt;
  }
  if (!(v->front() == std::floor(v->front()))) {
    folder.Tell(file, record.line,
                "expected whole nanoseconds, found " + io::Quoted(record.fields[0]),
                "write stamps as EuRoC does, or poses without commas as TUM does");
    return std::nullopt;
  }
  const Eigen::Vector4d q_xyzw((*v)[5], (*v)[6], (*v)[7], (*v)[4]);
  const auto T_wc =
      PoseFrom({folder, file, record.line}, Eigen::Vector3d(v->data() + 1), q_xyzw);
  if (!T_wc) return std::nullopt;
  return StampedPose{v->front() / kNanoseconds, *T_wc, record.line};
}

Trajectory ReadEuroc(Folder& folder, const std::string& file,
                     const std::vector<io::TextRecord>& records) {
  Trajectory poses;
  StampOrder order(folder, file, kAsTheyStand.disorder, kAsTheyStand.repetition);
  for (const io::TextRecord& record : records) {
    const auto pose = ReadEurocPose(folder, file, record);
    if (!pose) continue;
    order.Next(pose->stamp_s, record.line);
    poses.push_back(*pose);
  }
  order.Finish();
  return poses;
}

Trajectory ReadAs(PoseFileKind kind, Folder& folder, const std::string& file,
                  const std::vector<io::TextRecord>& records) {
  switch (kind) {
    case PoseFileKind::kKitti:
      return ReadKitti(folder, file, records);
    case PoseFileKind::kEuroc:
      return ReadEuroc(folder, file, records);
    case PoseFileKind::kTum:
      break;
  }
  return ReadTrajectory(folder, file, records, kAsTheyStand);
}

}  // namespace

const char* NameOf(PoseFileKind kind) {
  switch (kind) {
    case PoseFileKind::kKitti:
      return "KITTI";
    case PoseFileKind::kEuroc:
      return "EuRoC";
    case PoseFileKind::kTum:
      break;
  }
  return "TUM";
}

PoseFile ReadPoseFile(const std::filesystem::path& path) {
  if (io::TypeAt(path) == std::filesystem::file_type::directory) {
    throw io::InputError(path.string(),
                         "is a folder, expected a file of poses; name its trajectory.txt, or "
                         "score it as a run: pas eval " +
                             path.string());
  }
  Folder folder(path.parent_path());
  const std::string file = path.filename().string();
  const std::vector<io::TextRecord> records = ReadTextRecords(folder, file);
  PoseFile read;
  read.path = path;
  if (!records.empty()) {
    read.kind = KindOf(file, folder, records.front());
    read.poses = ReadAs(read.kind, folder, file, records);
  }
  if (read.poses.size() < 2) {
    folder.Tell(file, 0, read.poses.empty() ? "holds no pose" : "holds a single pose",
                "write a line for each pose; two are needed for a path");
  }
  read.warnings = std::move(folder.faults());
  return read;
}

}  // namespace eval
