#include "slam/input/sequence_images.h"

#include "slam/input/folder_images.h"

namespace slam {

std::unique_ptr<SequenceImages> OpenImages(const std::filesystem::path& sequence,
                                           const Camera& camera) {
  return std::make_unique<FolderImages>(sequence, camera);
}

}  // namespace slam
