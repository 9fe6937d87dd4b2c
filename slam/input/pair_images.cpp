#include "slam/input/pair_images.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace slam {
namespace {

/// What the colour and depth images without a partner come to; empty when there are none.
std::vector<std::string> LeftOut(const std::vector<StampedImage>& images, const Counted& rgb,
                                 const std::vector<StampedImage>& depth_images,
                                 const Counted& depth) {
  if (rgb.count() + depth.count() == 0) return {};
  const auto share = [](const Counted& some, std::size_t all, const char* what) {
    return std::to_string(some.count()) + " of " + std::to_string(all) + what +
           (some.count() > 0 ? " (first " + some.first() + ")" : "");
  };
  return {"left out, for nothing of the other kind is within 20 ms: " +
          share(rgb, images.size(), " colour images") + " and " +
          share(depth, depth_images.size(), " depth images")};
}

}  // namespace

ImagePairs PairImages(const std::vector<StampedImage>& rgb,
                      const std::vector<StampedImage>& depth) {
  // All pairs within the limit: time between them, colour, depth.
  std::vector<std::tuple<double, std::size_t, std::size_t>> candidates;
  for (std::size_t i = 0; i < rgb.size(); ++i) {
    auto it = std::lower_bound(depth.begin(), depth.end(), rgb[i].t - kMaxPairing_s,
                               [](const StampedImage& d, double t) { return d.t < t; });
    for (; it != depth.end() && it->t < rgb[i].t + kMaxPairing_s; ++it) {
      const double dt = std::abs(it->t - rgb[i].t);
      if (!(dt < kMaxPairing_s)) continue;
      candidates.emplace_back(dt, i, static_cast<std::size_t>(it - depth.begin()));
    }
  }
  // The nearest pairs first, each image once.
  std::sort(candidates.begin(), candidates.end());
  constexpr std::size_t kFree = static_cast<std::size_t>(-1);
  std::vector<std::size_t> depth_of(rgb.size(), kFree);
  std::vector<bool> taken(depth.size(), false);
  for (const auto& [dt, i, j] : candidates) {
    if (depth_of[i] != kFree || taken[j]) continue;
    depth_of[i] = j;
    taken[j] = true;
  }
  // Frames in the order of the colour images; what is left over is counted.
  ImagePairs made;
  Counted lone_rgb, lone_depth;
  for (std::size_t i = 0; i < rgb.size(); ++i) {
    if (depth_of[i] == kFree) {
      lone_rgb.Add(rgb[i].source);
      continue;
    }
    made.pairs.emplace_back(i, depth_of[i]);
  }
  for (std::size_t j = 0; j < depth.size(); ++j) {
    if (!taken[j]) lone_depth.Add(depth[j].source);
  }
  made.warnings = LeftOut(rgb, lone_rgb, depth, lone_depth);
  return made;
}

}  // namespace slam
