#include "app/suite/shrink_case.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>

#include "eval/regression/gate.h"
#include "io/atomic_file.h"
#include "io/input_error.h"
#include "io/output_folder.h"
#include "io/read_file.h"
#include "sim/scene/check.h"
#include "sim/scene/read_scene.h"
#include "sim/scene/write_scene.h"

namespace app {
namespace {

namespace fs = std::filesystem;

constexpr int kMinSide_px = 40;  // below, no cell of the extraction is left
constexpr int kOwnWidth_px = 640, kOwnHeight_px = 480;  // what `pas sim` takes without options
constexpr const char* kFolder = "shrunk";

class Shrinker {
 public:
  Shrinker(const SuiteCase& one, const SuiteFile& suite, const SuiteProgram& program,
           const fs::path& folder, const eval::Figures* before,
           const std::function<bool()>& stop)
      : one_(one),
        suite_(suite),
        program_(program),
        folder_(folder),
        before_(before),
        stop_(stop),
        bounds_(suite.gate.worst) {
    if (one.slam.empty() || one.slam.front() != "--live") {
      throw io::InputError(one.key, "is of a recording; only rendered cases can be shrunk");
    }
    scene_ = sim::ReadScene(folder / one.slam[1]);
    NameMeshesFrom(fs::absolute(folder / one.slam[1]).parent_path());
    if (scene_.capture) {
      best_.width = scene_.capture->width;
      best_.height = scene_.capture->height;
    } else {
      best_.width = kOwnWidth_px;
      best_.height = kOwnHeight_px;
    }
    best_.frames = Number("--frames", scene_.capture.value_or(sim::Capture{}).frames);
    best_.width = Number("--width", best_.width);
    best_.height = Number("--height", best_.height);
    best_.scene = folder / kFolder / "scene.yaml";
    best_.suite = folder / kFolder / "suite.yaml";
    io::MakeFolder(folder / kFolder);
  }

  /// No suite is written or named when it is stopped before the case has failed once.
  ShrunkCase Shrink() {
    if (!FindFailure()) return {};
    for (bool smaller = true; smaller && !stop_();) {
      smaller = Halve(&ShrunkCase::frames, 2);
      smaller = HalveImage() || smaller;
      smaller = DropObjects() || smaller;
    }
    Write();
    return best_;
  }

 private:
  /// @returns false when it was stopped before the case has failed
  bool FindFailure() {
    const CaseResult whole = Try(scene_, best_);
    failure_ = FailureOf(whole, bounds_);
    if (failure_.status == CaseStatus::kStopped) return false;
    if (failure_.status != CaseStatus::kFinished) {
      best_.failure = NameOf(failure_.status);
    } else if (!failure_.beyond.empty()) {
      best_.failure = fmt::format("{} beyond its bound", fmt::join(failure_.beyond, ", "));
    } else {
      FailByBaseline(whole);
    }
    return true;
  }

  /// From here on the case fails by the figure that is worse than the baseline's alone.
  void FailByBaseline(const CaseResult& whole) {
    if (before_ == nullptr) {
      throw io::InputError(one_.key,
                           "does not fail; bound its figures by `gate: worst:` in the suite, "
                           "or name a --baseline that has figures of it");
    }
    const auto worse = FindWorseFigure(*before_, whole.figures);
    if (!worse) {
      throw io::InputError(one_.key,
                           "does not fail, and is not worse than in the baseline by any figure "
                           "that can be bounded");
    }
    const double half_change = (worse->now - worse->before) / 2;
    bounds_ = {{worse->figure, (worse->before + worse->now) / 2}};
    other_failure_ = {{worse->figure, worse->now + half_change}};
    failure_.beyond = {worse->figure};
    best_.failure = fmt::format("{} is {}, and {} in the baseline", worse->figure, worse->now,
                                worse->before);
  }

  /// The smaller scene stands in another folder; its meshes are found by their whole paths.
  void NameMeshesFrom(const fs::path& scene_folder) {
    for (sim::Object& object : scene_.objects) {
      if (!object.model) continue;
      auto model = std::make_shared<sim::Model>(*object.model);
      model->options.file = (scene_folder / model->options.file).lexically_normal().string();
      object.model = std::move(model);
    }
  }

  /// What the case gives for an option.
  std::string After(const char* option, const std::string& otherwise) const {
    const auto found = std::find(one_.slam.begin(), one_.slam.end(), option);
    return found == one_.slam.end() ? otherwise : *std::next(found);
  }

  int Number(const char* option, int otherwise) const {
    return std::stoi(After(option, std::to_string(otherwise)));
  }

  static void Set(std::vector<std::string>& arguments, const char* option, int value) {
    const auto found = std::find(arguments.begin(), arguments.end(), option);
    if (found == arguments.end()) {
      arguments.insert(arguments.end(), {option, std::to_string(value)});
    } else {
      *std::next(found) = std::to_string(value);
    }
  }

  CaseResult Try(const sim::Scene& scene, const ShrunkCase& size) {
    if (sim::FindFault(scene)) return {};
    sim::WriteScene(scene, size.scene);
    SuiteCase smaller = one_;
    smaller.slam[1] = std::string(kFolder) + "/scene.yaml";
    Set(smaller.slam, "--frames", size.frames);
    Set(smaller.slam, "--width", size.width);
    Set(smaller.slam, "--height", size.height);
    ++best_.runs;
    return RunCase(smaller, program_, suite_.limits, folder_, stop_);
  }

  /// Takes a smaller case over if it fails alike.
  bool Take(sim::Scene scene, ShrunkCase size) {
    if (stop_()) return false;
    const CaseResult result = Try(scene, size);
    if (!FailsAlike(failure_, FailureOf(result, bounds_)) ||
        !eval::BeyondBounds(result.figures, other_failure_).empty()) {
      return false;
    }
    size.runs = best_.runs;
    best_ = size;
    scene_ = std::move(scene);
    return true;
  }

