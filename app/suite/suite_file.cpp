#include "app/suite/suite_file.h"

#include <algorithm>
#include <set>

#include "app/options/depth_sensor_option.h"
#include "eval/regression/gated_metrics.h"
#include "io/yaml_value.h"
#include "sim/families/families.h"
#include "sim/families/twin.h"
#include "sim/scene/names.h"
#include "slam/geometry/sensor_model.h"

namespace app {
namespace {

namespace fs = std::filesystem;

constexpr const char* kFormat = "pas-suite/1";
const std::vector<std::string> kVariants{"full", "no-association",
                                         "no-processing-no-association", "points"};
const std::vector<std::string> kTumCameras{"tum1", "tum2", "tum3"};
// What scenes are recorded with, and what a sensor of the user's is taken for.
constexpr const char* kDefaultSensor = "kinect1";

/// Reads one suite file; its folder is where relative paths begin.
class SuiteReader {
 public:
  explicit SuiteReader(const fs::path& file) : file_(file), root_(io::ReadYaml(file)) {}

  SuiteFile Read() const {
    const io::YamlMap map(
        root_, {"format", "name", "frames", "size_px", "limits", "seeds", "scenes", "sensors",
                "motions", "variants", "configs", "gate"});
    map.At("format").OneOf({kFormat});
    SuiteFile suite;
    suite.name = map.At("name").Word();
    if (map.Has("frames")) suite.frames = Frames(map.At("frames"));
    if (map.Has("size_px")) ReadSize(map.At("size_px"), suite);
    if (map.Has("limits")) suite.limits = Limits(map.At("limits"));
    if (map.Has("seeds")) suite.seeds = Seeds(map.At("seeds"));
    for (const io::YamlValue& scene : map.At("scenes").List()) AddScene(scene, suite.scenes);
    if (suite.scenes.empty()) map.At("scenes").Fail("names no scene; add one");
    suite.sensors = {{kDefaultSensor, "", kDefaultSensor}};
    if (map.Has("sensors")) suite.sensors = Sensors(map.At("sensors"));
    suite.motions = {kOwnMotion};
    if (map.Has("motions")) suite.motions = Motions(map.At("motions"));
    suite.variants = {kVariants.front()};
    if (map.Has("variants")) suite.variants = Words(map.At("variants"), kVariants);
    suite.configs = {{kDefaultConfig, ""}};
    if (map.Has("configs")) suite.configs = Configs(map.At("configs"));
    if (map.Has("gate")) ReadGate(map.At("gate"), suite);
    return suite;
  }

 private:
  static int Frames(const io::YamlValue& value) {
    return value.Whole(io::Interval("[1, 1000000]"));
  }

  static void ReadSize(const io::YamlValue& value, SuiteFile& suite) {
    const std::vector<io::YamlValue> sides = value.List();
    if (sides.size() != 2) value.Fail("expected [width, height] in pixels, such as [320, 240]");
    const io::Interval pixels("[16, 8192]");
    suite.width = sides[0].Whole(pixels);
    suite.height = sides[1].Whole(pixels);
  }

  static SuiteLimits Limits(const io::YamlValue& value) {
    const io::YamlMap map(value, {"seconds", "memory_mb"});
    SuiteLimits limits;
    if (map.Has("seconds"))
      limits.seconds = map.At("seconds").Number(io::Interval("[0.01, 1e6]"));
    if (map.Has("memory_mb"))
      limits.memory_mb = map.At("memory_mb").Whole(io::Interval("[16, 1e6]"));
    return limits;
  }

  static SuiteSeeds Seeds(const io::YamlValue& value) {
    const io::YamlMap map(value, {"first", "count", "max_count"});
    const io::Interval counts("[1, 100000]");
    SuiteSeeds seeds;
    if (map.Has("first")) seeds.first = map.At("first").Seed();
    if (map.Has("count")) seeds.count = map.At("count").Whole(counts);
    seeds.max_count = seeds.count;
    if (map.Has("max_count")) seeds.max_count = map.At("max_count").Whole(counts);
    if (seeds.max_count < seeds.count) {
      map.At("max_count").Fail("is less than count; seeds are added, never taken away");
    }
    return seeds;
  }

  /// A path relative to the suite.
  fs::path PathOf(const io::YamlValue& value) const {
    return fs::absolute(file_).parent_path() / value.Path();
  }

