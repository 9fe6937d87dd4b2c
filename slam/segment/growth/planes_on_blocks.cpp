#include "slam/segment/growth/planes_on_blocks.h"

#include "slam/base/index.h"

namespace slam {

void BlockHypotheses::Add(int block, int label, int plane) {
  int* link = &first_[Index(block)];
  while (*link != kNoHypothesis && At(*link).label < label) link = &At(*link).next;
  const int next = *link;
  *link = static_cast<int>(list_.size());
  list_.push_back({.label = label, .plane = plane, .next = next});
}

bool BlockHypotheses::Remove(int block, const std::vector<std::uint8_t>& labels) {
  bool any = false;
  for (int* link = &first_[Index(block)]; *link != kNoHypothesis;) {
    Hypothesis& at = At(*link);
    if (labels[Index(at.label)] != 0) {
      *link = at.next, any = true;
    } else {
      link = &at.next;
    }
  }
  return any;
}

PixelSet BlockHypotheses::FindShared(int block, PixelSet Hypothesis::*set) const {
  PixelSet seen = 0, twice = 0;
  for (int k = First(block); k != kNoHypothesis; k = At(k).next) {
    const PixelSet has = At(k).*set;
    twice |= seen & has, seen |= has;
  }
  return twice;
}

}  // namespace slam
