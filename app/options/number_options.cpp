#include "app/options/number_options.h"

#include <cstdint>

#include "io/input_error.h"
#include "io/number_text.h"

namespace app {
namespace {

/// Puts the number's plain decimal form in the place of its text. @returns what is wrong
template <typename Whole>
std::string ToDecimal(std::string& text, const char* expected) {
  const auto number = io::ParseWhole<Whole>(text.starts_with('+') ? text.substr(1) : text);
  if (!number) return std::string("expected ") + expected + ", found " + io::Quoted(text);
  text = std::to_string(*number);
  return "";
}

std::string CheckFinite(std::string& text) {
  if (io::ParseNumber(text)) return "";
  return "expected a finite number, found " + io::Quoted(text);
}

void CheckValue(CLI::Option& option) {
  if (option.get_items_expected_max() == 0) return;  // a flag
  const auto add = [&](const std::function<std::string(std::string&)>& check) {
    option.transform(CLI::Validator(check, ""));
  };
  const std::string type = option.get_type_name();
  if (type.starts_with("FLOAT")) {
    add(CheckFinite);
  } else if (type.starts_with("UINT")) {
    add([](std::string& text) {
      return ToDecimal<std::uint64_t>(text, "a whole number of 0 or more, less than 2^64");
    });
  } else if (type.starts_with("INT")) {
    add([](std::string& text) { return ToDecimal<std::int64_t>(text, "a whole number"); });
  } else {
    add([](std::string& text) { return text.empty() ? "expected a text, found none" : ""; });
  }
}

}  // namespace

void CheckValues(CLI::App& app) {
  for (CLI::Option* option : app.get_options()) CheckValue(*option);
  for (CLI::App* command : app.get_subcommands([](CLI::App*) { return true; })) {
    CheckValues(*command);
  }
}

}  // namespace app
