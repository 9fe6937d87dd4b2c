#include "slam/input/pair_images.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace slam {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Pair;

/// Images of these times; the first is of line 1 of the list.
std::vector<StampedImage> Listed(const std::string& list, const std::vector<double>& stamps_s) {
  std::vector<StampedImage> images;
  for (const double t_s : stamps_s)
    images.push_back({t_s, "", list + ":" + std::to_string(images.size() + 1)});
  return images;
}

TEST(PairImages, SaysNothingWhenEveryImageHasItsPartner) {
  const ImagePairs made = PairImages(Listed("rgb.txt", {1, 2}), Listed("depth.txt", {1, 2.01}));
  EXPECT_THAT(made.pairs, ElementsAre(Pair(0, 0), Pair(1, 1)));
  EXPECT_THAT(made.warnings, IsEmpty());
}

// As when one camera starts before the other.
TEST(PairImages, CountsImagesWithoutAPartnerFromTheFirstOn) {
  const ImagePairs made =
      PairImages(Listed("rgb.txt", {1, 2}), Listed("depth.txt", {0.5, 0.8, 1, 2}));
  EXPECT_THAT(made.pairs, ElementsAre(Pair(0, 2), Pair(1, 3)));
  EXPECT_THAT(made.warnings, ElementsAre(HasSubstr("0 of 2 colour images and 2 of 4 depth "
                                                   "images (first depth.txt:1)")));
}

// Strictly, as TUM's associate.py: at exactly 20 ms, before or after, images make no frame.
TEST(PairImages, LeavesImagesThatAreExactlyTheLimitApart) {
  const auto pairs = [](double rgb_s, double depth_s) {
    return PairImages(Listed("rgb.txt", {rgb_s}), Listed("depth.txt", {depth_s})).pairs;
  };
  EXPECT_THAT(pairs(kMaxPairing_s, 0), IsEmpty());
  EXPECT_THAT(pairs(0, kMaxPairing_s), IsEmpty());
  EXPECT_THAT(pairs(0.75 * kMaxPairing_s, 0), ElementsAre(Pair(0, 0)));
  EXPECT_THAT(pairs(0, 0.75 * kMaxPairing_s), ElementsAre(Pair(0, 0)));
}

}  // namespace
}  // namespace slam
