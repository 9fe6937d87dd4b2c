#pragma once

#include <filesystem>
#include <string>

namespace app {

/// What who trains on an export of this sequence should know of it; empty when its colour is of
/// one instant, as masks, boxes and poses are, or its manifest.json tells nothing of a rolling
/// shutter.
std::string RollingWarning(const std::filesystem::path& sequence);

}  // namespace app
