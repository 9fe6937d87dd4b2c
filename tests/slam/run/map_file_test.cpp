#include "slam/run/map_file.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <nlohmann/json.hpp>

#include "tests/support/map_surfaces.h"

namespace slam {
namespace {

TEST(MapAsJson, SaysWhatAPlaneWasSplitFromAndNothingOfSplitsElsewhere) {
  Map map;
  AddLandmark(map, MapPlane{});
  AddLandmark(map, MapPlane{});
  map.planes.At(1).split_from = 0;
  map.planes.At(1).split_at_s = 2.25;
  const auto planes = nlohmann::json::parse(MapAsJson(map)).at("planes");
  EXPECT_EQ(planes[1]["split_from"], 0);
  EXPECT_EQ(planes[1]["split_at"], 2.25);
  EXPECT_FALSE(planes[0].contains("split_from"));
  EXPECT_FALSE(planes[0].contains("split_at"));
}

TEST(PlaneColour, TellsNeighbouringIdsApart) {
  for (int id = 0; id < 100; ++id) {
    const auto a = PlaneColour(id), b = PlaneColour(id + 1);
    int difference = 0;
    for (std::size_t i = 0; i < 3; ++i) difference += std::abs(int{a[i]} - int{b[i]});
    EXPECT_GT(difference, 100) << id;
  }
}

TEST(MapAsJson, TellsTheCovarianceOfAPlaneThatFramesHaveSeen) {
  MapPlane seen;
  AddObservation(seen.estimate, {Eigen::Vector3d::UnitZ(), -0.7}, {0.3, -0.2, 0.7}, 0.02, 0.01,
                 1.0, 1e-4);
  Map map;
  AddLandmark(map, seen);
  AddLandmark(map, MapPlane{});
  const auto planes = nlohmann::json::parse(MapAsJson(map)).at("planes");
  EXPECT_FALSE(planes[1].contains("covariance"));
  const Eigen::Matrix4d C = seen.estimate.WorldCovariance();
  const std::vector<double> upper{C(0, 0), C(0, 1), C(0, 2), C(0, 3), C(1, 1),
                                  C(1, 2), C(1, 3), C(2, 2), C(2, 3), C(3, 3)};
  EXPECT_EQ(planes[0]["covariance"].get<std::vector<double>>(), upper);
}

}  // namespace
}  // namespace slam