  /// The same, of a file that is there.
  fs::path ExistingFile(const io::YamlValue& value) const {
    const fs::path file = PathOf(value);
    if (!fs::is_regular_file(file)) value.Fail(file.string() + " is no file; mend the path");
    return fs::canonical(file);
  }

  void AddScene(const io::YamlValue& value, std::vector<SuiteScene>& scenes) const {
    const io::YamlMap map(value, {"family", "twin", "file", "recordings", "name", "set",
                                  "frames", "camera", "sensor"});
    const std::vector<std::string> sources{"family", "twin", "file", "recordings"};
    if (std::count_if(sources.begin(), sources.end(),
                      [&](const std::string& key) { return map.Has(key); }) != 1) {
      value.Fail("expected one of family, twin, file, recordings");
    }
    SuiteScene scene;
    if (map.Has("family")) {
      ReadFamily(map, scene);
    } else if (map.Has("twin")) {
      scene.source = SuiteScene::Source::kTwin;
      std::vector<std::string> names;
      for (const sim::Twin& twin : sim::Twins()) names.push_back(twin.name);
      scene.of = names[map.At("twin").OneOf(names)];
    } else if (map.Has("file")) {
      scene.source = SuiteScene::Source::kFile;
      scene.file = ExistingFile(map.At("file"));
    } else {
      ReadRecordings(map, scene);
    }
    for (const char* key : {"camera", "sensor"}) {
      if (map.Has(key) && !map.Has("recordings")) map.At(key).Fail("is for recordings only");
    }
    if (map.Has("set") && !map.Has("family")) map.At("set").Fail("is for families only");
    if (map.Has("frames")) scene.frames = Frames(map.At("frames"));
    scene.name =
        scene.source == SuiteScene::Source::kFile ? scene.file.stem().string() : scene.of;
    if (map.Has("name")) scene.name = Name(map.At("name"));
    for (const SuiteScene& other : scenes) {
      if (other.source == SuiteScene::Source::kRecordings && other.source == scene.source)
        value.Fail(
            "the recordings are named already, and their cases would have the same keys; keep "
            "one");
      if (other.name == scene.name) {
        value.Fail("there is a scene called " + scene.name + " already; give this one a name:");
      }
    }
    scenes.push_back(scene);
  }

  static void ReadFamily(const io::YamlMap& map, SuiteScene& scene) {
    std::vector<std::string> names;
    for (const sim::Family& family : sim::Families()) names.push_back(family.name);
    const sim::Family& family = sim::Families()[map.At("family").OneOf(names)];
    scene.of = family.name;
    if (!map.Has("set")) return;
    std::vector<std::string> parameters;
    for (const sim::FamilyParameter& parameter : family.parameters) {
      parameters.push_back(parameter.name);
    }
    const io::YamlMap set(map.At("set"), parameters);
    for (const sim::FamilyParameter& parameter : family.parameters) {
      if (!set.Has(parameter.name)) continue;
      const io::Interval domain(parameter.low, parameter.high);
      scene.parameters[parameter.name] = parameter.whole
                                             ? set.At(parameter.name).Whole(domain)
                                             : set.At(parameter.name).Number(domain);
    }
  }

  /// A calibration of TUM's, or a camera file of the user's.
  SuiteChoice Camera(const io::YamlValue& value) const {
    const std::string name = value.Path();
    if (std::count(kTumCameras.begin(), kTumCameras.end(), name) > 0) return {name, ""};
    const fs::path file = PathOf(value);
    if (!fs::is_regular_file(file)) {
      value.Fail("expected tum1, tum2, tum3 or a file; there is no " + file.string());
    }
    return {file.stem().string(), fs::canonical(file)};
  }

  void ReadRecordings(const io::YamlMap& map, SuiteScene& scene) const {
    scene.source = SuiteScene::Source::kRecordings;
    map.At("recordings").OneOf({"all"});
    scene.of = "recordings";
    if (map.Has("frames")) map.At("frames").Fail("cannot shorten recordings; leave it out");
    if (map.Has("name"))
      map.At("name").Fail("is not of recordings, which have names of their own; leave it out");
    scene.camera = {kTumCameras.front(), ""};
    if (map.Has("camera")) scene.camera = Camera(map.At("camera"));
    const std::vector<std::string>& sensors = slam::DepthSensorNames();
    scene.sensor = map.Has("sensor") ? sensors[map.At("sensor").OneOf(sensors)] : kAutoSensor;
  }

