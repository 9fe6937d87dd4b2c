#include "eval/draw/frame_labels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "eval/draw/label_layout.h"

namespace eval {
namespace {

const PlacedLabel* LabelOf(const std::vector<PlacedLabel>& placed, std::size_t wish) {
  const auto found = std::find_if(placed.begin(), placed.end(),
                                  [&](const PlacedLabel& label) { return label.wish == wish; });
  return found == placed.end() ? nullptr : &*found;
}

bool IsChip(const std::vector<PlacedLabel>& placed, std::size_t wish) {
  const PlacedLabel* label = LabelOf(placed, wish);
  return label != nullptr && label->is_chip;
}

TEST(LabelLayout, NeverPutsOneLabelOverAnother) {
  LabelLayout layout({0, 0, 400, 300});
  std::vector<cv::Rect2d> placed;
  for (int i = 0; i < 30; ++i) {
    const auto place = layout.Place({200.0 + i, 150}, {60, 16});
    if (!place) continue;
    for (const cv::Rect2d& other : placed) EXPECT_EQ((other & *place).area(), 0);
    EXPECT_GE(place->x, 0);
    EXPECT_LE(place->y + place->height, 300);
    placed.push_back(*place);
  }
  EXPECT_GT(placed.size(), 5u);
}

TEST(PlaceLabels, PutsNoChipOrDotOverAnother) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> x(0, 600), y(0, 450), share(0, 0.05);
  std::vector<LabelWish> wishes;
  for (int i = 0; i < 80; ++i) {
    wishes.push_back(
        {{x(random), y(random)}, i % 3 == 0 ? "" : std::to_string(1000 + i), share(random)});
  }
  const std::vector<PlacedLabel> placed = PlaceLabels(wishes, {600, 450});
  EXPECT_GT(placed.size(), 40u);
  for (std::size_t i = 0; i < placed.size(); ++i) {
    EXPECT_GE(placed[i].place.x, 0);
    EXPECT_LE(placed[i].place.br().y, 450);
    for (std::size_t j = 0; j < i; ++j) {
      EXPECT_EQ((placed[i].place & placed[j].place).area(), 0) << i << " over " << j;
    }
  }
}

TEST(PlaceLabels, GivesLargePlanesTheirChipsFirst) {
  // All in one place, the largest last: it has the place itself.
  std::vector<LabelWish> wishes;
  for (int i = 0; i < 5; ++i) wishes.push_back({{300, 200}, std::to_string(i), 0.02 * (i + 1)});
  const std::vector<PlacedLabel> placed = PlaceLabels(wishes, {600, 450});
  ASSERT_FALSE(placed.empty());
  EXPECT_EQ(placed.front().wish, 4u);
  EXPECT_TRUE(placed.front().place.contains({300, 200}));
  EXPECT_FALSE(placed.front().needs_leader);
  // The others stand aside, with a line to where they belong.
  for (std::size_t i = 0; i < 4; ++i) {
    ASSERT_TRUE(IsChip(placed, i));
    EXPECT_TRUE(LabelOf(placed, i)->needs_leader);
  }
}

TEST(PlaceLabels, GivesASmallPlaneAChipOnlyWhereThereIsRoom) {
  std::vector<LabelWish> wishes{{{500, 100}, "alone", 0.001}};
  for (int i = 0; i < 40; ++i)
    wishes.push_back({{200, 200}, "many " + std::to_string(i), 0.001});
  const std::vector<PlacedLabel> placed = PlaceLabels(wishes, {600, 450});
  EXPECT_TRUE(IsChip(placed, 0));
  EXPECT_LT(placed.size(), 20u);
  for (const PlacedLabel& label : placed) {
    const cv::Point2d middle = (label.place.tl() + label.place.br()) / 2;
    const cv::Point2d off = middle - wishes[label.wish].at;
    EXPECT_LT(std::hypot(off.x, off.y), 3 * kChipText_px + 40) << "names a neighbour";
  }
}

TEST(PlaceLabels, WritesANameOnceUnlessThePlaneIsLarge) {
  const std::vector<LabelWish> wishes{
      {{100, 100}, "7", 0.1}, {{300, 100}, "7", 0.001}, {{500, 100}, "7", 0.05}};
  const std::vector<PlacedLabel> placed = PlaceLabels(wishes, {600, 450});
  EXPECT_TRUE(IsChip(placed, 0));
  EXPECT_FALSE(IsChip(placed, 1));
  EXPECT_NE(LabelOf(placed, 1), nullptr) << "a dot is left";
  EXPECT_TRUE(IsChip(placed, 2));
}

TEST(PlaceLabels, LeavesOutADotWhereAChipStands) {
  const std::vector<LabelWish> wishes{{{100, 100}, "", 0.2}, {{100, 100}, "12 book", 0.1}};
  const std::vector<PlacedLabel> placed = PlaceLabels(wishes, {600, 450});
  ASSERT_EQ(placed.size(), 1u);
  EXPECT_EQ(placed.front().wish, 1u);
}

}  // namespace
}  // namespace eval
