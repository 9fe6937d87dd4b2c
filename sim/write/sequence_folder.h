#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

namespace sim {

/// What to do when the output folder is there already.
enum class Existing { kRefuse, kResume, kReplace };

/// Makes a folder that is there ready for a sequence whose unfinished manifest is `plan` (formats.md, with
/// complete: false). Afterwards the folder and rgb/, depth/, gt/plane_id/, gt/object_id/ exist
/// and manifest.json says complete: false, unless the result tells that all is done.
/// kReplace deletes only an empty folder or one with a sequence's manifest.
/// @returns true when a finished sequence of the same plan is there (kResume): nothing to do
/// @throws InputError when the folder exists (kRefuse), holds something else (kReplace), or was
///   begun with other options (kResume; the message names the first that differs)
bool PrepareFolder(const std::filesystem::path& folder, const nlohmann::ordered_json& plan,
                   Existing existing);

/// manifest.json of a folder; empty when there is none or it is not a sequence's.
std::optional<nlohmann::ordered_json> ReadManifest(const std::filesystem::path& folder);

void WriteManifest(const std::filesystem::path& folder, const nlohmann::ordered_json& manifest);

}  // namespace sim
