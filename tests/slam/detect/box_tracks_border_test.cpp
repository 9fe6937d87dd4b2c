// Boxes that the border of the image cuts off.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "slam/detect/box_tracks.h"

namespace slam {
namespace {

Detection PannedBox(const std::string& name, const Box& whole_px, double shift_px,
                    const Box& image_px) {
  const Eigen::Vector2d shift(shift_px, 0);
  return {.class_name = name,
          .kind = ClassKind::kRegular,
          .score = 0.9,
          .box_px = Intersection({whole_px.min + shift, whole_px.max + shift}, image_px)};
}

// Three boxes reach the border while the camera pans evenly. That less and less of them is seen is
// expected, and moves nothing else.
TEST(BoxTracks, FillsAMissWhereItIsThoughTheBorderCutsTheOthers) {
  constexpr double kPan_px = 24;  // a frame
  constexpr int kFrames = 10;
  const Box image_px{{0, 0}, {639, 479}};
  for (const bool to_left : {true, false}) {
    const auto seen = [&](int frame, const std::string& name, double u, double v, double w,
                          double h) {
      const Box box_px =
          to_left ? Box{{u, v}, {u + w, v + h}} : Box{{639 - u - w, v}, {639 - u, v + h}};
      return PannedBox(name, box_px, (to_left ? -1 : 1) * kPan_px * frame, image_px);
    };
    const auto others = [&](int frame) {
      constexpr double kStart_px = kPan_px * (kFrames - 1);  // at the border in the last frame
      return std::vector<Detection>{seen(frame, "tv", kStart_px, 20, 160, 110),
                                    seen(frame, "laptop", kStart_px, 170, 150, 120),
                                    seen(frame, "keyboard", kStart_px, 320, 180, 100)};
    };
    const auto phone = [&](int frame) { return seen(frame, "cell phone", 560, 200, 40, 30); };
    BoxTracks tracks({}, image_px);
    for (int i = 0; i < kFrames; ++i) {
      std::vector<Detection> all = others(i);
      all.push_back(phone(i));
      tracks.Update(i / 30.0, all);
    }
    const auto answer = tracks.Update(kFrames / 30.0, others(kFrames));
    ASSERT_EQ(answer.size(), 4u);
    EXPECT_TRUE(answer[3].compensated);
    EXPECT_NEAR(answer[3].box_px.center().x(), phone(kFrames).box_px.center().x(), 4.0);
  }
}

// The side at the border cannot move; the others tell by how much the hand jerked.
TEST(BoxTracks, MovesAMissedBoxByTheWholeJerkThoughTheBorderCutsTheOthers) {
  constexpr double kJerk_px = -50;
  const Box image_px{{0, 0}, {639, 479}};
  const auto others = [&](double shift_px) {
    return std::vector<Detection>{
        PannedBox("tv", {{-40, 20}, {160, 130}}, shift_px, image_px),
        PannedBox("laptop", {{-60, 170}, {180, 290}}, shift_px, image_px),
        PannedBox("keyboard", {{-20, 320}, {200, 420}}, shift_px, image_px)};
  };
  const Box phone_px{{300, 200}, {340, 230}};
  BoxTracks tracks({}, image_px);
  for (int i = 0; i < 10; ++i) {
    std::vector<Detection> all = others(0);
    all.push_back(PannedBox("cell phone", phone_px, 0, image_px));
    tracks.Update(i / 30.0, all);
  }
  const auto answer = tracks.Update(10 / 30.0, others(kJerk_px));
  ASSERT_EQ(answer.size(), 4u);
  EXPECT_TRUE(answer[3].compensated);
  EXPECT_NEAR(answer[3].box_px.center().x(), phone_px.center().x() + kJerk_px, 4.0);
}

}  // namespace
}  // namespace slam
