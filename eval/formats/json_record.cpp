#include "eval/formats/json_record.h"

#include <fmt/format.h>

#include <cmath>

#include "eval/formats/pose/pose.h"
#include "io/json_field.h"
#include "io/text_lines.h"

namespace eval {
namespace {

using nlohmann::json;

constexpr const char* kSeeFormat = "write it as the format says";

bool IsFinite(const json& value) {
  return value.is_number() && std::isfinite(value.get<double>());
}

void VisitObject(const JsonRecord& root, const std::function<void(const JsonRecord&)>& visit) {
  if (root.value().is_object()) {
    visit(root);
  } else {
    root.Tell("is not an object", kSeeFormat);
  }
}

}  // namespace

JsonRecord::JsonRecord(Folder& folder, std::string file, int line, const json& value,
                       std::string pointer)
    : folder_(&folder),
      file_(std::move(file)),
      line_(line),
      value_(&value),
      pointer_(std::move(pointer)) {}

JsonRecord JsonRecord::WithNeed(Need need) const {
  JsonRecord record = *this;
  record.need_ = need;
  return record;
}

JsonRecord JsonRecord::Extra() const {
  JsonRecord record = WithNeed(Need::kOptional);
  record.wrong_ = Severity::kWarning;
  return record;
}

JsonRecord JsonRecord::Inner(const json& value, const std::string& key) const {
  JsonRecord inner(*folder_, file_, line_, value, pointer_ + "/" + key);
  inner.wrong_ = wrong_;
  return inner;
}

void JsonRecord::Tell(std::string what, std::string mend, Severity severity) const {
  folder_->Tell({file_, line_, pointer_, std::move(what), std::move(mend)}, severity);
}

void JsonRecord::TellAt(const std::string& key, std::string what, std::string mend,
                        Severity severity) const {
  folder_->Tell({file_, line_, pointer_ + "/" + key, std::move(what), std::move(mend)},
                severity);
}

void JsonRecord::TellExpected(const std::string& expected) const {
  constexpr std::size_t kMaxShown = 60;  // characters
  const std::string found = value_->dump(-1, ' ', false, json::error_handler_t::replace);
  Tell(fmt::format("is {}; expected {}", found.substr(0, kMaxShown), expected), kSeeFormat,
       wrong_);
}

bool JsonRecord::Contains(const std::string& key) const {
  return value_->is_object() && value_->contains(key);
}

bool JsonRecord::Has(const std::string& key) const {
  return Contains(key) && !value_->at(key).is_null();
}

std::optional<JsonRecord> JsonRecord::Find(const std::string& key, const char* expected) const {
  if (!value_->is_object()) {
    Tell("is not an object", kSeeFormat, wrong_);
    return std::nullopt;
  }
  if (need_ == Need::kRequired ? Contains(key) : Has(key)) {
    return Inner(value_->at(key), key);
  }
  if (need_ == Need::kOptional) return std::nullopt;
  TellAt(key, fmt::format("is missing; expected {}", expected), kSeeFormat,
         need_ == Need::kRequired ? wrong_ : Severity::kFlaw);
  return std::nullopt;
}

std::optional<double> JsonRecord::Number(const std::string& key) const {
  const auto found = Find(key, "a number");
  if (!found) return std::nullopt;
  if (IsFinite(*found->value_)) return found->value_->get<double>();
  found->TellExpected("a finite number");
  return std::nullopt;
}

std::optional<double> JsonRecord::Number(const std::string& key,
                                         const io::Interval& domain) const {
  const auto number = Number(key);
  if (!number || domain.Contains(*number)) return number;
  TellAt(key, fmt::format("is {}; expected a number in {}", *number, domain.text()), kSeeFormat,
         wrong_);
  return std::nullopt;
}

std::optional<double> JsonRecord::Whole(const std::string& key) const {
  const auto found = Find(key, "a whole number");
  if (!found) return std::nullopt;
  const double number = IsFinite(*found->value_) ? found->value_->get<double>() : 0.5;
  if (number == std::floor(number)) return number;
  found->TellExpected("a whole number");
  return std::nullopt;
}

std::optional<int> JsonRecord::Integer(const std::string& key, int min, int max) const {
  const auto number = Whole(key);
  if (!number) return std::nullopt;
  if (*number >= min && *number <= max) return static_cast<int>(*number);
  const bool open = max == std::numeric_limits<int>::max() && *number < min;
  TellAt(key,
         fmt::format(
             "is {}; expected a whole number {}", *number,
             open ? fmt::format("of {} or more", min) : fmt::format("from {} to {}", min, max)),
         kSeeFormat, wrong_);
  return std::nullopt;
}

std::optional<std::string> JsonRecord::Text(const std::string& key) const {
  const auto found = Find(key, "a text");
  if (!found) return std::nullopt;
  if (!found->value_->is_string()) {
    found->TellExpected("a text");
    return std::nullopt;
  }
  const std::string text = found->value_->get<std::string>();
  if (text.empty()) found->Tell("is an empty text", kSeeFormat, Severity::kFlaw);
  return text;
}

std::optional<bool> JsonRecord::Flag(const std::string& key) const {
  const auto found = Find(key, "true or false");
  if (!found) return std::nullopt;
  if (found->value_->is_boolean()) return found->value_->get<bool>();
  found->TellExpected("true or false");
  return std::nullopt;
}

void JsonRecord::Format(const std::string& expected) const {
  const auto format = Text("format");
  if (!format || *format == expected) return;
  TellAt("format", "is " + *format + "; expected " + expected,
         "convert the file to this version of the format");
}

std::optional<std::vector<double>> JsonRecord::AsNumbers(std::size_t count) const {
  std::vector<double> numbers;
  bool good = value_->is_array() && value_->size() == count;
  for (std::size_t i = 0; good && i < count; ++i) {
    good = IsFinite((*value_)[i]);
    if (good) numbers.push_back((*value_)[i].get<double>());
  }
  if (good) return numbers;
  TellExpected(fmt::format("{} finite numbers", count));
  return std::nullopt;
}

std::optional<std::vector<double>> JsonRecord::Numbers(const std::string& key,
                                                       std::size_t count) const {
  const auto found = Find(key, "a list of numbers");
  return found ? found->AsNumbers(count) : std::nullopt;
}

std::optional<Eigen::Vector3d> JsonRecord::AsVector3() const {
  const auto xyz = AsNumbers(3);
  if (!xyz) return std::nullopt;
  const Eigen::Vector3d v((*xyz)[0], (*xyz)[1], (*xyz)[2]);
  if (v.cwiseAbs().maxCoeff() <= kMaxCoordinate_m) return v;
  TellExpected(fmt::format("coordinates of at most {:g} m", kMaxCoordinate_m));
  return std::nullopt;
}

std::optional<Eigen::Vector3d> JsonRecord::Vector3(const std::string& key) const {
  const auto found = Find(key, "3 numbers [x, y, z]");
  return found ? found->AsVector3() : std::nullopt;
}

std::vector<Eigen::Vector3d> JsonRecord::AsPoints() const {
  std::vector<Eigen::Vector3d> points;
  bool good = true;
  for (const JsonRecord& item : AsItems()) {
    const auto point = item.AsVector3();
    good = good && point.has_value();
    if (good) points.push_back(*point);
  }
  return good ? points : std::vector<Eigen::Vector3d>{};
}

std::vector<Eigen::Vector3d> JsonRecord::Points(const std::string& key) const {
  const auto found = Find(key, "a list of points");
  return found ? found->AsPoints() : std::vector<Eigen::Vector3d>{};
}

std::vector<JsonRecord> JsonRecord::AsItems() const {
  std::vector<JsonRecord> items;
  if (!value_->is_array()) {
    Tell("is not a list", kSeeFormat, wrong_);
    return items;
  }
  for (std::size_t i = 0; i < value_->size(); ++i) {
    items.push_back(Inner((*value_)[i], std::to_string(i)));
  }
  return items;
}

std::optional<JsonRecord> JsonRecord::Object(const std::string& key) const {
  const auto found = Find(key, "an object");
  if (!found || found->value_->is_object()) return found;
  found->TellExpected("an object");
  return std::nullopt;
}

std::vector<JsonRecord> JsonRecord::Items(const std::string& key) const {
  const auto found = Find(key, "a list");
  return found ? found->AsItems() : std::vector<JsonRecord>{};
}

void VisitJson(Folder& folder, const std::string& file,
               const std::function<void(const JsonRecord&)>& visit) {
  json document;
  if (!folder.Try(file, [&] { document = io::ReadJson(folder.Open(file)); })) return;
  VisitObject({folder, file, 0, document}, visit);
}

void VisitJsonLines(Folder& folder, const std::string& file,
                    const std::function<void(const JsonRecord&)>& visit) {
  const std::filesystem::path path = folder.Open(file);
  std::optional<io::TextLines> lines;
  if (!folder.Try(file, [&] { lines.emplace(path, "", io::kMaxJsonLine_bytes); })) return;
  std::string text;
  bool more = true;
  int blank = 0;  // the first line of blanks that a record may follow
  const auto next = [&] { more = lines->Next(text); };
  while (folder.Try(file, next) && more) {
    const int line = lines->number();
    if (text.find_first_not_of(" \t\r") == std::string::npos) {
      if (blank == 0) blank = line;
      continue;
    }
    if (blank != 0) {
      folder.Tell(file, std::exchange(blank, 0), "is blank", "write one JSON object a line",
                  Severity::kFlaw);
    }
    json document;
    if (!folder.Try(file, [&] { document = io::ParseJson(text, path, line); })) continue;
    VisitObject({folder, file, line, document}, visit);
  }
}

}  // namespace eval
