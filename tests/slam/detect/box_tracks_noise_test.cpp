// Boxes that jitter by their size, and boxes where there is nothing.
#include <gtest/gtest.h>

#include "slam/base/random.h"
#include "slam/detect/box_tracks.h"

namespace slam {
namespace {

Detection BookIn(const Box& box_px) {
  return {.class_name = "book", .kind = ClassKind::kRegular, .score = 0.9, .box_px = box_px};
}

/// What is filled after twenty frames of a box of that size, which moves and jitters alike
/// whatever its size.
Box FilledAfterJitter(double width_px, double height_px) {
  BoxTracks tracks({}, {{0, 0}, {639, 479}});
  Random random{43};
  for (int i = 0; i < 20; ++i) {
    const Eigen::Vector2d at(100 + 2 * i + 6 * random.Uniform(), 80 + i + 6 * random.Uniform());
    tracks.Update(i / 30.0, {BookIn({at, at + Eigen::Vector2d(width_px, height_px)})});
  }
  const auto filled = tracks.Update(20 / 30.0, {});
  EXPECT_EQ(filled.size(), 1u);
  return filled.at(0).box_px;
}

// A detector errs across by a share of a box's width, and down by a share of its height.
TEST(BoxTracks, FollowsABoxAcrossByItsWidthAloneAndDownByItsHeightAlone) {
  const Box small = FilledAfterJitter(40, 40);
  const Box tall = FilledAfterJitter(40, 300), wide = FilledAfterJitter(400, 40);
  EXPECT_NEAR(tall.min.x(), small.min.x(), 1e-9);
  EXPECT_NEAR(tall.max.x(), small.max.x(), 1e-9);
  EXPECT_NEAR(wide.min.y(), small.min.y(), 1e-9);
  EXPECT_NEAR(wide.max.y(), small.max.y(), 1e-9);
  // What is larger jitters more, so that less of the same jitter is believed.
  EXPECT_NE(tall.min.y(), small.min.y());
  EXPECT_NE(wide.min.x(), small.min.x());
}

// Five frames apart, they are as many as would confirm a track if they came together.
TEST(BoxTracks, NeverFillsFalsePositivesThatComeToOnePlaceNowAndThen) {
  const Box place_px{{100, 200}, {180, 260}};
  BoxTracks tracks({}, {{0, 0}, {639, 479}});
  for (int i = 0; i < 60; ++i) {
    std::vector<Detection> seen;
    if (i % 5 == 0) seen.push_back(BookIn(place_px));
    EXPECT_EQ(tracks.Update(i / 30.0, seen).size(), seen.size()) << i;
  }
}

}  // namespace
}  // namespace slam
