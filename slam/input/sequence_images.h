#pragma once

#include <filesystem>
#include <memory>
#include <opencv2/core/mat.hpp>

#include "slam/geometry/camera.h"
#include "slam/input/sequence_index.h"

namespace slam {

/// The images of a sequence, wherever they are kept. Several threads may ask at once.
class SequenceImages {
 public:
  virtual ~SequenceImages() = default;
  /// The frames there are.
  virtual const SequenceIndex& index() const = 0;
  /// Colour and depth of frame i, of the camera's size.
  /// @throws InputError naming place and frame for an image that is missing, damaged, or of
  ///   another size or type.
  virtual cv::Mat3b Bgr(int i) const = 0;
  /// Planar z in metres, registered to colour; 0 = no measurement
  virtual cv::Mat1f Depth(int i) const = 0;
};

/// Opens a sequence folder (IndexSequence) or a bag (BagImages).
/// @throws InputError
std::unique_ptr<SequenceImages> OpenImages(const std::filesystem::path& sequence,
                                           const Camera& camera);

}  // namespace slam
