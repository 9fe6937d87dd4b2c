#include "app/options/segmentation_option.h"

#include "app/options/choice_option.h"

namespace app {

void AddSegmentationOption(CLI::App& command, std::optional<slam::Segmentation>& segmentation) {
  command
      .add_option("--segmentation", segmentation,
                  "ours | ahc (PEAC as it was published, to compare with); the same as "
                  "plane_extraction: segmentation: of a --config, over which it goes")
      ->transform(ChoiceByIndex<slam::Segmentation>(slam::SegmentationNames()));
}

}  // namespace app
