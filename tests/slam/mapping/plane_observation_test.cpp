#include "slam/mapping/plane_observation.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace slam {
namespace {

/// The part of a wall, 1 m high and 2 m before the camera, between two places along it.
FramePlane PartOfWall(double from_m, double to_m) {
  FramePlane part;
  part.pi_c = {-Eigen::Vector3d::UnitZ(), 2.0};
  part.centroid_c = {0.5 * (from_m + to_m), 0, 2};
  part.offset_sigma_m = 0.001, part.angle_sigma_rad = 0.001;
  for (double x = from_m + 0.0025; x < to_m; x += 0.005)
    for (double y = -0.4975; y < 0.5; y += 0.005) part.points_c.emplace_back(x, y, 2.0);
  return part;
}

TEST(PlaneObservation, AddsToACoarseCloudPointsAsFarApartAsItsOwn) {
  // Of the first part the cloud becomes coarser; the second one at the finest would fit.
  PlaneMapConfig config;
  config.max_cloud_points = 1000;
  Frame frame;
  const FramePlane first = PartOfWall(0.0, 0.6), second = PartOfWall(0.6, 0.8);
  MapPlane wall = StartPlane(first, frame);
  ObservePlane(wall, first, frame, config);
  ASSERT_GT(wall.voxel_m, config.voxel_m);
  const double voxel_m = wall.voxel_m;
  frame.index = 1;
  ObservePlane(wall, second, frame, config);
  EXPECT_EQ(wall.voxel_m, voxel_m);
  const auto in_second = std::count_if(wall.points_w.begin(), wall.points_w.end(),
                                       [](const auto& p_w) { return p_w.x() > 0.6; });
  const auto all = static_cast<double>(wall.points_w.size());
  EXPECT_NEAR(static_cast<double>(in_second) / all, 0.25, 0.04);  // as it has of the area
  EXPECT_NEAR(wall.centroid_w.x(), 0.4, 0.02);
}

/// What a landmark believes of its class after one frame in which a box of this score said "book".
double BeliefInBook(double score, bool compensated, bool asked = true) {
  Frame frame;
  frame.detector_asked = asked;
  frame.detections.resize(1);
  frame.detections[0].score = score;
  frame.detections[0].compensated = compensated;
  FramePlane part = PartOfWall(0.0, 0.2);
  part.detection = 0;
  part.class_name = "book";
  MapPlane wall = StartPlane(part, frame);
  ObservePlane(wall, part, frame, {});
  return wall.class_belief["book"];
}

TEST(PlaneObservation, CountsABoxThatItsTrackPredictedHalf) {
  for (const double score : {0.3, 0.8}) {
    EXPECT_GT(BeliefInBook(score, false), 0.0);
    EXPECT_NEAR(BeliefInBook(score, true), BeliefInBook(0.5 * score, false), 1e-12);
    EXPECT_EQ(BeliefInBook(score, false, false), 0.0) << "it was counted where it was found";
  }
}

TEST(PlaneObservation, TakesCornersFromTrustedPlanesOfObjectsAlone) {
  for (const bool of_object : {true, false}) {
    for (const bool bad : {true, false}) {
      Frame frame;
      FramePlane part = PartOfWall(0.0, 0.2);
      part.class_name = of_object ? "book" : "";
      if (bad) part.bad = BadReason::kBorder;
      for (const Eigen::Vector3d& p_c :
           {Eigen::Vector3d(0, -0.5, 2), Eigen::Vector3d(0.2, -0.5, 2),
            Eigen::Vector3d(0.2, 0.5, 2), Eigen::Vector3d(0, 0.5, 2)})
        part.vertices_c.push_back({p_c});
      MapPlane wall = StartPlane(part, frame);
      ObservePlane(wall, part, frame, {});
      EXPECT_EQ(wall.vertices_w.size(), of_object && !bad ? 4u : 0u) << of_object << bad;
    }
  }
}

}  // namespace
}  // namespace slam
