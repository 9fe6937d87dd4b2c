#include "eval/regression/baseline.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "io/json_field.h"

namespace eval {
namespace {

constexpr const char* kFormat = "pas-baseline/3";

GateCase CaseOf(const nlohmann::json& record, const std::string& where) {
  const io::JsonField field(record, where);
  GateCase one;
  one.done = field["done"].Boolean();
  one.inputs = field["inputs"].Text();
  for (const auto& [name, value] : record.at("figures").items()) {
    one.figures[name] =
        value.is_null() ? std::nullopt : std::optional(field["figures"][name].Number());
  }
  return one;
}

/// By how much each figure of an arm became worse, of one earlier baseline.
std::map<std::string, std::map<std::string, double>> HarmOf(const nlohmann::json& arms,
                                                            const io::JsonField& field) {
  std::map<std::string, std::map<std::string, double>> harm;
  if (!arms.is_object()) field.Fail("an object, a member an arm");
  for (const auto& [arm, figures] : arms.items()) {
    if (!figures.is_object()) field[arm].Fail("an object, a member a figure");
    for (const auto& [figure, step] : figures.items())
      harm[arm][figure] = field[arm][figure].Number();
  }
  return harm;
}

/// A file without a history is the first of its suite, or an earlier program's.
std::vector<PastBaseline> HistoryOf(const nlohmann::json& document, const io::JsonField& root) {
  std::vector<PastBaseline> history;
  const auto field = root.Find("history");
  if (!field) return history;
  const std::vector<io::JsonField> entries = field->Elements();
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const io::JsonField harm = entries[i]["harm"];
    history.push_back({entries[i]["program"].Text(), entries[i]["reason"].Text(),
                       HarmOf(document.at("history")[i].at("harm"), harm)});
  }
  return history;
}

std::string HistoryText(const std::vector<PastBaseline>& history) {
  std::string lines;
  for (const PastBaseline& past : history) {
    const nlohmann::json entry{
        {"program", past.program}, {"reason", past.reason}, {"harm", past.harm}};
    lines += (lines.empty() ? "\n  " : ",\n  ") + entry.dump();
  }
  return lines + (lines.empty() ? "" : "\n ");
}

}  // namespace

std::string ArmOfKey(const std::string& key) {
  const std::size_t slash = key.find('/');
  return slash == std::string::npos ? "" : key.substr(slash + 1);
}

Figures FiguresForGate(const Figures& all) {
  Figures gated;
  const auto keep = [&](const std::string& name) {
    const auto found = all.find(name);
    gated[name] = found == all.end() ? std::nullopt : found->second;
  };
  for (const GatedMetric& metric : GatedMetrics()) keep(metric.figure);
  keep(kFramesFigure);
  keep(kTrackedFigure);
  return gated;
}

Baseline ReadBaseline(const std::filesystem::path& file) {
  const nlohmann::json document =
      io::ReadJson(file, "write one with --accept \"REASON\", or name the right file");
  const io::JsonField root(document, file.string());
  if (root["format"].Text() != kFormat) {
    root["format"].Fail(std::string("a baseline of `pas suite`, ") + kFormat);
  }
  Baseline baseline{root["suite"].Text(),     root["plan"].Text(),   root["program"].Text(),
                    root["processor"].Text(), root["reason"].Text(), {},
                    HistoryOf(document, root)};
  const nlohmann::json& cases = document.value("cases", nlohmann::json());
  if (!cases.is_object()) root["cases"].Fail("an object, a member a case");
  for (const auto& [key, record] : cases.items()) {
    const std::string where = file.string() + ": cases: " + key;
    if (!record.is_object() || !record.value("figures", nlohmann::json()).is_object()) {
      io::JsonField(record, where).Fail("an object with done and figures");
    }
    baseline.cases[key] = CaseOf(record, where);
  }
  return baseline;
}

std::string BaselineText(const Baseline& baseline) {
  const auto quoted = [](const std::string& text) { return nlohmann::json(text).dump(); };
  std::string cases;
  for (const auto& [key, one] : baseline.cases) {
    nlohmann::json figures = nlohmann::json::object();
    for (const auto& [name, value] : one.figures) {
      figures[name] = value ? nlohmann::json(*value) : nlohmann::json();
    }
    const nlohmann::json record{
        {"done", one.done}, {"inputs", one.inputs}, {"figures", figures}};
    cases += fmt::format("{}\n  {}: {}", cases.empty() ? "" : ",", quoted(key), record.dump());
  }
  return fmt::format(
      "{{\n \"format\": {},\n \"suite\": {},\n \"plan\": {},\n \"program\": {},\n"
      " \"processor\": {},\n \"reason\": {},\n \"history\": [{}],\n \"cases\": {{{}\n }}\n}}\n",
      quoted(kFormat), quoted(baseline.suite), quoted(baseline.plan), quoted(baseline.program),
      quoted(baseline.processor), quoted(baseline.reason), HistoryText(baseline.history),
      cases);
}

}  // namespace eval
