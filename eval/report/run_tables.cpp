#include "eval/report/run_tables.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "io/number_text.h"

namespace eval {
namespace {

using OrderedJson = nlohmann::ordered_json;

template <typename Value>
OrderedJson OrNull(const std::optional<Value>& value) {
  return value ? OrderedJson(*value) : OrderedJson(nullptr);
}

OrderedJson JsonOf(const RunEvent& e) {
  return {{"kind", NameOf(e.kind)},
          {"frame", e.frame},
          {"time_s", e.stamp_s},
          {"frames", e.frames},
          {"truth", OrNull(e.truth)},
          {"other_truth", OrNull(e.other_truth)},
          {"map_plane", OrNull(e.map_plane)},
          {"right_map_plane", OrNull(e.right_map_plane)},
          {"cue", e.cue.empty() ? OrderedJson(nullptr) : OrderedJson(e.cue)},
          {"pixels", OrNull(e.pixels)},
          {"distance_mm", OrNull(e.distance_mm)},
          {"harm_px_mm", OrNull(e.harm_px_mm)}};
}

/// A cell of a table between commas. Cues of other systems may hold anything.
std::string Cell(const OrderedJson& value) {
  if (value.is_null()) return "";
  if (value.is_number_float()) return io::NumberText(value.get<double>());
  if (!value.is_string()) return value.dump();
  auto text = value.get<std::string>();
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

std::string Line(const std::vector<OrderedJson>& values) {
  std::string line;
  for (const OrderedJson& value : values) line += Cell(value) + ",";
  line.back() = '\n';
  return line;
}

/// Decisions of one frame by their outcome.
using Outcomes = std::array<int, 6>;

std::map<int, Outcomes> OutcomesByFrame(const DecisionHistory& history) {
  const std::vector<JudgedDecision> judged = JudgeDecisions(RecordsOf(history.decisions));
  std::map<int, Outcomes> outcomes;
  for (std::size_t i = 0; i < judged.size(); ++i) {
    const auto which = static_cast<std::size_t>(judged[i].outcome);
    ++outcomes[history.decisions[i].record.frame][which];
  }
  return outcomes;
}

/// What the rows of the frames are made of.
class FrameTable {
 public:
  FrameTable(const Evaluation& evaluation, const Run& run, const Sequence& sequence)
      : evaluation_(evaluation), run_(run), stamps_s_(StampsOf(sequence.frames)) {
    for (const PoseError& error : evaluation.trajectory.errors) {
      const auto frame = NearestStamp(stamps_s_, error.stamp_s, kMaxStampDifference_s);
      if (!frame) continue;
      const auto off_s = [&](const PoseError& e) {
        return std::abs(e.stamp_s - stamps_s_[*frame]);
      };
      const auto there = errors_.try_emplace(*frame, error).first;
      if (off_s(error) < off_s(there->second)) there->second = error;  // the nearest counts
    }
    if (!evaluation.planes) return;
    for (const FrameScore& frame : evaluation.planes->by_frame) frames_[frame.frame] = &frame;
    outcomes_ = OutcomesByFrame(evaluation.planes->history);
    for (const SeenSurface& surface : evaluation.planes->undecided.undecided) {
      ++undecided_[surface.frame];
    }
    for (const AmbiguousPlane& plane : evaluation.planes->ambiguous) ++ambiguous_[plane.frame];
  }

  std::vector<OrderedJson> Row(std::size_t i) const {
    std::vector<OrderedJson> row = {i, stamps_s_[i],
                                    evaluation_.trajectory.tracked_frames[i] ? 1 : 0};
    const auto error = errors_.find(i);
    const bool known = error != errors_.end();
    row.push_back(known && error->second.position_m
                      ? OrderedJson(*error->second.position_m * 1e3)
                      : OrderedJson(nullptr));
    row.push_back(known ? OrNull(error->second.rotation_deg) : OrderedJson(nullptr));
    AddPlanes(static_cast<int>(i), row);
    row.push_back(OrNull(TimeOf(stamps_s_[i])));
    return row;
  }

 private:
  void AddPlanes(int frame, std::vector<OrderedJson>& row) const {
    constexpr std::size_t kPlaneColumns = 14;
    const auto score = frames_.find(frame);
    if (score == frames_.end()) {
      row.resize(row.size() + kPlaneColumns);
      return;
    }
    const auto& regions = score->second->regions;
    row.emplace_back(score->second->true_planes);
    for (int HooverScore::*count :
         {&HooverScore::machine, &HooverScore::correct, &HooverScore::over, &HooverScore::under,
          &HooverScore::missed, &HooverScore::noise}) {
      row.push_back(regions ? OrderedJson((*regions).*count) : OrderedJson(nullptr));
    }
    if (!evaluation_.planes->from_frame_planes) {
      row.resize(row.size() + kPlaneColumns - 7);
      return;
    }
    const auto outcomes = outcomes_.find(frame);
    const Outcomes counts = outcomes == outcomes_.end() ? Outcomes{} : outcomes->second;
    for (const DecisionOutcome outcome : {DecisionOutcome::kRight, DecisionOutcome::kWrong,
                                          DecisionOutcome::kMissed, DecisionOutcome::kFirst}) {
      row.emplace_back(counts[static_cast<std::size_t>(outcome)]);
    }
    row.emplace_back(counts[static_cast<std::size_t>(DecisionOutcome::kSpurious)] +
                     counts[static_cast<std::size_t>(DecisionOutcome::kNoiseAgain)]);
    row.emplace_back(CountIn(undecided_, frame));
    row.push_back(evaluation_.planes->history.says_by ? OrderedJson(CountIn(ambiguous_, frame))
                                                      : OrderedJson(nullptr));
  }

  static int CountIn(const std::map<int, int>& counts, int frame) {
    const auto count = counts.find(frame);
    return count == counts.end() ? 0 : count->second;
  }

  std::optional<double> TimeOf(double stamp_s) const {
    if (!run_.timing) return std::nullopt;
    const auto& modules = run_.timing->modules;
    const auto mt = std::find(modules.begin(), modules.end(), "mt");
    const auto row = FindStamp(run_.timing->stamps_s, stamp_s);
    if (mt == modules.end() || !row) return std::nullopt;
    const double time_ms = run_.timing->rows_ms[*row][std::size_t(mt - modules.begin())];
    return std::isfinite(time_ms) ? std::optional(time_ms) : std::nullopt;
  }

  const Evaluation& evaluation_;
  const Run& run_;
  std::vector<double> stamps_s_;
  std::map<std::size_t, PoseError> errors_;
  std::map<int, const FrameScore*> frames_;
  std::map<int, Outcomes> outcomes_;
  std::map<int, int> undecided_, ambiguous_;
};

std::vector<RunEvent> LostEvents(const TrajectoryScore& trajectory, const Sequence& sequence) {
  std::vector<RunEvent> events;
  bool was_tracked = false;
  for (std::size_t i = 0; i < trajectory.tracked_frames.size(); ++i) {
    const bool tracked = trajectory.tracked_frames[i];
    if (was_tracked && !tracked) {
      RunEvent event;
      event.kind = EventKind::kLost;
      event.frame = static_cast<int>(i);
      event.stamp_s = sequence.frames[i].stamp_s;
      event.frames = 0;
      events.push_back(event);
    }
    if (!tracked && !events.empty()) ++events.back().frames;
    was_tracked = tracked;
  }
  return events;
}

}  // namespace

std::vector<RunEvent> EventsOf(const Evaluation& evaluation, const Sequence& sequence,
                               const std::vector<RunEvent>& of_surfaces) {
  std::vector<RunEvent> events = LostEvents(evaluation.trajectory, sequence);
  if (evaluation.planes) {
    events.insert(events.end(), evaluation.planes->events.begin(),
                  evaluation.planes->events.end());
  }
  events.insert(events.end(), of_surfaces.begin(), of_surfaces.end());
  SortByHarm(events);
  return events;
}

std::string EventsCsv(const std::vector<RunEvent>& events) {
  const OrderedJson keys = JsonOf({});
  std::vector<OrderedJson> cells;
  for (const auto& [key, value] : keys.items()) cells.emplace_back(key);
  std::string text = Line(cells);
  for (const RunEvent& event : events) {
    const OrderedJson values = JsonOf(event);
    cells.clear();
    for (const OrderedJson& value : values) cells.push_back(value);
    text += Line(cells);
  }
  return text;
}

std::string EventsJsonLines(const std::vector<RunEvent>& events) {
  std::string text;
  for (const RunEvent& event : events) text += JsonOf(event).dump() + "\n";
  return text;
}

std::string FramesCsv(const Evaluation& evaluation, const Run& run, const Sequence& sequence) {
  const FrameTable table(evaluation, run, sequence);
  std::string text =
      "frame,time_s,tracked,position_error_mm,rotation_error_deg,true_planes,planes,correct,"
      "over,under,missed_planes,noise,right,wrong,missed,first,spurious,no_decision,ambiguous,"
      "mt_ms\n";
  for (std::size_t i = 0; i < sequence.frames.size(); ++i) text += Line(table.Row(i));
  return text;
}

}  // namespace eval
