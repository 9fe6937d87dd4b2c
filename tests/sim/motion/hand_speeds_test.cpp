#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "sim/motion/trajectory.h"
#include "sim/scene/families.h"
#include "sim/scene/twin.h"
#include "tests/support/trajectory_means.h"

namespace sim {
namespace {

/// Mean, median and 95th percentile of a speed from frame to frame.
struct Spread {
  double mean, median, fast;
};

/// What a recording of the TUM RGB-D benchmark has at 30 Hz, m/s and deg/s.
struct Recording {
  const char *twin, *preset;
  Spread speed, turn;
};

constexpr Recording kRecordings[] = {
    {"fr2-desk", "slow", {.205, .213, .325}, {12.8, 11.2, 25.8}},
    {"fr3-loh", "office", {.254, .259, .395}, {14.1, 13.1, 28.5}},
    {"fr1-desk", "fast", {.453, .468, .727}, {35.0, 31.1, 72.7}},
    {"fr1-xyz", "xyz", {.304, .330, .495}, {17.2, 15.6, 36.9}}};

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
    for (std::size_t i = 1; i < path.size(); ++i) {
      const Means step = MeansOf({{0, path[i - 1].T_wc}, {1 / kRate_hz, path[i].T_wc}});
      speeds.push_back(step.speed_m_s);
      turns.push_back(step.turn_deg_s);
    }
    add(sum.speed, SpreadOf(speeds));
    add(sum.turn, SpreadOf(turns));
  }
  return sum;
}

void ExpectWithinFifteenPerCent(const Spread& measured, const Spread& recorded,
                                const std::string& what) {
  EXPECT_NEAR(measured.mean, recorded.mean, 0.15 * recorded.mean) << what;
  EXPECT_NEAR(measured.median, recorded.median, 0.15 * recorded.median) << what;
  EXPECT_NEAR(measured.fast, recorded.fast, 0.15 * recorded.fast) << what;
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
    ExpectWithinFifteenPerCent(measured.speed, recorded.speed, recorded.preset);
    ExpectWithinFifteenPerCent(measured.turn, recorded.turn, recorded.preset);
  }
}

TEST(HandSpeeds, SpreadAsThoseOfTheRecordingATwinIsNamedFor) {
  for (const Recording& recorded : kRecordings) {
    const Recording measured =
        Measured([&](std::uint64_t seed) { return MakeTwin(recorded.twin, seed); }, 600);
    ExpectWithinFifteenPerCent(measured.speed, recorded.speed, recorded.twin);
    ExpectWithinFifteenPerCent(measured.turn, recorded.turn, recorded.twin);
  }
}

}  // namespace
}  // namespace sim
