#pragma once

#include <string>
#include <utility>
#include <vector>

namespace slam {

/// Colour and depth images farther apart in time make no frame: TUM's associate.py.
inline constexpr double kMaxPairing_s = 0.02;

/// One image of a list or of a topic.
struct StampedImage {
  double t = 0;        ///< seconds
  std::string file;    ///< its name in the list
  std::string source;  ///< where it is listed, for messages: "rgb.txt:12"
};

/// How often something was met, and where first.
class Counted {
 public:
  void Add(const std::string& source) {
    if (count_++ == 0) first_ = source;
  }
  int count() const { return count_; }
  const std::string& first() const { return first_; }

 private:
  int count_ = 0;
  std::string first_;
};

/// Which images of two lists make frames.
struct ImagePairs {
  std::vector<std::pair<std::size_t, std::size_t>> pairs;  ///< colour, depth; by colour
  std::vector<std::string> warnings;  ///< images without a partner, counted
};

/// Pairs two lists sorted by time: one to one, nearest pairs first, strictly within
/// kMaxPairing_s, as TUM's associate.py does.
ImagePairs PairImages(const std::vector<StampedImage>& rgb,
                      const std::vector<StampedImage>& depth);

}  // namespace slam
