#include "eval/check/checked_json.h"

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <iterator>

namespace eval {
namespace {

using nlohmann::json;

constexpr const char* kSeeFormat = "write it as the format says";

// What follows the library's "[json.exception...] " prefix.
std::string Message(const json::exception& error) {
  const std::string text = error.what();
  const auto end = text.find("] ");
  return end == std::string::npos ? text : text.substr(end + 2);
}

}  // namespace

CheckedJson::CheckedJson(FolderCheck& check, std::string file, int line, const json& value,
                         std::string pointer)
    : check_(&check),
      file_(std::move(file)),
      line_(line),
      value_(&value),
      pointer_(std::move(pointer)) {}

void CheckedJson::Report(std::string what, std::string mend) const {
  check_->faults.push_back({file_, line_, pointer_, std::move(what), std::move(mend)});
}

void CheckedJson::ReportAt(const std::string& key, std::string what, std::string mend) const {
  check_->faults.push_back(
      {file_, line_, pointer_ + "/" + key, std::move(what), std::move(mend)});
}

bool CheckedJson::Contains(const std::string& key) const {
  return value_->is_object() && value_->contains(key);
}

bool CheckedJson::Has(const std::string& key) const {
  return Contains(key) && !value_->at(key).is_null();
}

CheckedJson CheckedJson::Child(const std::string& key, const json& value) const {
  return CheckedJson(*check_, file_, line_, value, pointer_ + "/" + key);
}

const json* CheckedJson::Find(const std::string& key, const char* expected) const {
  if (!value_->is_object()) {
    Report("is not an object", kSeeFormat);
    return nullptr;
  }
  const auto found = value_->find(key);
  if (found != value_->end()) return &*found;
  ReportAt(key, fmt::format("is missing; expected {}", expected), kSeeFormat);
  return nullptr;
}

std::optional<double> CheckedJson::Number(const std::string& key) const {
  const json* found = Find(key, "a number");
  if (found == nullptr) return std::nullopt;
  if (found->is_number() && std::isfinite(found->get<double>())) return found->get<double>();
  ReportAt(key, fmt::format("is {}; expected a finite number", found->dump().substr(0, 40)),
           kSeeFormat);
  return std::nullopt;
}

std::optional<long> CheckedJson::Integer(const std::string& key) const {
  const json* found = Find(key, "a whole number");
  if (found == nullptr) return std::nullopt;
  if (found->is_number_integer()) return found->get<long>();
  ReportAt(key, fmt::format("is {}; expected a whole number", found->dump().substr(0, 40)),
           kSeeFormat);
  return std::nullopt;
}

std::optional<std::string> CheckedJson::Text(const std::string& key) const {
  const json* found = Find(key, "a text");
  if (found == nullptr) return std::nullopt;
  if (found->is_string() && !found->get_ref<const std::string&>().empty()) {
    return found->get<std::string>();
  }
  ReportAt(key, fmt::format("is {}; expected a text", found->dump().substr(0, 40)), kSeeFormat);
  return std::nullopt;
}

std::optional<bool> CheckedJson::Flag(const std::string& key) const {
  const json* found = Find(key, "true or false");
  if (found == nullptr) return std::nullopt;
  if (found->is_boolean()) return found->get<bool>();
  ReportAt(key, "is not true or false", kSeeFormat);
  return std::nullopt;
}

std::optional<std::vector<double>> CheckedJson::AsNumbers(std::size_t count) const {
  std::vector<double> numbers;
  bool good = value_->is_array() && value_->size() == count;
  for (std::size_t i = 0; good && i < count; ++i) {
    const json& item = (*value_)[i];
    good = item.is_number() && std::isfinite(item.get<double>());
    if (good) numbers.push_back(item.get<double>());
  }
  if (good) return numbers;
  Report(fmt::format("is {}; expected {} finite numbers", value_->dump().substr(0, 60), count),
         kSeeFormat);
  return std::nullopt;
}

std::optional<std::vector<double>> CheckedJson::Numbers(const std::string& key,
                                                        std::size_t count) const {
  const json* found = Find(key, "a list of numbers");
  if (found == nullptr) return std::nullopt;
  return Child(key, *found).AsNumbers(count);
}

std::vector<CheckedJson> CheckedJson::AsItems() const {
  std::vector<CheckedJson> items;
  if (!value_->is_array()) {
    Report("is not a list", kSeeFormat);
    return items;
  }
  for (std::size_t i = 0; i < value_->size(); ++i) {
    items.push_back(Child(std::to_string(i), (*value_)[i]));
  }
  return items;
}

std::vector<CheckedJson> CheckedJson::Items(const std::string& key) const {
  const json* found = Find(key, "a list");
  if (found == nullptr) return {};
  return Child(key, *found).AsItems();
}

void VisitJson(FolderCheck& check, const std::string& file,
               const std::function<void(const CheckedJson&)>& visit) {
  std::ifstream in(check.root / file, std::ios::binary);
  if (!in) {
    check.Add(file, 0, "cannot be read", "restore the file and its permissions");
    return;
  }
  check.files.insert(file);
  json document;
  try {
    document = json::parse(in);
  } catch (const json::exception& error) {
    check.Add(file, 0, "is not valid JSON: " + Message(error), "mend the syntax");
    return;
  }
  const CheckedJson root(check, file, 0, document);
  if (document.is_object()) {
    visit(root);
  } else {
    root.Report("is not an object", kSeeFormat);
  }
}

void VisitJsonLines(FolderCheck& check, const std::string& file,
                    const std::function<void(const CheckedJson&, int line)>& visit) {
  std::ifstream in(check.root / file, std::ios::binary);
  if (!in) {
    check.Add(file, 0, "cannot be read", "restore the file and its permissions");
    return;
  }
  check.files.insert(file);
  std::string text;
  for (int line = 1; std::getline(in, text); ++line) {
    json record;
    try {
      record = json::parse(text);
    } catch (const json::exception& error) {
      check.Add(file, line, "is not valid JSON: " + Message(error),
                "write one JSON object a line");
      continue;
    }
    const CheckedJson root(check, file, line, record);
    if (record.is_object()) {
      visit(root, line);
    } else {
      root.Report("is not an object", "write one JSON object a line");
    }
  }
}

}  // namespace eval
