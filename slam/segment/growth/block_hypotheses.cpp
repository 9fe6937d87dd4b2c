#include "slam/segment/growth/block_hypotheses.h"

#include "slam/base/index.h"

namespace slam {

void BlockHypotheses::Add(int block, int label, int plane) {
  const int added = static_cast<int>(list_.size());
  list_.push_back({});
  int* link = &first_[Index(block)];
  while (*link != kNoHypothesis && At(*link).label < label) link = &At(*link).next;
  At(added).label = label, At(added).plane = plane;
  At(added).next = *link;
  *link = added;
}

void BlockHypotheses::Remove(int block, int label) {
  int* link = &first_[Index(block)];
  while (At(*link).label != label) link = &At(*link).next;
  *link = At(*link).next;
}

int BlockHypotheses::Find(int block, int label) const {
  int k = First(block);
  while (At(k).label != label) k = At(k).next;
  return k;
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
