#pragma once

#include <filesystem>
#include <future>
#include <memory>
#include <string>
#include <vector>

#include "slam/geometry/camera.h"
#include "slam/input/frame_source.h"
#include "slam/input/sequence_images.h"

namespace slam {

/// Reads a sequence folder, or a bag, frame by frame. Truth (groundtruth.txt, gt/) is never
/// opened.
///
/// The next frame is decoded on one background thread while the caller works; what is returned
/// does not depend on it. One caller at a time.
class SequenceReader : public FrameSource {
 public:
  struct Options {
    bool prefetch = true;  ///< decode the next frame on a thread of its own
  };

  /// Lists the frames and checks that every image file is there and not empty.
  /// @throws InputError, see OpenImages.
  SequenceReader(const std::filesystem::path& sequence, const Camera& camera, Options options);
  SequenceReader(const std::filesystem::path& sequence, const Camera& camera)
      : SequenceReader(sequence, camera, Options{}) {}

  int size() const override { return static_cast<int>(images_->index().entries.size()); }
  const SequenceEntry& entry(int i) const;
  /// What is not used or looks wrong, known before the first frame.
  const std::vector<std::string>& warnings() const { return images_->index().warnings; }

  /// Frame i of [0, size()).
  /// @throws InputError, see SequenceImages
  RecordedFrame Read(int i) override;

 private:
  RecordedFrame Decode(int i) const;

  Options options_;
  std::unique_ptr<SequenceImages> images_;
  int ahead_index_ = -1;
  /// Last: its thread must end before the rest is destroyed.
  std::future<RecordedFrame> ahead_;
};

}  // namespace slam
