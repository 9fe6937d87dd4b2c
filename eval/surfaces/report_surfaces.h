#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "eval/surfaces/score_surfaces.h"

namespace eval {

/// Adds the group `surfaces` and its rules to metrics.json.
void AddSurfaces(const SurfaceScore& score, const std::string& surfaces,
                 nlohmann::ordered_json& metrics);

/// Rows for a terminal: the total, then a row a surface. Ends in a newline.
std::string SurfacesTable(const SurfaceScore& score);

}  // namespace eval
