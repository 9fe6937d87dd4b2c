#pragma once

#include <filesystem>
#include <string>

#include "slam/calibrate/depth_scatter.h"

namespace slam {

/// How the depth of a recording scatters, in a few frames from all over it.
/// @param sequence  a folder or a bag, as of RunOptions
/// @param camera    as of RunOptions
/// @throws InputError for bad input
DepthScatter ScatterOf(const std::filesystem::path& sequence, const std::string& camera);

}  // namespace slam
