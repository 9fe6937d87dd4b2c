#include "slam/input/sequence_images.h"

#include "io/folder_kind.h"
#include "slam/input/bag_images.h"
#include "slam/input/folder_images.h"

namespace slam {

std::unique_ptr<SequenceImages> OpenImages(const std::filesystem::path& sequence,
                                           const Camera& camera) {
  if (io::IsBagFile(sequence)) return std::make_unique<BagImages>(sequence, camera);
  return std::make_unique<FolderImages>(sequence, camera);
}

}  // namespace slam
