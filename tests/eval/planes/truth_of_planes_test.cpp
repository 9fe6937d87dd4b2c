#include "eval/planes/truth_of_planes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace eval {
namespace {

constexpr int kDesk = 1, kBook = 2;

/// A rectangle of the plane z = -z_m, seen from above it.
SeenPlane Level(const TruthPlane& plane, double x_m, double half_m, double z_m, int pixels) {
  SeenPlane seen;
  seen.plane = &plane;
  seen.pi_c = {{0, 0, -1}, z_m};
  for (const auto& [x, y] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
    seen.corners_c.emplace_back(x_m + half_m * x, half_m * y, z_m);
  }
  seen.pixels = pixels;
  seen.counted = true;
  return seen;
}

/// A book 15 mm thick on the right half of a desk that is 1.4 m away.
class TruthWithoutLabels : public ::testing::Test {
 protected:
  TruthWithoutLabels() {
    desk_.id = kDesk;
    book_.id = kBook;
    frame_.planes = {Level(desk_, 0.0, 0.6, 1.4, 40000), Level(book_, 0.2, 0.1, 1.385, 5000)};
  }

  int TruthOf(const Eigen::Vector3d& centroid_c, int pixels, double tilt_deg = 0.0) const {
    RunFramePlane plane;
    const double a = tilt_deg * std::numbers::pi / 180.0;
    plane.pi_c.n = {std::sin(a), 0, -std::cos(a)};
    plane.pi_c.d = -plane.pi_c.n.dot(centroid_c);
    plane.centroid_c = centroid_c;
    plane.pixels = pixels;
    return TruthByGeometry(frame_, plane);
  }

 private:
  TruthPlane desk_, book_;
  TrueFrame frame_;
};

TEST(TruthByPixels, IsThePlaneWithMostOfThemUnlessMostShowNone) {
  TruthPlane desk, book;
  desk.id = kDesk, book.id = kBook;
  TrueFrame frame;
  frame.planes = {Level(desk, 0.0, 0.6, 1.4, 40000), Level(book, 0.2, 0.1, 1.385, 5000)};
  constexpr int kUnscored = 9, kNothing = 0;
  const std::map<int, int> truths =
      TruthByPixels(frame, {// Less than half, but more than any other and than what shows none.
                            {{kBook, 1}, 45},
                            {{kDesk, 1}, 20},
                            {{kUnscored, 1}, 35},
                            // Of what shows none all counts together.
                            {{kDesk, 2}, 40},
                            {{kUnscored, 2}, 25},
                            {{kNothing, 2}, 25},
                            // Ties go to the lower id, before none.
                            {{kDesk, 3}, 10},
                            {{kBook, 3}, 10},
                            {{kNothing, 3}, 10},
                            {{kNothing, 4}, 5}});
  EXPECT_EQ(truths, (std::map<int, int>{{0, kBook}, {1, 0}, {2, kDesk}, {3, 0}}));
}

TEST_F(TruthWithoutLabels, ABookThatIsBentOntoTheDeskIsTheBookByItsPixels) {
  EXPECT_EQ(TruthOf({0.2, 0, 1.386}, 4800), kBook);
  EXPECT_EQ(TruthOf({0.2, 0, 1.395}, 4800), kBook);
}

TEST_F(TruthWithoutLabels, ADeskWhoseMiddleIsUnderTheBookIsTheDesk) {
  EXPECT_EQ(TruthOf({0.2, 0, 1.4}, 38000), kDesk);
  EXPECT_EQ(TruthOf({0.2, 0, 1.391}, 38000), kDesk);
}

TEST_F(TruthWithoutLabels, APieceOfTheDeskBesideTheBookIsTheDesk) {
  EXPECT_EQ(TruthOf({-0.3, 0, 1.39}, 5000), kDesk);
}

TEST_F(TruthWithoutLabels, WithoutANumberOfPixelsTheOffsetDecides) {
  EXPECT_EQ(TruthOf({0.2, 0, 1.395}, 0), kDesk);
  EXPECT_EQ(TruthOf({0.2, 0, 1.389}, 0), kBook);
}

TEST_F(TruthWithoutLabels, WhatIsFarOrTiltedOrBesideAllShowsNone) {
  EXPECT_EQ(TruthOf({0.2, 0, 1.46}, 5000), 0);
  EXPECT_EQ(TruthOf({0.2, 0, 1.33}, 5000), 0);
  EXPECT_EQ(TruthOf({0.2, 0, 1.385}, 5000, 25.0), kBook);
  EXPECT_EQ(TruthOf({0.2, 0, 1.385}, 5000, 35.0), 0);
  EXPECT_EQ(TruthOf({-0.64, 0, 1.4}, 5000), kDesk);
  EXPECT_EQ(TruthOf({-0.66, 0, 1.4}, 5000), 0);
}

}  // namespace
}  // namespace eval
