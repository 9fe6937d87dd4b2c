#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "slam/run/config.h"

namespace app {

/// --segmentation: how the depth image is segmented into planes. `segmentation` stays empty
/// where it is not given.
void AddSegmentationOption(CLI::App& command, std::string& segmentation);

/// Takes what the option says into the settings; empty: leaves them.
void SetSegmentation(const std::string& segmentation, slam::Config& config);

}  // namespace app
