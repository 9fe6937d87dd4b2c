#include "io/nearest_word.h"

#include <gtest/gtest.h>

namespace io {
namespace {

TEST(NearestWord, IsTheOneWithFewestOtherLetters) {
  const std::vector<std::string> known{"sim", "slam", "scene"};
  EXPECT_EQ(NearestWord("slams", known), "slam");
  EXPECT_EQ(NearestWord("scnee", known), "scene");
  EXPECT_EQ(NearestWord("telephone", known), "");
  EXPECT_EQ(NearestWord("slam", {}), "");
  EXPECT_EQ(NearestWord("depth_facto", {"depth_offset", "depth_factor", "depth_actor"}),
            "depth_factor");
}

}  // namespace
}  // namespace io
