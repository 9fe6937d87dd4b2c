#include "eval/check/check_timing.h"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "eval/check/checked_text.h"
#include "io/number_text.h"

namespace eval {
namespace {

const std::string kFile = "timing.csv";

std::vector<std::string> Cells(const std::string& text) {
  std::vector<std::string> cells;
  std::istringstream in(text);
  for (std::string cell; std::getline(in, cell, ',');) {
    const auto first = cell.find_first_not_of(" \t\r\"");
    const auto last = cell.find_last_not_of(" \t\r\"");
    cells.push_back(first == std::string::npos ? "" : cell.substr(first, last - first + 1));
  }
  if (!text.empty() && text.back() == ',') cells.push_back("");
  return cells;
}

void CheckHeader(FolderCheck& check, const CheckedLine& line,
                 const std::vector<std::string>& columns) {
  for (const char* name :
       {"timestamp", "orb", "od", "mdc", "epi", "pp", "da", "po", "upm", "mt"}) {
    if (std::count(columns.begin(), columns.end(), name) == 1) continue;
    check.Add(kFile, line.number, fmt::format("has not exactly one column `{}`", name),
              "write the header timestamp,orb,od,mdc,epi,pp,da,po,upm,mt");
  }
}

void CheckRow(FolderCheck& check, const CheckedLine& line,
              const std::vector<std::string>& columns, StampOrder& order) {
  const std::vector<std::string> cells = Cells(line.text);
  if (cells.size() != columns.size()) {
    check.Add(kFile, line.number,
              fmt::format("has {} cells; expected {}", cells.size(), columns.size()),
              "write one cell a column");
    return;
  }
  for (std::size_t i = 0; i < cells.size(); ++i) {
    // A module that did not run has an empty cell.
    if (cells[i].empty() && columns[i] != "timestamp") continue;
    const auto value = io::ParseNumber(cells[i]);
    if (!value || (columns[i] != "timestamp" && *value < 0)) {
      check.Add(kFile, line.number, fmt::format("{} is `{}`", columns[i], cells[i]),
                "write milliseconds, a finite number of at least 0");
    } else if (columns[i] == "timestamp") {
      order.Next(*value, line.number);
    }
  }
}

}  // namespace

void CheckTiming(FolderCheck& check) {
  if (!check.Require(kFile, "run the SLAM system again")) return;
  const std::vector<CheckedLine> lines = RecordsToCheck(check, kFile);
  if (lines.empty()) {
    check.Add(kFile, 0, "is empty", "write the header and a row for each frame");
    return;
  }
  const std::vector<std::string> columns = Cells(lines[0].text);
  CheckHeader(check, lines[0], columns);
  StampOrder order(check, kFile);
  for (std::size_t i = 1; i < lines.size(); ++i) CheckRow(check, lines[i], columns, order);
  order.Finish();
}

}  // namespace eval
