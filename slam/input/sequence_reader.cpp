#include "slam/input/sequence_reader.h"

#include <opencv2/imgproc.hpp>
#include <utility>

#include "io/input_error.h"
#include "io/path_type.h"
#include "slam/base/require.h"
#include "slam/input/image_file.h"
#include "slam/input/manifest_state.h"

namespace slam {
namespace {

/// @param missing  what to do about a file that is not there
void RequireFile(const std::filesystem::path& file, int frame, const std::string& source,
                 const char* missing) {
  const std::string where =
      file.string() + " (frame " + std::to_string(frame) + ", " + source + ")";
  if (!io::Exists(file)) throw io::InputError(where, std::string("no such file; ") + missing);
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error))
    throw io::InputError(where, "not a file; expected an image");
  if (std::filesystem::file_size(file, error) == 0)
    throw io::InputError(where, "the file is empty (0 bytes); copy it again");
}

}  // namespace

SequenceReader::SequenceReader(std::filesystem::path sequence, const Camera& camera,
                               Options options)
    : sequence_(std::move(sequence)),
      camera_(camera),
      options_(options),
      index_(IndexSequence(sequence_)) {
  const ManifestState state = ReadManifestState(sequence_, size());
  const char* missing = state.unfinished
                            ? "the sequence is not complete; finish it with `pas sim --resume`"
                            : "the list of images names it";
  for (int i = 0; i < size(); ++i) {
    RequireFile(sequence_ / entry(i).rgb, i, entry(i).source, missing);
    RequireFile(sequence_ / entry(i).depth, i, entry(i).source, missing);
  }
  index_.warnings.insert(index_.warnings.end(), state.warnings.begin(), state.warnings.end());
}

const SequenceEntry& SequenceReader::entry(int i) const {
  Require(i >= 0 && i < size(), "SequenceReader: there is no such frame");
  return index_.entries[static_cast<std::size_t>(i)];
}

RecordedFrame SequenceReader::Decode(int i) const {
  const SequenceEntry& e = entry(i);
  const std::string context = "frame " + std::to_string(i) + ", " + e.source;
  RecordedFrame frame;
  frame.index = i;
  frame.timestamp_s = e.timestamp_s;
  frame.bgr = ReadImage(sequence_ / e.rgb, ImageType::kColour, camera_, context);
  cv::cvtColor(frame.bgr, frame.gray, cv::COLOR_BGR2GRAY);
  frame.depth_m =
      DepthInMetres(ReadImage(sequence_ / e.depth, ImageType::kDepth, camera_, context),
                    camera_.depth_factor);
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
