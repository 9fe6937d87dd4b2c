#include "eval/draw/plane_name.h"

#include <gtest/gtest.h>

namespace eval {
namespace {

TEST(NameOfPlane, IsThatOfThePlaneItWasMergedIntoWithItsColour) {
  RunMapPlane kept, merged;
  kept.id = 3, kept.plane_class = "book";
  merged.id = 8, merged.merged_into = 3;
  const std::vector<RunMapPlane> map{kept, merged};
  RunFramePlane early, late;
  early.map_plane = 8, late.map_plane = 3;
  const PlaneName of_early = NameOfPlane(early, map), of_late = NameOfPlane(late, map);
  EXPECT_EQ(of_late.text, "3 book");
  EXPECT_EQ(of_early.text, of_late.text);
  ASSERT_TRUE(of_early.colour && of_late.colour);
  EXPECT_EQ(*of_late.colour, ColourOfPlane(3));
  EXPECT_EQ(*of_early.colour, *of_late.colour);
  EXPECT_NE(ColourOfPlane(8), ColourOfPlane(3));
}

}  // namespace
}  // namespace eval
