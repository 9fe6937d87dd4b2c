#include "slam/run/config_file.h"

#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "io/input_error.h"
#include "io/number_text.h"
#include "io/read_file.h"
#include "io/yaml_value.h"
#include "slam/base/field_visitor.h"

namespace slam {
namespace {

/// Takes from a YAML file what it names.
class Reader : public FieldVisitor {
 public:
  explicit Reader(const io::YamlValue& file) : sections_{{io::YamlMap(file), {}}} {}

  void Section(const char* key, const char*, const std::function<void()>& body) override {
    sections_.back().keys.push_back(key);
    sections_.push_back({io::YamlMap(sections_.back().map.At(key)), {}});
    body();
    Finish();
  }
  void Number(const char* key, double& value, const char* domain, const char*) override {
    if (const auto found = Find(key)) value = found->Number(io::Interval(domain));
  }
  void Integer(const char* key, int& value, const char* domain, const char*) override {
    if (const auto found = Find(key)) value = found->Whole(io::Interval(domain));
  }
  void Flag(const char* key, bool& value, const char*) override {
    if (const auto found = Find(key)) value = found->Flag();
  }
  void Choice(const char* key, int& value, const std::vector<std::string>& names,
              const char*) override {
    if (const auto found = Find(key)) value = static_cast<int>(found->OneOf(names));
  }
  void Text(const char* key, std::string& value, const char*) override {
    if (const auto found = Find(key)) value = found->Text();
  }
  void Texts(const char* key, std::vector<std::string>& value, const char*) override {
    const auto found = Find(key);
    if (!found) return;
    value.clear();
    for (const io::YamlValue& text : found->List()) value.push_back(text.Text());
  }

  /// Ends the innermost section: a key in it that no field has is an error.
  void Finish() {
    sections_.back().map.RefuseOtherKeys(sections_.back().keys);
    sections_.pop_back();
  }

 private:
  struct OpenSection {
    io::YamlMap map;
    std::vector<std::string> keys;  ///< those of the fields visited so far
  };

  std::optional<io::YamlValue> Find(const char* key) {
    OpenSection& section = sections_.back();
    section.keys.push_back(key);
    return section.map.Has(key) ? std::optional(section.map.At(key)) : std::nullopt;
  }

  std::vector<OpenSection> sections_;
};

/// Writes all fields as nested objects.
class JsonWriter : public FieldVisitor {
 public:
  explicit JsonWriter(nlohmann::ordered_json& top) : objects_{&top} {}

  void Section(const char* key, const char*, const std::function<void()>& body) override {
    nlohmann::ordered_json section = nlohmann::ordered_json::object();
    objects_.push_back(&section);
    body();
    objects_.pop_back();
    (*objects_.back())[key] = std::move(section);
  }
  void Number(const char* key, double& value, const char*, const char*) override {
    (*objects_.back())[key] = value;
  }
  void Integer(const char* key, int& value, const char*, const char*) override {
    (*objects_.back())[key] = value;
  }
  void Flag(const char* key, bool& value, const char*) override {
    (*objects_.back())[key] = value;
  }
  void Choice(const char* key, int& value, const std::vector<std::string>& names,
              const char*) override {
    (*objects_.back())[key] = names.at(static_cast<std::size_t>(value));
  }
  void Text(const char* key, std::string& value, const char*) override {
    (*objects_.back())[key] = value;
  }
  void Texts(const char* key, std::vector<std::string>& value, const char*) override {
    (*objects_.back())[key] = value;
  }

 private:
  std::vector<nlohmann::ordered_json*> objects_;
};

/// Each field's value as a file gives it, in the order of the visit.
class ValueTexts : public FieldVisitor {
 public:
  std::vector<std::string> texts;

  void Section(const char*, const char*, const std::function<void()>& body) override { body(); }
  void Number(const char*, double& value, const char*, const char*) override {
    texts.push_back(io::NumberText(value));
  }
  void Integer(const char*, int& value, const char*, const char*) override {
    texts.push_back(std::to_string(value));
  }
  void Flag(const char*, bool& value, const char*) override {
    texts.push_back(value ? "true" : "false");
  }
  void Choice(const char*, int& value, const std::vector<std::string>& names,
              const char*) override {
    texts.push_back(names.at(static_cast<std::size_t>(value)));
  }
  void Text(const char*, std::string& value, const char*) override {
    texts.push_back(Quoted(value));
  }
  void Texts(const char*, std::vector<std::string>& value, const char*) override {
    std::string list;
    for (const std::string& item : value) list += (list.empty() ? "" : ", ") + Quoted(item);
    texts.push_back("[" + list + "]");
  }

