#include "slam/faces/box_link.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace slam {
namespace {

Box MakeBox(double u0, double v0, double u1, double v1) {
  return {Eigen::Vector2d(u0, v0), Eigen::Vector2d(u1, v1)};
}

/// A plane whose edge points run along a rectangle.
FramePlane PlaneOver(const Box& box) {
  FramePlane plane;
  for (int k = 0; k < 40; ++k) {
    const double s = (k % 10) / 10.0;
    const Eigen::Vector2d corner[4] = {
        box.min, {box.max.x(), box.min.y()}, box.max, {box.min.x(), box.max.y()}};
    const Eigen::Vector2d u = (1 - s) * corner[k / 10] + s * corner[(k / 10 + 1) % 4];
    plane.edge_points.push_back({Eigen::Vector3d(0, 0, 1), u, EdgeKind::kSurface});
    plane.box_px.Include(u);
  }
  return plane;
}

Detection Detected(const std::string& name, const Box& box) {
  Detection d;
  d.class_name = name, d.kind = ClassKind::kRegular, d.score = 0.9, d.box_px = box;
  return d;
}

TEST(BoxLink, TiesABookToItsBox) {
  std::vector<FramePlane> planes{PlaneOver(MakeBox(100, 100, 200, 180))};
  LinkBoxes(planes, {Detected("book", MakeBox(98, 99, 203, 190))}, {});
  ASSERT_TRUE(planes[0].detection.has_value());
  EXPECT_EQ(planes[0].class_name, "book");
}

TEST(BoxLink, LeavesADeskAloneThatIsMuchBiggerThanTheBox) {
  std::vector<FramePlane> planes{PlaneOver(MakeBox(0, 50, 639, 479))};
  LinkBoxes(planes, {Detected("book", MakeBox(100, 100, 400, 400))}, {});
  EXPECT_FALSE(planes[0].detection.has_value());
  EXPECT_EQ(planes[0].class_name, "");
}

TEST(BoxLink, GivesOneBoxSeveralFaces) {
  std::vector<FramePlane> planes{PlaneOver(MakeBox(100, 100, 200, 150)),
                                 PlaneOver(MakeBox(100, 150, 200, 200))};
  LinkBoxes(planes, {Detected("box", MakeBox(100, 100, 200, 200))}, {});
  EXPECT_EQ(planes[0].detection, 0);
  EXPECT_EQ(planes[1].detection, 0);
}

TEST(BoxLink, PrefersTheBoxThatFits) {
  std::vector<FramePlane> planes{PlaneOver(MakeBox(100, 100, 140, 180))};
  const std::vector<Detection> detections{Detected("keyboard", MakeBox(60, 90, 240, 200)),
                                          Detected("cell phone", MakeBox(99, 98, 142, 183))};
  LinkBoxes(planes, detections, {});
  EXPECT_EQ(planes[0].class_name, "cell phone");
}

TEST(BoxLink, LooksOnAfterABoxThatHoldsTooLittleOfThePlane) {
  std::vector<FramePlane> planes{PlaneOver(MakeBox(100, 100, 200, 180))};
  const Detection beside = Detected("cup", MakeBox(150, 100, 260, 180)),
                  own = Detected("book", MakeBox(99, 98, 202, 183));
  for (const auto& detections : {std::vector{beside, own}, {own, beside}}) {
    LinkBoxes(planes, detections, {});
    EXPECT_EQ(planes[0].class_name, "book");
  }
}

TEST(BoxLink, DoesNotDependOnTheOrderOfDetections) {
  const std::vector<FramePlane> planes{PlaneOver(MakeBox(100, 100, 200, 200))};
  // Two boxes with the same overlap, left and right of the plane, and one twice with two names.
  std::vector<Detection> detections{Detected("book", MakeBox(95, 100, 200, 200)),
                                    Detected("laptop", MakeBox(100, 100, 205, 200)),
                                    Detected("box", MakeBox(95, 100, 200, 200))};
  std::vector<std::string> names;
  for (int k = 0; k < 3; ++k) {
    std::rotate(detections.begin(), detections.begin() + 1, detections.end());
    std::vector<FramePlane> linked = planes;
    LinkBoxes(linked, detections, {});
    names.push_back(linked[0].class_name);
  }
  EXPECT_EQ(names[0], names[1]);
  EXPECT_EQ(names[1], names[2]);
}

TEST(BoxLink, ForgetsTheLinkOfAnEarlierCall) {
  std::vector<FramePlane> planes{PlaneOver(MakeBox(100, 100, 200, 180))};
  LinkBoxes(planes, {Detected("book", MakeBox(98, 99, 203, 190))}, {});
  LinkBoxes(planes, {}, {});
  EXPECT_FALSE(planes[0].detection.has_value());
  EXPECT_EQ(planes[0].class_name, "");
}

TEST(BoxLink, TiesNothingToADetectionThatIsTooDoubtful) {
  std::vector<FramePlane> planes{PlaneOver(MakeBox(100, 100, 200, 180))};
  for (const double min_score : {BoxLinkConfig{}.min_score, 0.7}) {
    for (const double above : {-0.01, 0.0, 0.01}) {
      Detection book = Detected("book", MakeBox(98, 99, 203, 190));
      book.score = min_score + above;
      LinkBoxes(planes, {book}, {.min_score = min_score});
      EXPECT_EQ(planes[0].detection.has_value(), above > 0) << book.score;
    }
  }
}

TEST(BoxLink, PrefersABoxThatHoldsAllOfThePlaneToACloserOneThatCutsItOff) {
  FramePlane diamond;  // its tips have few of the edge points
  const Eigen::Vector2d tips[4] = {{150, 100}, {200, 150}, {150, 200}, {100, 150}};
  for (int k = 0; k < 40; ++k) {
    const double s = (k % 10) / 10.0;
    const Eigen::Vector2d u = (1 - s) * tips[k / 10] + s * tips[(k / 10 + 1) % 4];
    diamond.edge_points.push_back({Eigen::Vector3d(0, 0, 1), u, EdgeKind::kSurface});
    diamond.box_px.Include(u);
  }
  const Detection cuts = Detected("cup", MakeBox(100, 100, 200, 185)),
                  holds = Detected("book", MakeBox(95, 95, 208, 205));
  ASSERT_GT(Iou(diamond.box_px, cuts.box_px), Iou(diamond.box_px, holds.box_px));
  for (const auto& detections : {std::vector{cuts, holds}, {holds, cuts}}) {
    std::vector<FramePlane> planes{diamond};
    LinkBoxes(planes, detections, {});
    EXPECT_EQ(planes[0].class_name, "book");
  }
  // Without the other it is good enough.
  std::vector<FramePlane> planes{diamond};
  LinkBoxes(planes, {cuts}, {});
  EXPECT_EQ(planes[0].class_name, "cup");
}

}  // namespace
}  // namespace slam