  bool Halve(int ShrunkCase::*number, int min) {
    bool any = false;
    for (;;) {
      ShrunkCase size = best_;
      size.*number /= 2;
      if (size.*number < min || !Take(scene_, size)) return any;
      any = true;
    }
  }

  bool HalveImage() {
    bool any = false;
    for (;;) {
      ShrunkCase size = best_;
      size.width /= 2;
      size.height /= 2;
      if (std::min(size.width, size.height) < kMinSide_px || !Take(scene_, size)) return any;
      any = true;
    }
  }

  /// Leaves out halves of the objects, then quarters, down to single ones.
  bool DropObjects() {
    bool any = false;
    for (std::size_t count = (scene_.objects.size() + 1) / 2; count > 0; count /= 2) {
      for (std::size_t from = 0; from + count <= scene_.objects.size();) {
        sim::Scene fewer = scene_;
        const auto first = fewer.objects.begin() + static_cast<std::ptrdiff_t>(from);
        fewer.objects.erase(first, first + static_cast<std::ptrdiff_t>(count));
        if (!fewer.objects.empty() && Take(std::move(fewer), best_)) {
          any = true;
        } else {
          from += count;
        }
      }
    }
    return any;
  }

  /// Copies a file of the case beside the suite, which may be taken elsewhere. @returns its name
  std::string Beside(const fs::path& input) const {
    const fs::path name = input.filename();
    io::WriteFile(best_.suite.parent_path() / name, io::ReadFile(folder_ / input));
    return name.string();
  }

  void Write() {
    best_.objects = scene_.objects.size();
    sim::WriteScene(scene_, best_.scene);
    const std::string text = fmt::format(
        "# What is left of {}: {}\n"
        "format: pas-suite/1\nname: shrunk\nframes: {}\nsize_px: [{}, {}]\n"
        "limits: {{seconds: {}, memory_mb: {}}}\nseeds: {{first: {}}}\n"
        "scenes: [{{file: scene.yaml}}]\nvariants: [{}]\nmotions: [{}]\n",
        one_.key, best_.failure, best_.frames, best_.width, best_.height, suite_.limits.seconds,
        suite_.limits.memory_mb, one_.seed, one_.variant, After("--motion", kOwnMotion));
    io::WriteFile(best_.suite, text + SensorText() + ConfigText() + GateText());
  }

  std::string SensorText() const {
    const std::string sensor = After("--sim-sensor", "kinect1");
    const bool own = sensor.find('/') != std::string::npos;
    return own ? fmt::format("sensors: [{{name: own, file: {}, estimator: {}}}]\n",
                             Beside(sensor), After("--sensor", "kinect1"))
               : fmt::format("sensors: [{}]\n", sensor);
  }

  std::string ConfigText() const {
    const std::string config = After("--config", "");
    if (config.empty()) return "";
    return fmt::format("configs: [{{name: own, file: {}}}]\n", Beside(config));
  }

  std::string GateText() const {
    if (bounds_.empty()) return "";
    std::string text = "gate:\n  worst:\n";
    for (const auto& [figure, bound] : bounds_) {
      text += fmt::format("    {}: {}\n", figure, bound);
    }
    return text;
  }

  const SuiteCase& one_;
  const SuiteFile& suite_;
  const SuiteProgram& program_;
  fs::path folder_;
  const eval::Figures* before_;
  std::function<bool()> stop_;
  /// What the failing case is beyond, and what a smaller one that fails alike is not.
  std::map<std::string, double> bounds_, other_failure_;
  sim::Scene scene_;
  ShrunkCase best_;
  CaseFailure failure_;
};

}  // namespace

std::optional<WorseFigure> FindWorseFigure(const eval::Figures& before,
                                           const eval::Figures& now) {
  const auto value = [](const eval::Figures& figures, const char* name) {
    const auto found = figures.find(name);
    return found == figures.end() ? std::nullopt : found->second;
  };
  std::optional<WorseFigure> worst;
  double most = 1.0;  // times what matters
  for (const auto& [figure, kind] : eval::GatedMetrics()) {
    const std::optional<double> was = value(before, figure), is = value(now, figure);
    if (kind == eval::MetricKind::kTime || !was || !is) continue;
    const double harm = eval::Harm(kind, *was, *is) / eval::MaxHarm(kind);
    if (harm <= most) continue;
    most = harm;
    worst = WorseFigure{figure, *was, *is};
  }
  return worst;
}

CaseFailure FailureOf(const CaseResult& result, const std::map<std::string, double>& worst) {
  CaseFailure failure{result.status, "", {}};
  // Digits are lines, frames and sizes, which change when a case shrinks.
  std::copy_if(result.message.begin(), result.message.end(),
               std::back_inserter(failure.message),
               [](unsigned char c) { return std::isdigit(c) == 0; });
  failure.beyond = eval::BeyondBounds(result.figures, worst);
  return failure;
}

bool FailsAlike(const CaseFailure& first, const CaseFailure& second) {
  if (first.status != second.status) return false;
  if (first.status != CaseStatus::kFinished) return first.message == second.message;
  return std::any_of(first.beyond.begin(), first.beyond.end(), [&](const std::string& figure) {
    return std::count(second.beyond.begin(), second.beyond.end(), figure) > 0;
  });
}

ShrunkCase ShrinkCase(const SuiteCase& one, const SuiteFile& suite, const SuiteProgram& program,
                      const fs::path& folder, const eval::Figures* before,
                      const std::function<bool()>& stop) {
  return Shrinker(one, suite, program, folder, before, stop).Shrink();
}

}  // namespace app
