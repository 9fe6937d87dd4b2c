#include "sim/write/sequence_text.h"

#include <gmock/gmock.h>

namespace sim {
namespace {

using ::testing::HasSubstr;

// Images are listed under the stamps that they got, poses under the time of the exposure.
TEST(FixedFiles, TellThePoseUnderTheStampOfItsFrame) {
  Shot shot;
  shot.time_s = 1.0, shot.colour_stamp_s = 1.004, shot.depth_stamp_s = 1.019;
  const auto files = FixedFiles(Scene{}, {}, RigOptions{}, {shot});
  EXPECT_THAT(files.at("groundtruth.txt"), HasSubstr("\n1.004000 0 0 0 0 0 0 1\n"));
  EXPECT_THAT(files.at("rgb.txt"), HasSubstr("\n1.004000 rgb/1.004000.png\n"));
  EXPECT_THAT(files.at("depth.txt"), HasSubstr("\n1.019000 depth/1.019000.png\n"));
  EXPECT_EQ(files.at("associations.txt"),
            "1.004000 rgb/1.004000.png 1.019000 depth/1.019000.png\n");
}

}  // namespace
}  // namespace sim
