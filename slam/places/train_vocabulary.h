#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "slam/places/vocabulary.h"

namespace slam {

/// Size of a tree of words, and how it is grown.
struct TrainingConfig {
  int branching = 10;      ///< children of a node; domain [2, 256]
  int depth = 4;           ///< levels below the root; domain [1, 8]
  int iterations = 12;     ///< largest number of rounds of clustering; domain [1, inf)
  int min_members = 8;     ///< a node of fewer descriptors is not divided; domain [1, inf)
  std::uint64_t seed = 0;  ///< chooses the first centres
};

/// Grows a vocabulary from the descriptors of training images: clusters of nearest centres in
/// bits that differ, each centre the majority of its members' bits, begun from members that
/// are far from the centres chosen before (k-means++). A word's weight is ln(images / images
/// that have it). The same descriptors and settings give the same vocabulary.
/// @param images  descriptors by image; all of them are held in memory
/// @throws std::invalid_argument when there is no descriptor.
Vocabulary TrainVocabulary(const std::vector<std::vector<Descriptor>>& images,
                           const TrainingConfig& config,
                           const std::function<void(double done)>& progress = {});

}  // namespace slam
