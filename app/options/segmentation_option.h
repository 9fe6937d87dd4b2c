#pragma once

#include <CLI/CLI.hpp>
#include <optional>

#include "slam/segment/extraction_config.h"

namespace app {

/// --segmentation: how the depth image is segmented into planes; over the settings where it is
/// given.
void AddSegmentationOption(CLI::App& command, std::optional<slam::Segmentation>& segmentation);

}  // namespace app
