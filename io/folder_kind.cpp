#include "io/folder_kind.h"

#include <algorithm>
#include <initializer_list>
#include <set>

#include "io/input_error.h"
#include "io/path_type.h"

namespace io {
namespace {

namespace fs = std::filesystem;

/// The names in a folder; of a large one the first in the order of the file system.
std::set<std::string> NamesIn(const fs::path& folder) {
  constexpr std::size_t kMaxNames = 100000;  // more than any recording has images
  std::set<std::string> names;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    names.insert(entry->path().filename().string());
    if (names.size() == kMaxNames) break;
  }
  if (error) throw InputError(folder.string(), "cannot be read: " + error.message());
  return names;
}

FolderKind KindOfFile(const fs::path& file) {
  if (file.extension() == ".bag") return FolderKind::kRosBag;
  if (file.extension() == ".db3" || file.extension() == ".mcap") return FolderKind::kRosBag;
  return file.extension() == ".sens" ? FolderKind::kScanNet : FolderKind::kFile;
}

bool HasAny(const std::set<std::string>& names, std::initializer_list<const char*> some) {
  return std::any_of(some.begin(), some.end(),
                     [&](const char* name) { return names.count(name) > 0; });
}

FolderKind KindByNames(const std::set<std::string>& names) {
  const auto any = [&](std::initializer_list<const char*> some) { return HasAny(names, some); };
  const auto ends = [&](const char* suffix) {
    return std::any_of(names.begin(), names.end(),
                       [&](const std::string& name) { return name.ends_with(suffix); });
  };
  if (names.empty()) return FolderKind::kEmpty;
  if (any({"run.json"})) return FolderKind::kRun;
  if (any({"manifest.json", "rgb.txt", "depth.txt", "associations.txt"})) {
    return FolderKind::kSequence;
  }
  if (any({"color"}) && any({"depth"}) && any({"pose"})) return FolderKind::kScanNet;
  if (any({"rgb", "depth"})) return FolderKind::kSequence;
  if (any({"trajectory.txt", "frame_planes.jsonl", "map.json"})) return FolderKind::kRun;
  if (any({"export.json"})) return FolderKind::kExport;
  if (any({"contact_sheet.png"})) return FolderKind::kPictures;
  if (ends(".bag") || ends(".db3") || ends(".mcap")) return FolderKind::kRosBag;
  if (ends(".sens")) return FolderKind::kScanNet;
  if (ends(".color.png") || ends(".color.jpg")) return FolderKind::kSevenScenes;
  if (ends(".depth")) return FolderKind::kIclNuim;
  if (any({"traj.txt"}) && any({"results"})) return FolderKind::kReplica;
  if (ends(".png") || ends(".jpg")) return FolderKind::kImages;
  return FolderKind::kOther;
}

/// What it is, said of a folder or file.
std::string Said(FolderKind kind) {
  switch (kind) {
    case FolderKind::kNothing:
      return "no such folder";
    case FolderKind::kFile:
      return "is a file";
    case FolderKind::kEmpty:
      return "is an empty folder";
    case FolderKind::kSequence:
      return "is a sequence";
    case FolderKind::kRun:
      return "is a run of `pas slam`";
    case FolderKind::kPictures:
      return "holds pictures of `pas draw`";
    case FolderKind::kExport:
      return "is a data set of `pas export`";
    case FolderKind::kRosBag:
      return "is a ROS bag";
    case FolderKind::kScanNet:
      return "is a recording of ScanNet";
    case FolderKind::kSevenScenes:
      return "is a recording in the layout of 7-Scenes";
    case FolderKind::kIclNuim:
      return "is a recording of ICL-NUIM as it was rendered";
    case FolderKind::kReplica:
      return "is a recording of Replica as NICE-SLAM renders it";
    case FolderKind::kImages:
      return "holds images without a list of them";
    case FolderKind::kOther:
      break;
  }
  return "is a folder of another kind";
}

/// The first bag of ROS 1 in a folder; empty when there is none, as beside bags of ROS 2.
std::string BagInside(const fs::path& folder) {
  if (TypeAt(folder) != fs::file_type::directory) return "";
  for (const std::string& name : NamesIn(folder)) {
    if (IsBagFile(folder / name)) return (folder / name).string();
  }
  return "";
}

std::string Mend(const fs::path& folder, FolderKind found, FolderKind expected) {
  const std::string name = folder.string();
  switch (found) {
    case FolderKind::kFile:
      if (folder.extension() == ".yaml") {
        return "if it is a scene, render it first with `pas sim " + name + " -o SEQ`";
      }
      break;
    case FolderKind::kSequence:
      return "make one of it with `pas slam " + name + " -o RUN`";
    case FolderKind::kRun:
      return "`pas eval " + name + "` scores it, `pas draw " + name + " -o PICTURES` draws it";
    case FolderKind::kRosBag:
      if (IsBagFile(folder)) {
        return "make a folder of it with `pas import " + name + " -o SEQ`";
      }
      if (const std::string bag = BagInside(folder); !bag.empty()) {
        return "did you mean " + bag + "?";
      }
      [[fallthrough]];
    case FolderKind::kScanNet:
    case FolderKind::kSevenScenes:
    case FolderKind::kIclNuim:
    case FolderKind::kReplica:
    case FolderKind::kImages:
      return "convert it to TUM's format: rgb.txt and depth.txt with lines `timestamp file`, "
             "and PNG images (docs/cameras.md says how)";
    default:
      break;
  }
  return expected == FolderKind::kRun ? "name a folder that `pas slam` wrote"
                                      : "name a folder that `pas sim` wrote, or one in the "
                                        "format of TUM RGB-D (docs/cameras.md)";
}

/// A folder in this one that is what was expected; empty when there is none.
std::string Inside(const fs::path& folder, FolderKind expected) {
  std::error_code ignored;
  for (const std::string& name : NamesIn(folder)) {
    const fs::path inner = folder / name;
    if (fs::is_directory(inner, ignored) && KindOf(inner) == expected) return inner.string();
  }
  return "";
}

/// Whether a sequence, or a run, holds one of `names` too: somebody may keep both in one place.
bool IsBoth(const fs::path& folder, FolderKind found,
            std::initializer_list<const char*> names) {
  return (found == FolderKind::kSequence || found == FolderKind::kRun) &&
         HasAny(NamesIn(folder), names);
}

void Require(const fs::path& folder, FolderKind expected,
             std::initializer_list<const char*> names) {
  const FolderKind found = KindOf(folder);
  if (found == expected || IsBoth(folder, found, names)) return;
  const WrongFolder wrong = Unexpected(folder, found, expected);
  throw InputError(folder.string(), wrong.what + "; " + wrong.mend);
}

}  // namespace

