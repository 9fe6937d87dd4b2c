#pragma once

#include <gtest/gtest.h>
#include <cmath>
#include <filesystem>
#include <set>
#include <stdexcept>
#include <string>

#include "eval/formats/run/run.h"
#include "eval/formats/sequence/sequence.h"
#include "eval/report/evaluate.h"
#include "eval/report/metrics_json.h"
#include "tests/eval/tiny_world.h"
#include "tests/support/temporary_folder.h"

namespace eval {

// Positions below 2 m through a dozen rigid motions and one alignment, in metres and degrees;
// millimetres are a thousand times that. Seventeen digits of text lose nothing.
inline constexpr double kExact = 1e-9;
inline constexpr double kExact_mm = 1e-6;

/// A sequence of the tiny world on disk and runs of it, scored.
class EvaluateTinyWorld : public ::testing::Test {
 protected:
  using Keys = std::set<std::string>;
  using TinyRun = testing::TinyRun;
  using TinyWorld = testing::TinyWorld;

  static void SetUpTestSuite() {
    world_ = new TinyWorld;
    folder_ = new test_support::TemporaryFolder;
    world_->WriteSequence(*folder_ / "SEQ");
  }
  static void TearDownTestSuite() {
    delete folder_;
    delete world_;
  }

  static std::filesystem::path SequenceFolder() { return *folder_ / "SEQ"; }
  static std::filesystem::path RunFolder() { return *folder_ / "RUN"; }

  static Evaluation EvaluationOf(const TinyRun& tiny) {
    tiny.Write(RunFolder());
    const eval::Run run = ReadRun(RunFolder());
    return Evaluate(run, ReadSequence(SequenceOf(run)));
  }
  static nlohmann::json Metrics(const TinyRun& tiny) {
    return nlohmann::json::parse(MetricsText(EvaluationOf(tiny)));
  }

  /// Groups and keys of metrics.json whose figures differ from those of the perfect run, at the
  /// depth of "group/key".
  static std::set<std::string> Moved(const nlohmann::json& before,
                                     const nlohmann::json& after) {
    std::set<std::string> moved;
    for (const auto* one : {&before, &after}) {
      for (const auto& [group, keys] : one->items()) {
        if (group == "rules" || group == "format" || group == "reasons") continue;
        if (group == "warnings") continue;
        for (const auto& [key, value] : keys.items()) {
          const auto path = nlohmann::json::json_pointer("/" + group + "/" + key);
          if (!Same(before.contains(path) ? before[path] : nlohmann::json(),
                    after.contains(path) ? after[path] : nlohmann::json())) {
            moved.insert(group + "/" + key);
          }
        }
      }
    }
    return moved;
  }

  static bool Same(const nlohmann::json& a, const nlohmann::json& b) {
    if (a.is_number() && b.is_number()) {
      return std::abs(a.get<double>() - b.get<double>()) < kExact_mm;
    }
    if (!a.is_object() || !b.is_object()) return a == b;
    if (a.size() != b.size()) return false;
    for (const auto& [key, value] : a.items()) {
      if (!b.contains(key) || !Same(value, b[key])) return false;
    }
    return true;
  }

  static nlohmann::json* FramePlane(TinyRun& run, std::size_t frame, int truth) {
    for (auto& plane : run.frames[frame]["planes"]) {
      if (plane["map_plane"] == TinyRun::MapId(truth)) return &plane;
    }
    return nullptr;
  }
  static nlohmann::json& MapPlane(TinyRun& run, int truth) {
    for (auto& plane : run.map["planes"]) {
      if (plane["id"] == TinyRun::MapId(truth)) return plane;
    }
    throw std::logic_error("no such map plane");
  }

  inline static TinyWorld* world_ = nullptr;
  inline static test_support::TemporaryFolder* folder_ = nullptr;
};

}  // namespace eval
