#include "app/suite/suite_cases.h"

#include <unistd.h>

#include <algorithm>

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
  std::string label;              ///< SCENE-SEED
  std::vector<std::string> slam;  ///< arguments that name it
  std::string sha256;
  std::uint64_t seed = 0;
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

/// Names, sizes and the text of its lists: reading every image would take longer than a case.
std::string RecordingHash(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
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

class Planner {
 public:
  Planner(const SuiteFile& suite, fs::path recordings, const SuiteProgram& program,
          fs::path folder)
      : suite_(suite),
        recordings_(std::move(recordings)),
        program_(program),
        folder_(std::move(folder)) {}

  std::vector<SuiteCase> Plan(int seeds) {
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
    std::sort(cases_.begin(), cases_.end(),
              [](const SuiteCase& a, const SuiteCase& b) { return a.key < b.key; });
    return std::move(cases_);
  }

 private:
  Input InputOf(const std::string& kind, const SuiteChoice& choice) const {
    if (choice.file.empty()) return {choice.name, choice.name, "", choice.estimator};
    const std::string text = io::ReadFile(choice.file);
    const std::string place = "inputs/" + kind + "-" + choice.name + ".yaml";
    WriteOnce(folder_ / place, text);
    return {choice.name, place, io::Sha256Hex(text), choice.estimator};
  }

  Source SourceOf(const SuiteScene& scene, std::uint64_t seed) const {
    Source source;
    source.label = scene.name + "-" + std::to_string(seed);
    source.seed = seed;
    std::string place = "scenes/" + source.label + ".yaml";
    if (scene.source == SuiteScene::Source::kFile) {
      place = scene.file.string();  // where its meshes are
      source.sha256 = sim::SceneHash(sim::ReadScene(scene.file));
    } else {
      const std::string text =
          sim::SceneText(scene.source == SuiteScene::Source::kTwin
                             ? sim::MakeTwin(scene.of, seed)
                             : sim::MakeScene(scene.of, seed, scene.parameters));
      WriteOnce(folder_ / place, text);
      source.sha256 = io::Sha256Hex(text);
    }
    source.slam = {"--live", place};
    const auto add = [&](const char* option, const std::optional<int>& value) {
      if (value) source.slam.insert(source.slam.end(), {option, std::to_string(*value)});
    };
    add("--frames", scene.frames ? scene.frames : suite_.frames);
    add("--width", suite_.width);
    add("--height", suite_.height);
    return source;
  }

  void AddRendered(const SuiteScene& scene, std::uint64_t seed) {
    const Source source = SourceOf(scene, seed);
    for (const Input& sensor : sensors_) {
      for (const std::string& motion : suite_.motions) {
        std::vector<std::string> slam = source.slam;
        slam.insert(slam.end(),
                    {"--sim-sensor", sensor.argument, "--sensor", sensor.estimator});
        if (motion != kOwnMotion) slam.insert(slam.end(), {"--motion", motion});
        AddEstimators(source, sensor.name + "/" + motion, slam, sensor.sha256);
      }
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
      Source source;
      source.label = entry.path().filename().string() + "-" + std::to_string(seed);
      source.seed = seed;
      source.sha256 = RecordingHash(entry.path());
      source.slam = {fs::canonical(entry.path()).string(), "--sensor", scene.sensor};
      if (!fs::exists(entry.path() / "camera.yaml")) {
        source.slam.insert(source.slam.end(), {"--camera", scene.camera});
      }
      AddEstimators(source, "recorded/" + std::string(kOwnMotion), source.slam, "");
    }
    if (!any) {
      throw io::InputError(recordings_.string(),
                           "holds no recording; expected folders with rgb.txt and depth.txt");
    }
  }

  void AddEstimators(const Source& source, const std::string& recorded,
                     const std::vector<std::string>& slam, const std::string& sensor_sha256) {
    for (const std::string& variant : suite_.variants) {
      for (const Input& config : configs_) {
        SuiteCase one;
        one.scene = source.label;
        one.key = source.label + "/" + recorded + "/" + variant + "/" + config.name;
        one.seed = source.seed;
        one.variant = variant;
        one.scene_sha256 = source.sha256;
        one.slam = slam;
        one.slam.insert(one.slam.end(), {"--seed", std::to_string(source.seed), "--variant",
                                         variant, "--threads", "1", "--save-segmentation"});
        if (!config.sha256.empty()) {
          one.slam.insert(one.slam.end(), {"--config", config.argument});
        }
        std::string inputs = program_.sha256 + "\n" + source.sha256 + "\n" + sensor_sha256 +
                             "\n" + config.sha256 + "\n";
        for (const std::string& argument : one.slam) inputs += argument + "\n";
        one.inputs_sha256 = io::Sha256Hex(inputs);
        cases_.push_back(std::move(one));
      }
    }
  }

  const SuiteFile& suite_;
  fs::path recordings_;
  const SuiteProgram& program_;
  fs::path folder_;
  std::vector<Input> sensors_, configs_;
  std::vector<SuiteCase> cases_;
};

}  // namespace

SuiteProgram ProgramOf(const fs::path& file) {
  const fs::path program = file.empty() ? fs::path("/proc/self/exe") : file;
  std::error_code error;
  const fs::path absolute = fs::canonical(program, error);
  if (error || !fs::is_regular_file(absolute) || ::access(absolute.c_str(), X_OK) != 0) {
    throw io::InputError(program.string(), "is no program that can be run; name a built pas");
  }
  return {absolute, io::Sha256OfFile(absolute)};
}

std::vector<SuiteCase> PlanCases(const SuiteFile& suite, int seeds, const fs::path& recordings,
                                 const SuiteProgram& program, const fs::path& folder) {
  return Planner(suite, recordings, program, folder).Plan(seeds);
}

}  // namespace app
