#include "slam/run/run_writer.h"

#include <sys/resource.h>

#include <array>
#include <system_error>

#include "io/image/encode_png.h"
#include "io/input_error.h"
#include "slam/base/require.h"
#include "slam/model/map_queries.h"
#include "slam/pose/pose_error.h"
#include "slam/run/frame_record.h"
#include "slam/run/map_file.h"
#include "slam/run/text_number.h"

namespace slam {
namespace {

constexpr const char* kMarker = "run.json";  // which every run folder has
constexpr int kMaxLabel = 255;               // an 8-bit segmentation holds no more

/// Greatest memory that the process has held, MiB.
double PeakMemory_mb() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

const std::string kCovarianceComment =
    "# timestamp c11 c12 c13 c14 c15 c16 c22 ... c66: covariance of xi, T_wc Exp(xi) the true\n"
    "# pose; xi = step along x, y, z (m), turn about x, y, z (rad), axes of the camera; the\n"
    "# upper triangle row by row\n";

std::string TrajectoryText(const std::vector<TimedPose>& poses) {
  std::string text = "# timestamp tx ty tz qx qy qz qw (T_wc, camera to world)\n";
  for (const TimedPose& pose : poses) text += TrajectoryLine(pose.timestamp_s, pose.T_cw);
  return text;
}

std::vector<TimedPose> KeyframeTrajectory(const Map& map) {
  std::vector<TimedPose> poses;
  for (const Keyframe& keyframe : map.keyframes)
    if (!keyframe.culled) poses.push_back({keyframe.timestamp_s, keyframe.T_cw});
  return poses;
}

/// The keys of camera.yaml.
nlohmann::ordered_json CameraJson(const Camera& c) {
  return {{"width", c.width},
          {"height", c.height},
          {"fx", c.fx},
          {"fy", c.fy},
          {"cx", c.cx},
          {"cy", c.cy},
          {"k1", c.k1},
          {"k2", c.k2},
          {"p1", c.p1},
          {"p2", c.p2},
          {"k3", c.k3},
          {"fps", c.fps},
          {"depth_factor", c.depth_factor}};
}

nlohmann::ordered_json StraighteningJson(const StraighteningReport& report) {
  nlohmann::ordered_json json;
  json["applied"] = report.from_frame != kNone;
  if (report.from_frame != kNone) {
    json["from_frame"] = report.from_frame;
    json["rms"] = report.rms;
  }
  if (report.evidence) {
    const WarpEvidence& evidence = *report.evidence;
    json["learnt"] = {{"law", NameOf(evidence.law)},
                      {"epochs", evidence.epochs},
                      {"gain", evidence.gain},
                      {"student_t", evidence.student_t},
                      {"min_student_t", evidence.min_student_t},
                      {"largest_surface", evidence.largest_surface}};
    if (!evidence.worth_it) json["doubt"] = evidence.Doubt();
  }
  return json;
}

nlohmann::ordered_json RegistrationJson(const std::optional<RegistrationEstimate>& estimate) {
  nlohmann::ordered_json json;
  json["applied"] = estimate && !estimate->applied_px.isZero(0.0);
  if (!estimate) return json;
  const auto numbers = [](const Eigen::Vector2d& v) { return std::array{v.x(), v.y()}; };
  json["applied_px"] = numbers(estimate->applied_px);
  json["learnt"] = {{"epochs", estimate->epochs},
                    {"shift_px", numbers(estimate->shift_px)},
                    {"sigma_px", numbers(estimate->sigma_px)},
                    {"grown_px", estimate->grown_px},
                    {"clear", estimate->clear}};
  return json;
}

nlohmann::ordered_json RollingJson(const std::optional<RollingEstimate>& estimate) {
  nlohmann::ordered_json json;
  json["applied_s"] = estimate ? estimate->applied_s : 0.0;
  if (!estimate) return json;
  json["learnt"] = {{"epochs", estimate->epochs},
                    {"read_s", estimate->read_s},
                    {"sigma_s", estimate->sigma_s}};
  return json;
}

}  // namespace

void RunWriter::RequirePlace(const std::filesystem::path& folder, bool force) {
  io::OutputFolder::RequirePlace(folder, kMarker, force);
}

RunWriter::RunWriter(const std::filesystem::path& folder, RunInfo info, Options options)
    : folder_(std::filesystem::absolute(folder)),
      output_(folder, kMarker, options.force),
      info_(std::move(info)),
      options_(options),
      frame_planes_(output_.Path("frame_planes.jsonl")),
      timing_(output_.Path("timing.csv")) {
  std::string header = "timestamp";
  for (const char* name : kModuleNames) header.append(",").append(name);
  timing_.Add(header + '\n');
}

void RunWriter::WriteFrame(const FrameRecord& record) {
  const Frame& frame = record.frame;
  Require(frames_ == 0 || frame.timestamp_s > last_s_,
          "RunWriter::WriteFrame: timestamps must increase");
  const std::string line = FramePlanesRecord(frame, record.tracked, record.state)
                               .dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  if (record.tracked) {
    Require(frame.T_cw.R.allFinite() && frame.T_cw.t.allFinite(),
            "RunWriter::WriteFrame: a tracked pose is not finite");
    ++tracked_;
    covariances_ += CovarianceLine(frame.timestamp_s, WorldErrorCovariance(frame));
  }
  frame_planes_.Add(line + '\n');
  std::string times = StampText(frame.timestamp_s);
  for (const double ms : record.times.ms) times.append(",").append(FiniteNumberText(ms));
  timing_.Add(times + '\n');
  if (options_.save_segmentation) WriteSegmentation(frame);
  refused_.Add(record.refused);
  ++frames_;
  last_s_ = frame.timestamp_s;
}

void RunWriter::WriteSegmentation(const Frame& frame) const {
  Require(frame.planes.size() <= kMaxLabel,
          "RunWriter: more than 255 planes in a frame do not fit an 8-bit segmentation");
  cv::Mat1b labels = frame.plane_labels;
  if (labels.empty()) labels = cv::Mat1b::zeros(frame.gray.size());
  Require(!labels.empty(), "RunWriter: a frame without an image has no segmentation");
  output_.Write("segmentation/" + StampText(frame.timestamp_s) + ".png", io::EncodePng(labels));
}

nlohmann::ordered_json RunWriter::RunJson(const RunEnd& end) const {
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start_;
  nlohmann::ordered_json json;
  json["format"] = "pas-run/1";
  // Relative, so that run and sequence can be moved together; absolute, so that the run can be moved
  // alone.
  const auto absolute = std::filesystem::absolute(info_.sequence).lexically_normal();
  std::error_code unrelated;
  const auto relative = std::filesystem::relative(absolute, folder_, unrelated);
  json["sequence"] = (relative.empty() ? absolute : relative).generic_string();
  json["sequence_absolute"] = absolute.string();
  json["variant"] = info_.variant;
  json["association"] = info_.association;
  json["detector"] = info_.detector;
  json["camera"] = CameraJson(info_.camera);
  json["seed"] = info_.seed;
  json["version"] = info_.version;
  json["options"] = info_.options;
  json["sequence_frames"] = info_.sequence_frames;
  json["interrupted"] = end.interrupted;
  json["frames"] = frames_;
  json["tracked"] = tracked_;
  json["lost"] = frames_ - tracked_;
  for (std::size_t k = 0; k < kPairRefusalNames.size(); ++k)
    json["refused_pairs"][kPairRefusalNames[k]] = refused_.count[k];
  json["depth_warp"] = StraighteningJson(end.straightening);
  json["depth_registration"] = RegistrationJson(end.registration);
  json["rolling_shutter"] = RollingJson(end.rolling_shutter);
  json["warnings"] = end.warnings;
  json["wall_time_s"] = wall.count();
  json["peak_memory_mb"] = PeakMemory_mb();
  return json;
}

void RunWriter::Finish(const Map& map, const RunEnd& end,
                       const std::vector<TimedPose>& trajectory) {
  Require(trajectory.size() == static_cast<std::size_t>(tracked_),
          "RunWriter::Finish: a pose for each tracked frame");
  frame_planes_.Finish();
  timing_.Finish();
  output_.Write("trajectory.txt", TrajectoryText(trajectory));
  output_.Write("trajectory_covariance.txt", kCovarianceComment + covariances_);
  output_.Write("keyframes.txt", TrajectoryText(KeyframeTrajectory(map)));
  output_.Write("map.json", MapAsJson(map));
  output_.Write("map.ply", MapAsPly(map));
  output_.Write(
      "run.json",
      RunJson(end).dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
  output_.Commit();
}

}  // namespace slam
