#include "app/suite/suite_cases.h"

#include <sys/stat.h>
#include <unistd.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <deque>
#include <initializer_list>
#include <map>

#include "io/atomic_file.h"
#include "io/folder_kind.h"
#include "io/input_error.h"
#include "io/output_folder.h"
#include "io/read_file.h"
#include "io/sha256.h"
#include "sim/families/families.h"
#include "sim/families/twin.h"
#include "sim/scene/read_scene.h"
#include "sim/scene/write_scene.h"

namespace app {
namespace {

namespace fs = std::filesystem;

/// Where the frames of a case come from, with its seed.
struct Source {
  const SuiteScene* scene = nullptr;
  fs::path recording;  ///< of a scene of recordings
  std::string label;   ///< SCENE-SEED
  std::uint64_t seed = 0;
};

/// What a case needs of its source: a file in the results folder, for a rendered scene.
struct Frames {
  std::vector<std::string> slam;  ///< arguments that name it
  std::string sha256;
  std::string setup;  ///< what the suite says of it, without paths
};

/// A file of the suite as the cases find it.
struct Input {
  std::string name, argument, sha256;
  std::string estimator = {};
};

/// Writes unless that is what is there, so that a resumed suite touches nothing.
void WriteOnce(const fs::path& file, const std::string& text) {
  if (fs::exists(file) && io::ReadFile(file) == text) return;
  io::MakeFolder(file.parent_path());
  io::WriteFile(file, text);
}

/// Settings, and the files that they name by whole paths, such as a depth warp.
std::string SettingsHash(const std::string& text) {
  std::string hashes = io::Sha256Hex(text);
  const auto visit = [&](const auto& self, const YAML::Node& node) -> void {
    if (node.IsScalar()) {
      const fs::path file = node.Scalar();
      std::error_code ignored;
      if (file.is_absolute() && fs::is_regular_file(file, ignored))
        hashes += io::Sha256OfFile(file);
    } else if (node.IsMap()) {
      for (const auto& member : node) self(self, member.second);
    } else {
      for (const auto& member : node) self(self, member);
    }
  };
  try {
    visit(visit, YAML::Load(text));
  } catch (const YAML::Exception&) {  // the program that reads them says what is wrong
  }
  return io::Sha256Hex(hashes);
}

/// Names, sizes and the text of its lists: reading every image would take longer than a case.
std::string RecordingHash(const fs::path& folder) {
  std::vector<fs::path> files;
  const auto options = fs::directory_options::follow_directory_symlink;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder, options)) {
    if (entry.is_regular_file()) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  std::string text;
  for (const fs::path& file : files) {
    text += fs::relative(file, folder).string() + " " + std::to_string(fs::file_size(file));
    const std::string kind = file.extension().string();
    if (kind == ".txt" || kind == ".yaml" || kind == ".jsonl") text += io::Sha256OfFile(file);
    text += "\n";
  }
  return io::Sha256Hex(text);
}

/// A place in the plan, before anything is made for it.
struct Place {
  std::string key;
  const Source* source;
  const Input* sensor;  ///< none for a recording
  std::string motion, variant;
  const Input* config;
};

class Planner {
 public:
  Planner(const SuiteFile& suite, fs::path recordings, const SuiteProgram& program,
          fs::path folder)
      : suite_(suite),
        recordings_(std::move(recordings)),
        program_(program),
        folder_(std::move(folder)) {}

  std::vector<SuiteCase> Plan(int seeds, const SuiteShard& shard) {
    FindPlaces(seeds);
    // Scenes are made for the cases of this shard alone: each of many shards makes few.
    std::vector<SuiteCase> cases;
    for (std::size_t at = shard.first; at < places_.size(); at += shard.count) {
      cases.push_back(CaseAt(places_[at]));
    }
    return cases;
  }

  std::vector<std::string> Keys(int seeds) {
    FindPlaces(seeds);
    std::vector<std::string> keys;
    for (const Place& place : places_) keys.push_back(place.key);
    return keys;
  }