FolderKind KindOf(const fs::path& folder) {
  const fs::file_type type = TypeAt(folder);
  if (type == fs::file_type::not_found) return FolderKind::kNothing;
  if (type == fs::file_type::regular) return KindOfFile(folder);
  if (type != fs::file_type::directory) {
    throw InputError(folder.string(),
                     std::string("is ") + NameOf(type) + ", expected a folder");
  }
  return KindByNames(NamesIn(folder));
}

WrongFolder Unexpected(const fs::path& folder, FolderKind found, FolderKind expected) {
  const char* wanted =
      expected == FolderKind::kSequence ? ", expected a sequence folder (rgb.txt, depth.txt)"
      : expected == FolderKind::kRun    ? ", expected a run folder (run.json)"
                                        : ", neither a sequence (rgb.txt) nor a run (run.json)";
  WrongFolder wrong{Said(found) + wanted, Mend(folder, found, expected)};
  const bool vague = found == FolderKind::kOther || found == FolderKind::kImages;
  if (vague && expected != FolderKind::kOther) {
    const std::string inside = Inside(folder, expected);
    if (!inside.empty()) wrong.mend = "did you mean " + inside + "?";
  }
  return wrong;
}

bool IsBagFile(const fs::path& path) {
  return path.extension() == ".bag" && TypeAt(path) == fs::file_type::regular;
}

void RequireSequence(const fs::path& folder) {
  Require(folder, FolderKind::kSequence, {"rgb.txt", "associations.txt"});
}

void RequireRun(const fs::path& folder) {
  Require(folder, FolderKind::kRun, {"trajectory.txt"});
}

void RequireRecording(const fs::path& recording) {
  if (recording.extension() == ".bag" && TypeAt(recording) == fs::file_type::not_found) {
    throw InputError(recording.string(),
                     "no such file; expected a bag of ROS 1, or a sequence folder");
  }
  if (!IsBagFile(recording)) RequireSequence(recording);
}

}  // namespace io
