#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "slam/bag/bag_file.h"
#include "slam/input/bag_topics.h"
#include "slam/input/depth_registration.h"
#include "slam/input/sequence_images.h"

namespace slam {

/// The images of a bag of ROS 1: TUM's, of RealSense's library, and of the drivers that write
/// sensor_msgs/Image. An image is read when it is asked for.
///
/// Colour and depth are paired by the stamps of their headers, as in a folder. Depth is in
/// metres (32FC1), millimetres (16UC1, mono16: REP 118) or the unit that RealSense's library
/// has written beside it; the camera's depth_factor does not count. Depth of RealSense's
/// library that is not laid on colour is laid on it, see DepthRegistration.
class BagImages : public SequenceImages {
 public:
  /// @param camera  of the colour images
  /// @throws InputError for a bag without colour and depth, and for depth of another frame than
  ///   colour whose way to it the bag does not say
  BagImages(const std::filesystem::path& file, const Camera& camera);

  const SequenceIndex& index() const override { return index_; }
  cv::Mat3b Bgr(int i) const override;
  cv::Mat1f Depth(int i) const override;

 private:
  void PairByTime();

  BagFile bag_;
  BagTopics topics_;
  Camera camera_;
  double depth_factor_;                            ///< 16-bit units a metre
  std::optional<DepthRegistration> registration_;  ///< nothing: depth is laid on colour
  cv::Size depth_size_;
  SequenceIndex index_;
  std::vector<std::pair<int, int>> messages_;  ///< of each frame: colour, depth
};

}  // namespace slam
