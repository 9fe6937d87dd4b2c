#include "slam/input/sequence_reader.h"

#include <opencv2/imgproc.hpp>
#include <utility>

#include "slam/base/require.h"

namespace slam {

SequenceReader::SequenceReader(const std::filesystem::path& sequence, const Camera& camera,
                               Options options)
    : options_(options), images_(OpenImages(sequence, camera)) {}

const SequenceEntry& SequenceReader::entry(int i) const {
  Require(i >= 0 && i < size(), "SequenceReader: there is no such frame");
  return images_->index().entries[static_cast<std::size_t>(i)];
}

RecordedFrame SequenceReader::Decode(int i) const {
  RecordedFrame frame;
  frame.index = i;
  frame.timestamp_s = entry(i).timestamp_s;
  frame.depth_late_s = entry(i).depth_timestamp_s - entry(i).timestamp_s;
  frame.bgr = images_->Bgr(i);
  cv::cvtColor(frame.bgr, frame.gray, cv::COLOR_BGR2GRAY);
  frame.depth_m = images_->Depth(i);
  return frame;
}

RecordedFrame SequenceReader::Read(int i) {
  Require(i >= 0 && i < size(), "SequenceReader::Read: there is no such frame");
  const bool ready = ahead_.valid() && std::exchange(ahead_index_, -1) == i;
  RecordedFrame frame = ready ? ahead_.get() : Decode(i);
  if (options_.prefetch && i + 1 < size()) {
    ahead_ = std::async(std::launch::async, [this, i] { return Decode(i + 1); });
    ahead_index_ = i + 1;
  }
  return frame;
}

}  // namespace slam
