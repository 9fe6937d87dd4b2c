#include "eval/draw/frame_labels.h"

#include <algorithm>
#include <numeric>
#include <set>

#include "eval/draw/label_layout.h"
#include "eval/draw/paint.h"

namespace eval {
namespace {

constexpr int kLargeReach = 4;  // chip heights; balances room against nearness
constexpr int kSmallReach = 1;  // chip heights; farther off it names a neighbour
constexpr double kBorder_px = 2, kAcrossText_px = 9, kBesideText_px = 26;

cv::Size2d ChipSize(const std::string& text) {
  const TextStyle style{kChipText_px, kWhite, false, Align::kLeft};
  return {TextWidth(text, style) + kBesideText_px, kChipText_px + kAcrossText_px};
}

bool StandsAside(const cv::Rect2d& place, cv::Point2d at) { return !place.contains(at); }

}  // namespace

std::vector<PlacedLabel> PlaceLabels(const std::vector<LabelWish>& wishes, cv::Size picture) {
  std::vector<std::size_t> order(wishes.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return wishes[a].share > wishes[b].share;
  });
  LabelLayout layout({kBorder_px, kBorder_px, picture.width - 2 * kBorder_px,
                      picture.height - 2 * kBorder_px});
  std::vector<PlacedLabel> placed;
  std::vector<std::size_t> dots;
  std::set<std::string> named;
  for (const std::size_t k : order) {
    const LabelWish& wish = wishes[k];
    const bool large = wish.share >= kLargeShare;
    if (wish.text.empty() || (!large && named.count(wish.text) > 0)) {
      dots.push_back(k);
      continue;
    }
    named.insert(wish.text);
    const int reach = large ? kLargeReach : kSmallReach;
    if (const auto place = layout.Place(wish.at, ChipSize(wish.text), reach)) {
      placed.push_back({k, true, *place, StandsAside(*place, wish.at)});
    } else {
      dots.push_back(k);
    }
  }
  for (const std::size_t k : dots) {
    constexpr double kSide_px = 2 * kDotRadius_px;
    if (const auto place = layout.Place(wishes[k].at, {kSide_px, kSide_px}, 0)) {
      placed.push_back({k, false, *place, false});
    }
  }
  return placed;
}

}  // namespace eval
