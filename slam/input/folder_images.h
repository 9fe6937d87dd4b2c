#pragma once

#include <string>

#include "slam/input/image_file.h"
#include "slam/input/sequence_images.h"

namespace slam {

/// The image files of a sequence folder.
class FolderImages : public SequenceImages {
 public:
  /// Lists the frames and checks that every image file is there and not empty.
  /// @throws InputError, see IndexSequence.
  FolderImages(std::filesystem::path sequence, const Camera& camera);

  const SequenceIndex& index() const override { return index_; }
  cv::Mat3b Bgr(int i) const override;
  cv::Mat1f Depth(int i) const override;

 private:
  std::filesystem::path sequence_;
  Camera camera_;
  SequenceIndex index_;
};

}  // namespace slam
