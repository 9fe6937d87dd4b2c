#include "app/segmentation_option.h"

#include <algorithm>

namespace app {

void AddSegmentationOption(CLI::App& command, std::string& segmentation) {
  command
      .add_option("--segmentation", segmentation,
                  "ours | ahc (PEAC as it was published, to compare with); the same as "
                  "plane_extraction: segmentation: of a --config, over which it goes")
      ->check(CLI::IsMember(slam::SegmentationNames()));
}

void SetSegmentation(const std::string& segmentation, slam::Config& config) {
  if (segmentation.empty()) return;
  const std::vector<std::string>& names = slam::SegmentationNames();
  const auto position = std::find(names.begin(), names.end(), segmentation) - names.begin();
  config.plane_extraction.segmentation = static_cast<slam::Segmentation>(position);
}

}  // namespace app
