#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>

namespace eval {

/// What a figure is, and so how a change of it is told as a harm.
enum class MetricKind {
  kError,  ///< smaller is better; harm is the logarithm of the ratio
  kScore,  ///< larger is better, in [0, 1]; harm is the plain difference
  kCount,  ///< smaller is better; as an error, with half a count added to both
  kTime,   ///< of a module over that of the plain pass of the same run; as an error
};

/// A figure that the gate compares.
struct GatedMetric {
  const char* figure;  ///< JSON pointer into metrics.json; of a time, see TimeRatios
  MetricKind kind;
};

/// Trajectory, association, extraction, vertices, map, and the times of the modules.
std::span<const GatedMetric> GatedMetrics();

/// Frames of the sequence and frames with a pose: the coverage.
inline constexpr const char* kFramesFigure = "/trajectory/frames";
inline constexpr const char* kTrackedFigure = "/trajectory/tracked";

/// Figures of one case by name; nothing for one that is not defined.
using Figures = std::map<std::string, std::optional<double>>;

/// How much worse the candidate is: positive is worse, 0 is equal.
double Harm(MetricKind kind, double baseline, double candidate);

/// The harm from which on a change matters.
double MaxHarm(MetricKind kind);

/// A harm in words: "+7.2 %", "-0.013".
std::string HarmText(MetricKind kind, double harm);

}  // namespace eval
