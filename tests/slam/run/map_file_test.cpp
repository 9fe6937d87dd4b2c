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

}  // namespace
}  // namespace slam
