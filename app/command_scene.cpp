#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "app/app.h"
#include "io/input_error.h"
#include "io/number_text.h"
#include "io/output_file.h"
#include "sim/families/families.h"
#include "sim/families/twin.h"
#include "sim/scene/names.h"
#include "sim/scene/read_scene.h"
#include "sim/scene/write_scene.h"
#include "sim/shapes/drawing.h"
#include "sim/shapes/planes.h"
#include "sim/shapes/steps.h"

namespace app {
namespace {

struct MakeOptions {
  std::string family = "desk";
  std::uint64_t seed = 1;
  std::string out;
  std::string twin;
  std::vector<std::string> settings;
  std::map<std::string, std::optional<double>> parameters;  ///< by name, of any family
  bool force = false;
};

std::map<std::string, double> ParseSettings(const std::vector<std::string>& settings) {
  std::map<std::string, double> values;
  for (const std::string& setting : settings) {
    const std::size_t equals = setting.find('=');
    const auto value = equals == std::string::npos
                           ? std::nullopt
                           : io::ParseNumber(setting.substr(equals + 1));
    if (!value) {
      throw io::InputError("--set " + setting, "expected NAME=NUMBER, such as step_mm=20");
    }
    if (!values.emplace(setting.substr(0, equals), *value).second) {
      throw io::InputError("--set " + setting, "was given twice; keep one");
    }
  }
  return values;
}

/// Those of --set and those with an option of their own.
std::map<std::string, double> Parameters(const MakeOptions& options) {
  std::map<std::string, double> values = ParseSettings(options.settings);
  for (const auto& [name, value] : options.parameters) {
    if (value && !values.emplace(name, *value).second) {
      throw io::InputError("--set " + name, "and its own option give it twice; keep one");
    }
  }
  return values;
}

void Make(const MakeOptions& options, const Globals& globals) {
  const std::map<std::string, double> parameters = Parameters(options);
  if (!options.twin.empty() && !parameters.empty()) {
    throw io::InputError("--twin " + options.twin, "has no parameters, found " +
                                                       parameters.begin()->first +
                                                       "; leave it out, or name a --family");
  }
  const io::OutputFile output(options.out, {.force = options.force});
  const sim::Scene scene = options.twin.empty()
                               ? sim::MakeScene(options.family, options.seed, parameters)
                               : sim::MakeTwin(options.twin, options.seed);
  output.Write(sim::SceneText(scene));
  if (!globals.quiet) {
    fmt::print("{}: {} objects, {} planes, sha256 {}\n", options.out, scene.objects.size(),
               sim::ScenePlanes(scene).size(), sim::SceneHash(scene).substr(0, 16));
  }
}

void List() {
  fmt::print("Families (pas scene make --family NAME --seed N -o scene.yaml):\n");
  for (const sim::Family& family : sim::Families()) {
    fmt::print("  {:<8} {}\n", family.name, family.provokes);
    for (const sim::FamilyParameter& parameter : family.parameters) {
      fmt::print("           --set {}={}  [{}, {}]  {}\n", parameter.name, parameter.value,
                 parameter.low, parameter.high, parameter.meaning);
    }
  }
  fmt::print(
      "\nTwins of recorded sequences (pas scene make --twin NAME --seed N -o scene.yaml):\n");
  for (const sim::Twin& twin : sim::Twins()) {
    fmt::print("  {:<14} {:<8} {:<7} {:.3f} m/s, {:.1f} deg/s, {:.1f} s\n", twin.name,
               twin.family, twin.preset, twin.speed_m_s, twin.turn_deg_s, twin.duration_s);
  }
  fmt::print(
      "\nCatalogue (in the source tree; scenes/README.md has the answers):\n"
      "  scenes/ambiguous/desk.yaml                the desk family, seed 1\n"
      "  scenes/closed_form/wall.yaml              one wall: a plane and nothing else\n"
      "  scenes/closed_form/corner.yaml            three planes that meet in one point\n"
      "  scenes/closed_form/parallel_boards.yaml   two tops, 20 mm apart in height\n"
      "  scenes/closed_form/fronto_parallel.yaml   a board square to the camera\n"
      "  scenes/closed_form/staircase.yaml         four tops, 5 to 40 mm over a floor\n"
      "  scenes/closed_form/half_hidden.yaml       one board before half of another\n");
}

const sim::Object& Owner(const sim::Scene& scene, int id) {
  for (const sim::Object& object : scene.objects) {
    if (object.id == id) return object;
  }
  throw std::logic_error("a plane without an owner");
}

/// A face by its name in files, "+z"; of a mesh, how many corners its outline has.
std::string NameOf(const sim::ScenePlane& plane, const sim::Object& owner) {
  if (owner.shape == sim::ShapeKind::kBox) {
    return sim::kFaceNames[static_cast<std::size_t>(plane.face)];
  }
  return std::to_string(plane.vertices_w.size()) + "-gon";
}

void Show(const std::string& path) {
  const sim::Scene scene = sim::ReadScene(path);
  const std::vector<sim::ScenePlane> planes = sim::ScenePlanes(scene);
  fmt::print("{}: {} objects, sha256 {}\n", scene.name, scene.objects.size(),
             sim::SceneHash(scene));
  fmt::print("\nPlanes, n . x + d = 0 in the world (metres, z up), n out of the object:\n");
  fmt::print("{:>5}  {:<18} {:<14} {:<12} {:>6} {:>8} {:>8} {:>8} {:>9} {:>9}\n", "plane",
             "object", "class", "role", "face", "n_x", "n_y", "n_z", "d_m", "area_m2");
  for (const sim::ScenePlane& plane : planes) {
    const sim::Object& owner = Owner(scene, plane.object);
    // Adding zero turns -0 into 0.
    fmt::print(
        "{:>5}  {:<18} {:<14} {:<12} {:>6} {:>8.4f} {:>8.4f} {:>8.4f} {:>9.4f} {:>9.4f}\n",
        plane.id, owner.name, owner.class_name,
        sim::kRoleNames[static_cast<std::size_t>(owner.role)], NameOf(plane, owner),
        plane.n_w.x() + 0.0, plane.n_w.y() + 0.0, plane.n_w.z() + 0.0, plane.d + 0.0,
        plane.area_m2);
  }
  for (const sim::Object& object : scene.objects) {
    const bool has_planes = object.shape == sim::ShapeKind::kBox ||
                            (object.model != nullptr && !object.model->planes.empty());
    if (has_planes && object.way.empty()) continue;
    fmt::print("       {:<18} {:<14} {:<12} no planes\n", object.name, object.class_name,
               sim::kRoleNames[static_cast<std::size_t>(object.role)]);
  }
  fmt::print("\nSteps of regular tops, to the highest surface under each:\n");
  fmt::print("{:>5}  {:<18} {:>9}  {}\n", "plane", "top of", "step_mm", "over");
  for (const sim::TopStep& step : sim::TopSteps(scene, planes)) {
    fmt::print("{:>5}  {:<18} {:>9.3f}  {}\n", step.plane, Owner(scene, step.object).name,
               step.step_mm, Owner(scene, step.below_object).name);
  }
}

/// What a parameter means, its bounds and its default, with the families of each meaning.
std::string MeaningOf(const std::string& parameter) {
  std::vector<std::pair<std::string, std::string>> meanings;  // and their families
  for (const sim::Family& family : sim::Families()) {
    for (const sim::FamilyParameter& one : family.parameters) {
      if (one.name != parameter) continue;
      const std::string meaning =
          fmt::format("{}{}[{}, {}], default {}", one.meaning, one.meaning.empty() ? "" : " ",
                      one.low, one.high, one.value);
      const auto known = std::find_if(meanings.begin(), meanings.end(),
                                      [&](const auto& m) { return m.first == meaning; });
      if (known == meanings.end()) {
        meanings.emplace_back(meaning, family.name);
      } else {
        known->second += ", " + family.name;
      }
    }
  }
  std::string text;
  for (const auto& [meaning, families] : meanings) {
    text += fmt::format("{}{}: {}", text.empty() ? "" : "; ", families, meaning);
  }
  return text;
}

void AddMake(CLI::App& scene, const Globals& globals, int& exit_code) {
  auto* make =
      scene.add_subcommand("make", "Make a scene of a family, reproducible by its seed");
  auto options = std::make_shared<MakeOptions>();
  make->add_option("--family", options->family, "Family, see `pas scene list`")
      ->capture_default_str();
  make->add_option("--twin", options->twin,
                   "Instead of a family: counterpart of a recorded sequence, with its motion, "
                   "camera and length; see `pas scene list`")
      ->excludes("--family");
  make->add_option("--seed", options->seed, "Any whole number from 0; the same gives the same")
      ->capture_default_str();
  make->add_option("-o,--output", options->out, "Scene file to write (YAML)")->required();
  make->add_option("--set", options->settings,
                   "Parameter of the family as NAME=NUMBER; may be repeated");
  for (const sim::Family& family : sim::Families()) {
    for (const sim::FamilyParameter& parameter : family.parameters) {
      const auto [at, fresh] = options->parameters.try_emplace(parameter.name);
      if (!fresh) continue;
      std::string name = "--" + parameter.name;
      std::replace(name.begin(), name.end(), '_', '-');
      make->add_option(name, at->second, MeaningOf(parameter.name))
          ->group("Parameters of families");
    }
  }
  make->add_flag("--force", options->force, "Overwrite the output when it exists");
  make->callback([options, &globals, &exit_code] {
    Make(*options, globals);
    exit_code = kDone;
  });
}

}  // namespace

void AddSceneCommand(CLI::App& pas, const Globals& globals, int& exit_code) {
  auto* scene = pas.add_subcommand("scene", "Make, list or show a tabletop scene");
  scene->require_subcommand(1);
  AddMake(*scene, globals, exit_code);

  auto* list =
      scene->add_subcommand("list", "The families with their parameters, and the catalogue");
  list->callback([&exit_code] {
    List();
    exit_code = kDone;
  });

  auto* show = scene->add_subcommand(
      "show",
      "The planes of a scene, and for each regular top the step to what is under it (mm)");
  auto path = std::make_shared<std::string>();
  auto svg = std::make_shared<std::string>();
  show->add_option("scene", *path, "Scene file (YAML)")->required();
  show->add_option("--svg", *svg,
                   "Draw plan and elevation with the steps in mm into this file instead");
  auto force = std::make_shared<bool>(false);
  show->add_flag("--force", *force, "Replace the file of --svg when it exists");
  show->callback([path, svg, force, &exit_code] {
    if (svg->empty()) {
      Show(*path);
    } else {
      const io::OutputFile output(*svg, {.force = *force, .inputs = {*path}});
      output.Write(sim::SceneSvg(sim::ReadScene(*path)));
    }
    exit_code = kDone;
  });
}

}  // namespace app