 private:
  void FindPlaces(int seeds) {
    for (const SuiteChoice& sensor : suite_.sensors)
      sensors_.push_back(InputOf("sensor", sensor));
    for (const SuiteChoice& config : suite_.configs)
      configs_.push_back(InputOf("config", config));
    for (const SuiteScene& scene : suite_.scenes) {
      for (int i = 0; i < seeds; ++i) {
        const std::uint64_t seed = suite_.seeds.first + static_cast<std::uint64_t>(i);
        if (scene.source == SuiteScene::Source::kRecordings) {
          AddRecordings(scene, seed);
        } else {
          AddRendered(scene, seed);
        }
      }
    }
    std::sort(places_.begin(), places_.end(),
              [](const Place& a, const Place& b) { return a.key < b.key; });
  }

  Input InputOf(const std::string& kind, const SuiteChoice& choice) const {
    if (choice.file.empty()) return {choice.name, choice.name, "", choice.estimator};
    const std::string text = io::ReadFile(choice.file);
    const std::string place = "inputs/" + kind + "-" + choice.name + ".yaml";
    WriteOnce(folder_ / place, text);
    return {choice.name, place, SettingsHash(text), choice.estimator};
  }

  void AddRendered(const SuiteScene& scene, std::uint64_t seed) {
    const Source& source = sources_.emplace_back(
        Source{&scene, {}, scene.name + "-" + std::to_string(seed), seed});
    for (const Input& sensor : sensors_) {
      for (const std::string& motion : suite_.motions) AddEstimators(source, &sensor, motion);
    }
  }

  void AddRecordings(const SuiteScene& scene, std::uint64_t seed) {
    if (recordings_.empty()) {
      throw io::InputError("suite " + suite_.name,
                           "runs on recordings; say where they are with --recordings FOLDER");
    }
    bool any = false;
    for (const fs::directory_entry& entry : fs::directory_iterator(recordings_)) {
      if (!entry.is_directory() || io::KindOf(entry.path()) != io::FolderKind::kSequence)
        continue;
      any = true;
      const std::string name = entry.path().filename().string();
      const Source& source = sources_.emplace_back(
          Source{&scene, entry.path(), name + "-" + std::to_string(seed), seed});
      AddEstimators(source, nullptr, kOwnMotion);
    }
    if (!any) {
      throw io::InputError(recordings_.string(),
                           "holds no recording; expected folders with rgb.txt and depth.txt");
    }
  }

  void AddEstimators(const Source& source, const Input* sensor, const std::string& motion) {
    const std::string recorded = (sensor == nullptr ? "recorded" : sensor->name) + "/" + motion;
    for (const std::string& variant : suite_.variants) {
      for (const Input& config : configs_) {
        places_.push_back({source.label + "/" + recorded + "/" + variant + "/" + config.name,
                           &source, sensor, motion, variant, &config});
      }
    }
  }

  /// The scene of a source in the results folder, made once.
  const Frames& FramesOf(const Source& source) {
    const auto found = frames_.find(&source);
    if (found != frames_.end()) return found->second;
    return frames_[&source] = source.recording.empty() ? Rendered(source) : Recorded(source);
  }

  Frames Rendered(const Source& source) const {
    const SuiteScene& scene = *source.scene;
    Frames frames;
    std::string place = "scenes/" + source.label + ".yaml";
    if (scene.source == SuiteScene::Source::kFile) {
      place = scene.file.string();  // where its meshes are
      frames.sha256 = sim::SceneHash(sim::ReadScene(scene.file));
      frames.setup = frames.sha256;
    } else {
      frames.setup = scene.of;
      for (const auto& [name, value] : scene.parameters)
        frames.setup += " " + name + "=" + std::to_string(value);
      const std::string text =
          sim::SceneText(scene.source == SuiteScene::Source::kTwin
                             ? sim::MakeTwin(scene.of, source.seed)
                             : sim::MakeScene(scene.of, source.seed, scene.parameters));
      WriteOnce(folder_ / place, text);
      frames.sha256 = io::Sha256Hex(text);
    }
    frames.slam = {"--live", place};
    const auto add = [&](const char* option, const std::optional<int>& value) {
      if (!value) return;
      frames.slam.insert(frames.slam.end(), {option, std::to_string(*value)});
      frames.setup += std::string(" ") + option + " " + std::to_string(*value);
    };
    add("--frames", scene.frames ? scene.frames : suite_.frames);
    add("--width", suite_.width);
    add("--height", suite_.height);
    return frames;
  }

