#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/input_error.h"
#include "slam/bag/bag_file.h"

namespace slam {
namespace {

TEST(BagFile, IsRefusedWithThePackagesToInstallWhereItCannotBeRead) {
  EXPECT_THAT([] { BagFile("desk.bag"); },
              ::testing::ThrowsMessage<io::InputError>(
                  ::testing::AllOf(::testing::HasSubstr("desk.bag: is a ROS bag"),
                                   ::testing::HasSubstr("librosbag-storage-dev"))));
}

}  // namespace
}  // namespace slam
