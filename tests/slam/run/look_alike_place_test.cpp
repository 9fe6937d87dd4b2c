#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/support/furnished_room.h"
#include "tests/support/stream_run.h"

// A lost camera comes back in the dark to one of two places of its map that look alike.
namespace slam {
namespace {

/// A hall whose ends are the same furnished corner: half a turn brings one onto the other.
/// @param moved_m  of the three boxes at the second end, one stands elsewhere by as much
PlaneWorld Hall(double moved_m = 0.0) {
  constexpr std::size_t kFloor = 0;
  constexpr int kLastBox = 5;
  const PlaneWorld corner = FurnishedRoom();
  PlaneWorld hall = corner;
  for (std::size_t i = kFloor + 1; i < corner.planes.size(); ++i) {
    WorldPlane plane = corner.planes[i];
    if (plane.object == kLastBox) plane.center_w.y() += moved_m;
    for (auto* v : {&plane.center_w, &plane.half_1_w, &plane.half_2_w}) v->head<2>() *= -1;
    plane.object += corner.objects;
    hall.planes.push_back(plane);
  }
  hall.objects = 2 * corner.objects;
  return hall;
}

// Frames in the light, from the first end to the second; twice: carried, then put down in the dark.
constexpr int kMapped = 31, kCarried = 2, kPutDown = 4, kVisit = kCarried + kPutDown;
constexpr int kInAll = kMapped + 2 * kVisit;

bool IsPutDown(int i) { return i >= kMapped && (i - kMapped) % kVisit >= kCarried; }
bool IsAtFirst(int i) { return i >= kMapped && i < kMapped + kVisit; }

/// A hand that turns in the hall's middle; put down at the first end, then at the second.
Pose HandAt(int i) {
  const double s = i / 30.0, turned = std::min(1.0, i / (kMapped - 1.0));
  const Eigen::Matrix3d R = ExpSo3({0, 0, IsAtFirst(i) ? 0.0 : turned * std::numbers::pi});
  return LookAt(R * Eigen::Vector3d(-0.5 + 0.1 * std::sin(3 * s), -0.6 + 0.1 * s, 1.3),
                R * Eigen::Vector3d(0.5, 1.1, 0.3));
}

/// The image in the light: every surface has a print of its own.
cv::Mat1b Printed(const PlaneWorld& world, const SeenWorld& seen, const Pose& T_cw,
                  const Camera& camera) {
  constexpr int kSide = 256;             // texels
  constexpr double kTexelsAMetre = 64;   // the floor is 4 m wide
  static std::vector<cv::Mat1b> prints;  // by surface
  while (prints.size() < world.planes.size())
    prints.push_back(BlockPattern(kSide, prints.size() + 1));
  cv::Mat1b gray(camera.height, camera.width, std::uint8_t{0});
  const Pose T_wc = Inverse(T_cw);
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      const int label = seen.frame.plane_labels(v, u);
      if (label == 0) continue;
      const auto at = Index(seen.truth[Index(label - 1)]);
      const WorldPlane& plane = world.planes[at];
      const Eigen::Vector3d p_w = T_wc * camera.Backproject({u, v}, seen.frame.depth_m(v, u));
      const auto texel = [&](const Eigen::Vector3d& half_w) {
        const double along_m = (p_w - plane.center_w).dot(half_w.normalized());
        return std::clamp(static_cast<int>(kTexelsAMetre * along_m + kSide / 2.0), 0,
                          kSide - 1);
      };
      gray(v, u) = prints[at](texel(plane.half_1_w), texel(plane.half_2_w));
    }
  }
  return gray;
}

std::vector<RecordedFrame> StreamIn(const PlaneWorld& hall) {
  const Camera camera = CameraOfSize(320, 240);
  std::vector<RecordedFrame> stream;
  for (int i = 0; i < kInAll; ++i) {
    const SeenWorld seen = See(hall, HandAt(i), camera, {}, Random{1});
    cv::Mat1f depth_m = seen.frame.depth_m;
    cv::Mat1b gray(depth_m.size(), 0);
    if (i < kMapped) {
      gray = Printed(hall, seen, HandAt(i), camera);
    } else if (!IsPutDown(i)) {
      depth_m.setTo(0);
    }
    stream.push_back(StreamFrame(i, gray, depth_m));
  }
  return stream;
}

/// States of a run that is tracked until the lens is covered, lost while carried, and that comes to
/// these twice.
std::vector<std::string> StatesWith(const std::string& put_down, const std::string& later) {
  std::vector<std::string> states(kMapped, "tracking");
  for (int i = kMapped; i < kInAll; ++i) {
    states.push_back(!IsPutDown(i) ? "lost" : states.back() == "lost" ? put_down : later);
  }
  return states;
}

TEST(LookAlikePlace, IsAmbiguousAndGivesNoPose) {
  const Ran ran = RunOn(StreamIn(Hall()), Variant::kFull);
  EXPECT_EQ(ran.states, StatesWith("ambiguous", "ambiguous"));
  EXPECT_EQ(ran.outcome.tracked, kMapped);
  ASSERT_EQ(ran.poses_wc.size(), Index(kMapped));
  EXPECT_LT(ran.poses_wc.back().first, 100.0 + (kMapped - 0.5) / 30.0) << "only in the light";
}

/// The same frames of the first end: what tells it is that the second end would show the box.
TEST(LookAlikePlace, IsFoundAtEitherEndWhereOneBoxOfTheSecondStandsElsewhere) {
  const auto stream = StreamIn(Hall(0.5));
  for (int i = kMapped + kCarried; i < kMapped + kVisit; ++i) {
    const SeenWorld alike = See(Hall(), HandAt(i), CameraOfSize(320, 240), {}, Random{1});
    ASSERT_EQ(cv::norm(stream[Index(i)].depth_m, alike.frame.depth_m, cv::NORM_INF), 0.0) << i;
  }
  const Ran ran = RunOn(stream, Variant::kFull);
  EXPECT_EQ(ran.states, StatesWith("relocalised", "planes"));
  ASSERT_EQ(ran.poses_wc.size(), Index(kMapped + 2 * kPutDown));
  for (const auto& [s, T_wc] : ran.poses_wc) {
    const int i = static_cast<int>(std::lround((s - 100.0) * 30));
    const Pose error = T_wc * HandAt(i) * Inverse(HandAt(0));
    EXPECT_LT(error.t.norm(), 0.01) << i;
    EXPECT_LT(Log(error).tail<3>().norm(), 0.01) << i;
  }
}

}  // namespace
}  // namespace slam
