#include "slam/input/folder_images.h"

#include <utility>

#include "io/input_error.h"
#include "io/path_type.h"
#include "slam/base/index.h"
#include "slam/input/frame_rate.h"
#include "slam/input/manifest_state.h"

namespace slam {
namespace {

std::string Context(int frame, const std::string& source) {
  return "frame " + std::to_string(frame) + ", " + source;
}

/// @param missing  what to do about a file that is not there
void RequireFile(const std::filesystem::path& file, int frame, const std::string& source,
                 const char* missing) {
  const std::string where = file.string() + " (" + Context(frame, source) + ")";
  if (!io::Exists(file)) throw io::InputError(where, std::string("no such file; ") + missing);
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error))
    throw io::InputError(where, "not a file; expected an image");
  if (std::filesystem::file_size(file, error) == 0)
    throw io::InputError(where, "the file is empty (0 bytes); copy it again");
}

}  // namespace

FolderImages::FolderImages(std::filesystem::path sequence, const Camera& camera)
    : sequence_(std::move(sequence)), camera_(camera), index_(IndexSequence(sequence_)) {
  const int frames = static_cast<int>(index_.entries.size());
  const ManifestState state = ReadManifestState(sequence_, frames);
  const char* missing = state.unfinished
                            ? "the sequence is not complete; finish it with `pas sim --resume`"
                            : "the list of images names it";
  for (int i = 0; i < frames; ++i) {
    const SequenceEntry& entry = index_.entries[Index(i)];
    RequireFile(sequence_ / entry.rgb, i, entry.rgb_source, missing);
    RequireFile(sequence_ / entry.depth, i, entry.depth_source, missing);
  }
  index_.warnings.insert(index_.warnings.end(), state.warnings.begin(), state.warnings.end());
  const std::string rate = RateWarning(index_.entries, camera_.fps);
  if (!rate.empty()) index_.warnings.push_back(rate);
}

cv::Mat3b FolderImages::Bgr(int i) const {
  const SequenceEntry& entry = index_.entries[Index(i)];
  return ReadImage(sequence_ / entry.rgb, ImageType::kColour, camera_,
                   Context(i, entry.rgb_source));
}

cv::Mat1f FolderImages::Depth(int i) const {
  const SequenceEntry& entry = index_.entries[Index(i)];
  return DepthInMetres(ReadImage(sequence_ / entry.depth, ImageType::kDepth, camera_,
                                 Context(i, entry.depth_source)),
                       camera_.depth_factor);
}

}  // namespace slam
