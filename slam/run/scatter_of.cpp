#include "slam/run/scatter_of.h"

#include <algorithm>

#include "io/folder_kind.h"
#include "slam/input/camera_reader.h"
#include "slam/input/sequence_reader.h"

namespace slam {

DepthScatter ScatterOf(const std::filesystem::path& sequence, const std::string& camera) {
  constexpr int kFrames = 10;
  io::RequireRecording(sequence);
  SequenceReader reader(sequence, ChooseCamera(camera, sequence).camera, {.prefetch = false});
  DepthScatter scatter;
  const int frames = std::min(kFrames, reader.size());
  for (int k = 0; k < frames; ++k) scatter.Add(reader.Read(k * reader.size() / frames).depth_m);
  return scatter;
}

}  // namespace slam