  Frames Recorded(const Source& source) const {
    Frames frames;
    frames.sha256 = RecordingHash(source.recording);
    frames.slam = {fs::canonical(source.recording).string(), "--sensor", source.scene->sensor};
    if (!fs::exists(source.recording / "camera.yaml")) {
      const Input camera = InputOf("camera", source.scene->camera);
      frames.slam.insert(frames.slam.end(), {"--camera", camera.argument});
      frames.sha256 =
          io::Sha256Hex(frames.sha256 + (camera.sha256.empty() ? camera.name : camera.sha256));
    }
    frames.setup = frames.sha256 + " " + source.scene->sensor;
    return frames;
  }

  SuiteCase CaseAt(const Place& place) {
    const Frames& frames = FramesOf(*place.source);
    SuiteCase one;
    one.scene = place.source->label;
    one.key = place.key;
    one.seed = place.source->seed;
    one.variant = place.variant;
    one.scene_sha256 = frames.sha256;
    one.slam = frames.slam;
    const auto add = [&](std::initializer_list<std::string> arguments) {
      one.slam.insert(one.slam.end(), arguments);
    };
    if (place.sensor != nullptr) {
      add({"--sim-sensor", place.sensor->argument, "--sensor", place.sensor->estimator});
      if (place.motion != kOwnMotion) add({"--motion", place.motion});
    }
    add({"--seed", std::to_string(one.seed), "--variant", one.variant, "--threads", "1",
         "--save-segmentation"});
    if (!place.config->sha256.empty()) add({"--config", place.config->argument});
    const std::string sensor_sha256 = place.sensor == nullptr ? "" : place.sensor->sha256;
    std::string inputs = program_.sha256 + "\n" + frames.sha256 + "\n" + sensor_sha256 + "\n" +
                         place.config->sha256 + "\n";
    for (const std::string& argument : one.slam) inputs += argument + "\n";
    one.inputs_sha256 = io::Sha256Hex(inputs);
    // Names of sensor, motion, variant, settings and the seed are in the key.
    std::string setup = one.key + "\n" + frames.setup + "\n" + sensor_sha256 + "\n" +
                        place.config->sha256 + "\n";
    if (place.sensor != nullptr) setup += place.sensor->estimator;
    one.setup_sha256 = io::Sha256Hex(setup);
    return one;
  }

  const SuiteFile& suite_;
  fs::path recordings_;
  const SuiteProgram& program_;
  fs::path folder_;
  std::vector<Input> sensors_, configs_;
  std::deque<Source> sources_;  ///< the places point to them
  std::vector<Place> places_;
  std::map<const Source*, Frames> frames_;
};

}  // namespace

namespace {

std::string StampOf(const fs::path& file) {
  struct stat is {};
  if (::stat(file.c_str(), &is) != 0) return "gone";
  return std::to_string(is.st_dev) + " " + std::to_string(is.st_ino) + " " +
         std::to_string(is.st_size) + " " + std::to_string(is.st_mtim.tv_sec) + " " +
         std::to_string(is.st_mtim.tv_nsec);
}

}  // namespace

void SuiteProgram::RequireUnchanged() const {
  if (StampOf(run) == stamp) return;
  throw io::InputError(
      file.string(),
      "has changed while the suite ran; what was done before is kept. Call it again "
      "when the program is done, or name a copy with --program");
}

SuiteProgram ProgramOf(const fs::path& file) {
  const fs::path program = file.empty() ? fs::path("/proc/self/exe") : file;
  std::error_code error;
  const fs::path absolute = fs::canonical(program, error);
  if (error || !fs::is_regular_file(absolute) || ::access(absolute.c_str(), X_OK) != 0) {
    throw io::InputError(program.string(), "is no program that can be run; name a built pas");
  }
  // What this process runs is there for as long as it runs, even when it is built anew beside it.
  const fs::path run =
      file.empty() ? fs::path("/proc") / std::to_string(::getpid()) / "exe" : absolute;
  const std::string stamp = StampOf(run);
  return {absolute, run, io::Sha256OfFile(run), stamp};
}

std::vector<std::string> CaseKeys(const SuiteFile& suite, int seeds, const fs::path& recordings,
                                  const fs::path& folder) {
  return Planner(suite, recordings, {}, folder).Keys(seeds);
}

std::vector<SuiteCase> PlanCases(const SuiteFile& suite, int seeds, const fs::path& recordings,
                                 const SuiteProgram& program, const fs::path& folder,
                                 const SuiteShard& shard) {
  return Planner(suite, recordings, program, folder).Plan(seeds, shard);
}

}  // namespace app
