#pragma once

#include <gtest/gtest.h>
#include <Eigen/Geometry>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "slam/run/run_sequence.h"
#include "tests/support/fault_stream.h"
#include "tests/support/file_contents.h"
#include "tests/support/temporary_folder.h"

namespace slam {

inline constexpr int kFrames = 60;

inline const std::vector<RecordedFrame>& Clean() {
  static const std::vector<RecordedFrame> clean = CleanStream(kFrames);
  return clean;
}

/// What a run over a stream came to.
struct Ran {
  RunOutcome outcome;
  std::string trajectory, covariance, map;        ///< the files' text
  nlohmann::json run;                             ///< run.json
  std::vector<std::string> planes;                ///< lines of frame_planes.jsonl
  std::vector<std::string> states;                ///< by line of it
  std::vector<std::pair<double, Pose>> poses_wc;  ///< (time, pose)
};

/// Poses of a trajectory file; numbers that are not finite fail the test.
inline std::vector<std::pair<double, Pose>> PosesOf(const std::string& trajectory) {
  std::vector<std::pair<double, Pose>> poses_wc;
  std::istringstream lines(trajectory);
  for (std::string line; std::getline(lines, line);) {
    if (line.empty() || line[0] == '#') continue;
    std::istringstream words(line);
    double s = 0;
    Eigen::Vector3d t;
    Eigen::Quaterniond q;
    words >> s >> t.x() >> t.y() >> t.z() >> q.x() >> q.y() >> q.z() >> q.w();
    EXPECT_TRUE(words) << line;
    EXPECT_TRUE(t.allFinite() && q.coeffs().allFinite()) << line;
    poses_wc.emplace_back(s, Pose{q.toRotationMatrix(), t});
  }
  return poses_wc;
}

/// Runs on a stream without detections, on one thread. options.run is
/// chosen here, and removed again.
inline Ran RunStream(std::vector<RecordedFrame> frames, RunOptions options,
                     const Camera& camera = CameraOfSize(320, 240)) {
  options.sequence = "stream";
  const test_support::TemporaryFolder folder;
  options.run = folder / "run";
  options.threads = 1;
  options.force = true;
  FaultStream stream(std::move(frames));
  Ran ran;
  ran.outcome = RunLive({stream, camera, nullptr}, options);
  ran.trajectory = test_support::ReadText(options.run / "trajectory.txt");
  ran.covariance = test_support::ReadText(options.run / "trajectory_covariance.txt");
  ran.map = test_support::ReadText(options.run / "map.json");
  ran.run = nlohmann::json::parse(test_support::ReadText(options.run / "run.json"));
  std::istringstream lines(test_support::ReadText(options.run / "frame_planes.jsonl"));
  for (std::string line; std::getline(lines, line);) {
    ran.states.push_back(nlohmann::json::parse(line).at("state"));
    ran.planes.push_back(line);
  }
  ran.poses_wc = PosesOf(ran.trajectory);
  return ran;
}

/// Pose that the swinging hand has at a time, in the world of its first frame.
inline Pose TruePoseAt(double s) {
  const int i = static_cast<int>(std::lround((s - 100.0) * 30));
  return SwingingPose(0) * Inverse(SwingingPose(i));
}

// Twice what the clean stream comes to, 10 mm at a pixel of 8 mm.
inline constexpr double kPosition_m = 0.02;

inline Ran RunOn(std::vector<RecordedFrame> frames, Variant variant = Variant::kPoints) {
  RunOptions options;
  options.variant = variant;
  return RunStream(std::move(frames), options);
}

/// Whether every pose is the one that the hand had at that time.
inline void ExpectNoWrongPose(const Ran& ran, double tolerance_m = kPosition_m) {
  EXPECT_FALSE(ran.poses_wc.empty());
  for (const auto& [s, T_wc] : ran.poses_wc) {
    EXPECT_LT((T_wc.t - TruePoseAt(s).t).norm(), tolerance_m) << s << " s";
  }
}

/// What of a line of frame_planes.jsonl was measured, without what was decided in the map.
inline std::string Measured(const std::string& line) {
  nlohmann::json planes = nlohmann::json::parse(line).at("planes");
  for (auto& plane : planes) {
    for (const char* decided : {"map_plane", "decision", "by"}) plane.erase(decided);
  }
  return planes.dump();
}

}  // namespace slam