 private:
  /// JSON's quoting is YAML's as well.
  static std::string Quoted(const std::string& item) {
    return nlohmann::json(item).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  }
};

std::vector<std::string> TextsOf(Config config) {
  ValueTexts visitor;
  VisitFields(config, visitor);
  return std::move(visitor.texts);
}

/// The unit that a key ends in; "no unit" for a ratio, a probability, a number of bits ...
std::string UnitOf(std::string_view key) {
  static constexpr std::pair<const char*, const char*> kUnits[] = {
      {"_deg_per_m", "degrees per m"},
      {"_per_m", "per m"},
      {"_px_m", "px m"},
      {"_px_s2", "px/s^2"},
      {"_m2", "m^2"},
      {"_m", "m"},
      {"_px", "px"},
      {"_pixels", "px"},
      {"_deg", "degrees"},
      {"_rad", "radians"},
      {"_sigmas", "standard deviations"},
      {"_deg_per_s", "degrees/s"},
      {"_s", "s"},
      {"_mps", "m/s"}};
  for (const auto& [suffix, unit] : kUnits) {
    if (key.ends_with(suffix)) return unit;
  }
  return "no unit";
}

constexpr const char* kAboutSettings =
    "# The settings of pas slam, as `pas config` prints them: each with its unit, domain and\n"
    "# default, and what it means. A file for --config needs only the keys that it changes.\n";

/// Writes all fields as a file that Reader takes, with meaning, unit, domain and default as
/// comments.
class YamlWriter : public FieldVisitor {
 public:
  /// Both in the order of the visit.
  YamlWriter(std::vector<std::string> values, std::vector<std::string> defaults)
      : values_(std::move(values)), defaults_(std::move(defaults)) {}

  std::string text = kAboutSettings;

  void Section(const char* key, const char* help, const std::function<void()>& body) override {
    text += indent_ + key + ":  # " + help + "\n";
    indent_ += "  ";
    body();
    indent_.resize(indent_.size() - 2);
  }
  void Number(const char* key, double&, const char* domain, const char* help) override {
    Line(key, help, UnitOf(key) + " in " + domain);
  }
  void Integer(const char* key, int&, const char* domain, const char* help) override {
    const std::string unit = UnitOf(key);
    Line(key, help, (unit == "no unit" ? "whole number" : "whole " + unit) + " in " + domain);
  }
  void Flag(const char* key, bool&, const char* help) override {
    Line(key, help, "true or false");
  }
  void Choice(const char* key, int&, const std::vector<std::string>& names,
              const char* help) override {
    std::string domain;
    for (const std::string& name : names) domain += (domain.empty() ? "" : " | ") + name;
    Line(key, help, domain);
  }
  void Text(const char* key, std::string&, const char* help) override {
    Line(key, help, "text");
  }
  void Texts(const char* key, std::vector<std::string>&, const char* help) override {
    Line(key, help, "texts");
  }

 private:
  void Line(const std::string& key, const std::string& help, const std::string& domain) {
    const std::string& value = values_.at(next_);
    const std::string& normal = defaults_.at(next_++);
    const bool list = normal.starts_with('[');  // too long to be said twice
    const std::string told = !list ? normal : value == normal ? "as here" : "another list";
    text += indent_ + key + ": " + value + "  # " + domain + ", default " + told + ": " + help +
            "\n";
  }

  std::vector<std::string> values_, defaults_;
  std::size_t next_ = 0;
  std::string indent_;
};

/// What no single domain can say.
void CheckTogether(const Config& c, const std::string& file) {
  const auto require = [&](bool holds, const char* what) {
    if (!holds) throw io::InputError(file, what);
  };
  require(c.point_features.min_fast_threshold <= c.point_features.fast_threshold,
          "point_features: min_fast_threshold must not be above fast_threshold");
  require(c.point_features.depth.min_depth_m < c.point_features.depth.max_depth_m,
          "point_depth: min_depth_m must be below max_depth_m");
  require(!c.yolox.classes.empty(), "yolox: classes must name at least one class");
  require(c.plane_processing.vertices.min_fill <= c.plane_processing.vertices.max_fill,
          "plane_processing: vertices: min_fill must not be above max_fill");
  require(c.association.max_chi2 <= c.association.new_chi2,
          "association: max_chi2 must not be above new_chi2");
  for (const std::string& name : c.classes.regular)
    require(c.classes.KindOf(name) == ClassKind::kRegular &&
                ClassTable{{}, c.classes.unstructured, {}}.KindOf(name) == ClassKind::kOther,
            "classes: a class is both regular and unstructured");
}

}  // namespace

Config ReadConfig(const std::filesystem::path& file, Config config) {
  const io::YamlValue settings = io::ReadYaml(file, "expected settings (pas config)");
  // As one whose writing failed; comments alone are all defaults.
  if (io::ReadFile(file).find_first_not_of(" \t\r\n") == std::string::npos) {
    settings.Fail("the file is empty; expected settings, such as `pas config` prints");
  }
  Reader reader(settings);
  VisitFields(config, reader);
  reader.Finish();
  CheckTogether(config, file.string());
  return config;
}

nlohmann::ordered_json ConfigAsJson(const Config& config) {
  Config copy = config;  // visitors may write
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  JsonWriter writer(json);
  VisitFields(copy, writer);
  return json;
}

std::string ConfigAsYaml(const Config& config) {
  Config copy = config;
  YamlWriter writer(TextsOf(config), TextsOf(ConfigFor(config.sensor.sensor)));
  VisitFields(copy, writer);
  return std::move(writer.text);
}

}  // namespace slam
