#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "sim/families/families.h"
#include "sim/families/twin.h"
#include "sim/motion/trajectory.h"
#include "tests/support/hand_measures.h"
#include "tests/support/trajectory_means.h"

namespace sim {
namespace {

/// Mean, median and 95th percentile of a speed from frame to frame.
struct Spread {
  double mean, median, fast;
};

/// What a recording of the TUM RGB-D benchmark has at 30 Hz, m/s and deg/s; acceleration
/// without the noise of its measurement, m/s^2; how it sways at 1-4 Hz, mm.
struct Recording {
  const char *twin, *preset;
  Spread speed, turn;
  double acceleration, sway;
};

constexpr Recording kRecordings[] = {
    {"fr2-desk", "slow", {.205, .213, .325}, {12.8, 11.2, 25.8}, 0.34, 6.7},
    {"fr3-loh", "office", {.254, .259, .395}, {14.1, 13.1, 28.5}, 0.35, 5.1},
    {"fr1-desk", "fast", {.453, .468, .727}, {35.0, 31.1, 72.7}, 1.13, 14.1},
    {"fr1-xyz", "xyz", {.304, .330, .495}, {17.2, 15.6, 36.9}, 0.81, 5.4}};

constexpr std::uint64_t kRuns = 10;
constexpr double kRate_hz = 30;

Spread SpreadOf(std::vector<double> values) {
  Spread spread{0, 0, 0};
  for (const double value : values) {
    spread.mean += value / static_cast<double>(values.size());
  }
  std::sort(values.begin(), values.end());
  const auto share = [&](double part) {
    return values[static_cast<std::size_t>(part * static_cast<double>(values.size()))];
  };
  return {spread.mean, share(0.5), share(0.95)};
}

/// Mean over the seeds of what each trajectory has.
template <typename SceneOf>
Recording Measured(SceneOf scene_of, int frames) {
  Recording sum{};
  const auto add = [](Spread& to, const Spread& one) {
    to.mean += one.mean / static_cast<double>(kRuns);
    to.median += one.median / static_cast<double>(kRuns);
    to.fast += one.fast / static_cast<double>(kRuns);
  };
  for (std::uint64_t seed = 1; seed <= kRuns; ++seed) {
    const auto path = MakeTrajectory(scene_of(seed), frames, kRate_hz, seed);
    std::vector<double> speeds, turns;
    std::vector<Eigen::Vector3d> way_w{path.front().T_wc.t};
    for (std::size_t i = 1; i < path.size(); ++i) {
      const Means step = MeansOf({{0, path[i - 1].T_wc}, {1 / kRate_hz, path[i].T_wc}});
      speeds.push_back(step.speed_m_s);
      turns.push_back(step.turn_deg_s);
      way_w.push_back(path[i].T_wc.t);
    }
    add(sum.speed, SpreadOf(speeds));
    add(sum.turn, SpreadOf(turns));
    sum.acceleration += RmsAcceleration(way_w, kRate_hz) / static_cast<double>(kRuns);
    sum.sway += SwayIn_mm(way_w, kRate_hz, 1, 4) / static_cast<double>(kRuns);
  }
  return sum;
}

void ExpectWithinFifteenPerCent(double measured, double recorded, const std::string& what) {
  EXPECT_NEAR(measured, recorded, 0.15 * recorded) << what;
}

void ExpectAlike(const Recording& measured, const Recording& recorded, const std::string& who) {
  const auto expect = [&](const Spread& one, const Spread& other, const std::string& what) {
    ExpectWithinFifteenPerCent(one.mean, other.mean, who + ": mean " + what);
    ExpectWithinFifteenPerCent(one.median, other.median, who + ": median " + what);
    ExpectWithinFifteenPerCent(one.fast, other.fast, who + ": 95th percentile of " + what);
  };
  expect(measured.speed, recorded.speed, "speed");
  expect(measured.turn, recorded.turn, "turn");
  ExpectWithinFifteenPerCent(measured.acceleration, recorded.acceleration,
                             who + ": acceleration");
  ExpectWithinFifteenPerCent(measured.sway, recorded.sway, who + ": sway");
}

TEST(HandSpeeds, SpreadAsThoseOfTheRecordingTheirPresetIsNamedFor) {
  for (const Recording& recorded : kRecordings) {
    const Recording measured = Measured(
        [&](std::uint64_t seed) {
          Scene scene = MakeScene("desk", seed);
          scene.motion.preset = recorded.preset;
          return scene;
        },
        600);
    ExpectAlike(measured, recorded, recorded.preset);
  }
}

TEST(HandSpeeds, SpreadAsThoseOfTheRecordingATwinIsNamedFor) {
  for (const Recording& recorded : kRecordings) {
    const Recording measured =
        Measured([&](std::uint64_t seed) { return MakeTwin(recorded.twin, seed); }, 600);
    ExpectAlike(measured, recorded, recorded.twin);
  }
}

}  // namespace
}  // namespace sim
