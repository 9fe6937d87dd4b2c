#include "slam/segment/block_hypotheses.h"

#include <algorithm>

#include "slam/segment/room.h"

namespace slam {

void BlockHypotheses::Begin(std::size_t blocks, int block_px) {
  set_words_ = WordsOfSet(block_px);
  first_.resize(blocks);
  Clear();
}

void BlockHypotheses::Clear() {
  list_.clear();
  std::fill(first_.begin(), first_.end(), kNoHypothesis);
}

void BlockHypotheses::Add(int block, int label, int plane) {
  const int added = static_cast<int>(list_.size());
  list_.push_back({});
  Provide(sets_, list_.size() * kSetCount * set_words_);
  int* link = &first_[static_cast<std::size_t>(block)];
  while (*link != kNoHypothesis && At(*link).label < label) link = &At(*link).next;
  At(added).label = label, At(added).plane = plane;
  At(added).next = *link;
  *link = added;
}

void BlockHypotheses::Remove(int block, int label) {
  int* link = &first_[static_cast<std::size_t>(block)];
  while (At(*link).label != label) link = &At(*link).next;
  *link = At(*link).next;
}

int BlockHypotheses::Find(int block, int label) const {
  int k = First(block);
  while (At(k).label != label) k = At(k).next;
  return k;
}

void BlockHypotheses::FindShared(int block, Set set, PixelSet shared) const {
  for (std::size_t word = 0; word < set_words_; ++word) {
    std::uint64_t seen = 0, twice = 0;
    for (int k = First(block); k != kNoHypothesis; k = At(k).next) {
      const std::uint64_t has = SetOf(k, set)[word];
      twice |= seen & has, seen |= has;
    }
    shared[word] = twice;
  }
}

}  // namespace slam