  /// A name that is part of a key.
  static std::string Name(const io::YamlValue& value) {
    std::string name = value.Word();
    if (name.find_first_of("/ ") != std::string::npos) {
      value.Fail("names have no '/' and no blank, because keys of cases are made of them");
    }
    return name;
  }

  /// The entries of a list, none of which is there twice.
  static std::vector<io::YamlValue> Entries(const io::YamlValue& value) {
    std::vector<io::YamlValue> entries = value.List();
    if (entries.empty()) value.Fail("is empty; name one, or leave the key out");
    return entries;
  }

  template <typename T>
  static void RefuseTwice(const io::YamlValue& value, const std::set<T>& seen, const T& name) {
    if (seen.count(name) > 0)
      value.Fail("gives " + name + " twice; give each a name of its own");
  }

  static std::vector<std::string> Words(const io::YamlValue& value,
                                        const std::vector<std::string>& known) {
    std::vector<std::string> words;
    for (const io::YamlValue& entry : Entries(value)) {
      const std::string& word = known[entry.OneOf(known)];
      RefuseTwice(entry, std::set<std::string>(words.begin(), words.end()), word);
      words.push_back(word);
    }
    return words;
  }

  static std::vector<std::string> Motions(const io::YamlValue& value) {
    std::vector<std::string> known = sim::kPresetNames;
    known.emplace_back(kOwnMotion);
    return Words(value, known);
  }

  std::vector<SuiteChoice> Sensors(const io::YamlValue& value) const {
    std::vector<SuiteChoice> sensors;
    std::set<std::string> seen;
    const std::vector<std::string>& estimators = slam::DepthSensorNames();
    for (const io::YamlValue& entry : Entries(value)) {
      SuiteChoice sensor;
      if (entry.IsScalar()) {
        sensor.name = sim::kSensorNames[entry.OneOf(sim::kSensorNames)];
      } else {
        const io::YamlMap map(entry, {"name", "file", "estimator"});
        sensor.name = Name(map.At("name"));
        sensor.file = ExistingFile(map.At("file"));
        if (map.Has("estimator")) {
          sensor.estimator = estimators[map.At("estimator").OneOf(estimators)];
        }
      }
      if (sensor.estimator.empty()) {
        const bool known = std::count(estimators.begin(), estimators.end(), sensor.name) > 0;
        sensor.estimator = known ? sensor.name : kDefaultSensor;
      }
      RefuseTwice(entry, seen, sensor.name);
      seen.insert(sensor.name);
      sensors.push_back(sensor);
    }
    return sensors;
  }

  std::vector<SuiteChoice> Configs(const io::YamlValue& value) const {
    std::vector<SuiteChoice> configs;
    std::set<std::string> seen;
    for (const io::YamlValue& entry : Entries(value)) {
      SuiteChoice config;
      if (entry.IsScalar()) {
        entry.OneOf({kDefaultConfig});
        config.name = kDefaultConfig;
      } else {
        const io::YamlMap map(entry, {"name", "file"});
        config.name = Name(map.At("name"));
        config.file = ExistingFile(map.At("file"));
      }
      RefuseTwice(entry, seen, config.name);
      seen.insert(config.name);
      configs.push_back(config);
    }
    return configs;
  }

  static void ReadGate(const io::YamlValue& value, SuiteFile& suite) {
    const io::YamlMap map(value, {"alpha", "times", "undecided", "variants", "worst"});
    if (map.Has("alpha")) suite.gate.alpha = map.At("alpha").Number(io::Interval("(0, 0.5)"));
    if (map.Has("times")) suite.gate.times = map.At("times").Flag();
    if (map.Has("undecided")) {
      suite.gate.undecided_passes = map.At("undecided").OneOf({"fails", "passes"}) == 1;
    }
    if (map.Has("variants")) suite.gated_variants = Words(map.At("variants"), suite.variants);
    if (!map.Has("worst")) return;
    std::vector<std::string> pointers;
    for (const eval::GatedMetric& metric : eval::GatedMetrics()) {
      if (metric.kind != eval::MetricKind::kTime) pointers.emplace_back(metric.figure);
    }
    const io::YamlMap worst(map.At("worst"), pointers);
    for (const std::string& pointer : pointers) {
      if (!worst.Has(pointer)) continue;
      suite.gate.worst[pointer] = worst.At(pointer).Number(io::Interval("[0, 1e9]"));
    }
  }

  fs::path file_;
  io::YamlValue root_;
};

}  // namespace

SuiteFile ReadSuite(const fs::path& file) { return SuiteReader(file).Read(); }

}  // namespace app
