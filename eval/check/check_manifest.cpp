#include "eval/check/check_manifest.h"

#include <map>
#include <optional>
#include <set>

#include "eval/formats/sequence/manifest.h"
#include "io/input_error.h"
#include "io/sha256.h"

namespace eval {
namespace {

namespace fs = std::filesystem;

// Nothing for a file that cannot be read.
std::optional<std::string> HashOf(const fs::path& file) {
  try {
    return io::Sha256OfFile(file);
  } catch (const io::InputError&) {
    return std::nullopt;
  }
}

// Files that the format knows, of those in the folder; whatever else lies there is ignored.
bool IsPartOfFormat(const std::string& file) {
  for (const char* name : {"rgb.txt", "depth.txt", "associations.txt", "groundtruth.txt",
                           "camera.yaml", "detections.jsonl", "gt/scene.json",
                           "gt/frames.jsonl", "gt/camera.yaml", "gt/depth_warp.png"}) {
    if (file == name) return true;
  }
  for (const char* folder : {"rgb/", "depth/", "gt/plane_id/", "gt/object_id/"}) {
    if (file.rfind(folder, 0) == 0 && file.ends_with(".png")) return true;
  }
  return false;
}

void CheckHashes(Folder& folder, const std::map<std::string, std::string>& hashes) {
  for (const auto& [file, told] : hashes) {
    const auto hash = HashOf(folder.root() / file);
    if (!hash) {
      folder.Tell(file, 0, "is in manifest.json, but is missing", "make the sequence again");
    } else if (*hash != told) {
      folder.Tell(file, 0, "has changed since the sequence was written (sha256 differs)",
                  "restore the file, or make the sequence again");
    }
  }
  std::set<std::string> unlisted;
  for (const auto& entry : fs::recursive_directory_iterator(folder.root())) {
    if (!entry.is_regular_file()) continue;
    const std::string file = fs::relative(entry.path(), folder.root()).generic_string();
    if (IsPartOfFormat(file) && hashes.count(file) == 0) unlisted.insert(file);
  }
  for (const std::string& file : unlisted) {
    folder.Tell(file, 0, "is not in manifest.json",
                "remove the file, or make the sequence again");
  }
}

}  // namespace

std::string CheckManifest(Folder& folder, int frames) {
  const Manifest manifest = ReadManifest(folder);
  TellFrameCount(folder, manifest, static_cast<std::size_t>(frames));
  if (manifest.sha256) CheckHashes(folder, *manifest.sha256);
  return manifest.sensor_as_named ? manifest.sensor : "";
}

}  // namespace eval
