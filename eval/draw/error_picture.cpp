#include "eval/draw/error_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "eval/draw/legend.h"
#include "eval/draw/paint.h"
#include "eval/trajectory/statistics.h"

namespace eval {
namespace {

constexpr int kErrorWidth_px = 1400, kErrorHeight_px = 742, kGapLegend_px = 38;
constexpr double kLeft_px = 86, kPanelWidth_px = kErrorWidth_px - kLeft_px - 40;
const cv::Rect2d kPositionPanel(kLeft_px, 128, kPanelWidth_px, 280);
const cv::Rect2d kRotationPanel(kLeft_px, 488, kPanelWidth_px, 190);
const Colour kErrorInk{60, 55, 50}, kFaintGrid{232, 229, 226}, kPositionCurve{190, 95, 30},
    kRotationCurve{60, 130, 30}, kErrorWarning{40, 40, 215};
constexpr std::size_t kMaxDots = 120;  // more samples than these melt into the line
const TextStyle kErrorLegend{10.5, kErrorInk, false, Align::kLeft};

Colour ColourOf(Gap gap) {
  switch (gap) {
    case Gap::kLost:
      return {200, 200, 255};
    case Gap::kNotRun:
      return {225, 225, 225};
    case Gap::kNoTruth:
      break;
  }
  return {205, 240, 250};
}

const char* MeaningOf(Gap gap) {
  switch (gap) {
    case Gap::kLost:
      return "lost: no pose";
    case Gap::kNotRun:
      return "not run: interrupted before";
    case Gap::kNoTruth:
      break;
  }
  return "no true pose to compare with";
}

/// One quantity over time.
struct Panel {
  cv::Rect2d area;
  std::string title;
  Colour colour;
  std::vector<double> values;  ///< of the samples
  double top;                  ///< value at the upper edge
  double duration_s;
  cv::Point2d At(double time_s, double value) const {
    return {area.x + time_s / duration_s * area.width,
            area.y + area.height * (1 - value / top)};
  }
};

constexpr double kRoom = 1.02;  // of a panel above its largest value, so that its dot is whole

/// The upper edge of a panel: a round value at or above the largest one.
double TopOf(double largest) {
  const double step = RoundStep(largest, 5);
  return step * std::ceil(largest / step);
}

void ShadeGaps(cv::Mat& image, const Panel& panel, const std::vector<GapSpan>& gaps) {
  constexpr double kMinShade_px = 2;  // a single frame of a long sequence is still seen
  for (const GapSpan& gap : gaps) {
    double from = panel.At(gap.from_s, 0).x, to = panel.At(gap.to_s, 0).x;
    const double missing = std::max(0.0, kMinShade_px - (to - from));
    from -= missing / 2, to += missing / 2;
    const double y0 = panel.area.y, y1 = panel.area.y + panel.area.height;
    FillArea(image, {{from, y0}, {to, y0}, {to, y1}, {from, y1}}, ColourOf(gap.gap), 1.0);
  }
}

void PutPanelAxes(cv::Mat& image, const Panel& panel) {
  const TextStyle style{10, kErrorInk, false, Align::kRight};
  const double step = RoundStep(panel.top, 5);
  for (double value = 0; value <= panel.top * (1 + 1e-9); value += step) {
    PutLine(image, panel.At(0, value), panel.At(panel.duration_s, value), kFaintGrid);
    PutText(image, fmt::format("{:g}", value), panel.At(0, value) + cv::Point2d(-9, 4.5),
            style);
  }
  PutText(image, panel.title, {panel.area.x, panel.area.y - 14},
          {11, kErrorInk, true, Align::kLeft});
  PutLine(image, panel.At(0, 0), panel.At(panel.duration_s, 0), kErrorInk);
  const double tick = RoundStep(panel.duration_s, 10);
  for (double t = 0; t <= panel.duration_s * (1 + 1e-9); t += tick) {
    const cv::Point2d at = panel.At(t, 0);
    PutLine(image, at, at + cv::Point2d(0, 5), kErrorInk);
    PutText(image, fmt::format("{:g}", t), at + cv::Point2d(0, 22),
            {10, kErrorInk, false, Align::kCentre});
  }
}

/// Time between the samples without a gap, most often.
double UsualStep(const std::vector<ErrorSample>& samples) {
  std::vector<double> times_s;
  for (const ErrorSample& sample : samples) times_s.push_back(sample.time_s);
  return MedianStep(times_s);
}

void PutErrorCurve(cv::Mat& image, const Panel& panel,
                   const std::vector<ErrorSample>& samples) {
  constexpr double kMaxStepRatio = 2.5;  // a longer step is a gap, over which no line leads
  const double max_step_s = kMaxStepRatio * UsualStep(samples);
  std::vector<cv::Point2d> part;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (i > 0 && samples[i].time_s - samples[i - 1].time_s > max_step_s) {
      PutPath(image, part, false, panel.colour, 2);
      part.clear();
    }
    part.push_back(panel.At(samples[i].time_s, panel.values[i]));
    if (samples.size() < kMaxDots) PutDot(image, part.back(), 2.6, panel.colour);
  }
  PutPath(image, part, false, panel.colour, 2);
}

struct Range {
  double rmse = 0, max = 0;
};
Range RangeOf(const std::vector<double>& values) {
  Range range;
  for (const double value : values) {
    range.rmse += value * value;
    range.max = std::max(range.max, value);
  }
  if (!values.empty()) range.rmse = std::sqrt(range.rmse / static_cast<double>(values.size()));
  return range;
}

Panel PositionPanel(const ErrorCurve& curve) {
  constexpr double kMinTop = 0.1;  // mm; below, round-off would be drawn
  constexpr double kMaxInMillimetres = 2000;
  std::vector<double> errors;
  for (const ErrorSample& sample : curve.samples) errors.push_back(sample.position_mm);
  const bool metres = RangeOf(errors).max > kMaxInMillimetres;
  if (metres) {
    for (double& error : errors) error /= 1000;
  }
  const Range range = RangeOf(errors);
  std::string title = fmt::format("Position error, {}", metres ? "m" : "mm");
  if (!errors.empty()) {
    title += fmt::format("  ({} {:.3g}, max {:.3g}; {})",
                         curve.alignment == ErrorAlignment::kPositions ? "ATE rmse" : "rmse",
                         range.rmse, range.max, Explain(curve.alignment));
  }
  return {kPositionPanel,
          title,
          kPositionCurve,
          errors,
          TopOf(std::max(kRoom * range.max, kMinTop)),
          curve.duration_s};
}

Panel RotationPanel(const ErrorCurve& curve) {
  constexpr double kMinTop = 0.01;  // degrees; below, round-off would be drawn
  std::vector<double> errors;
  for (const ErrorSample& sample : curve.samples) errors.push_back(sample.rotation_deg);
  const Range range = RangeOf(errors);
  std::string title = "Rotation error, degrees";
  if (!errors.empty()) {
    title += fmt::format("  (rmse {:.3g}, max {:.3g}; after the mean rotation is taken out)",
                         range.rmse, range.max);
  }
  return {kRotationPanel,
          title,
          kRotationCurve,
          errors,
          TopOf(std::max(kRoom * range.max, kMinTop)),
          curve.duration_s};
}

void PutErrorTitle(cv::Mat& image, const RunTitle& title, const ErrorCurve& curve) {
  const TextStyle bold{14, kErrorInk, true, Align::kLeft};
  TextStyle warning = bold;
  warning.colour = kErrorWarning;
  const double warning_width =
      title.warning.empty() ? 0 : TextWidth(title.warning, warning) + 24;
  const std::string name =
      Fitted("Errors of " + title.run + " over time", bold, kPanelWidth_px - warning_width);
  PutText(image, name, {kLeft_px, 34}, bold);
  PutText(image, title.warning, {kLeft_px + TextWidth(name, bold) + 24, 34}, warning);
  PutText(image,
          fmt::format("{}   {} of {} frames compared with the truth", title.figures,
                      curve.samples.size(), curve.frames),
          {kLeft_px, 62}, kErrorLegend);
}

void PutGapLegend(cv::Mat& image, const ErrorCurve& curve) {
  std::vector<LegendItem> items;
  for (const Gap gap : {Gap::kLost, Gap::kNotRun, Gap::kNoTruth}) {
    int spans = 0, frames = 0;
    for (const GapSpan& span : curve.gaps) {
      if (span.gap == gap) ++spans, frames += span.frames;
    }
    if (spans == 0) continue;
    items.push_back({24,
                     fmt::format("{} ({} frame{} in {} span{})", MeaningOf(gap), frames,
                                 frames == 1 ? "" : "s", spans, spans == 1 ? "" : "s"),
                     [gap](cv::Mat& page, cv::Point2d left) {
                       FillArea(page,
                                {left + cv::Point2d(0, -8), left + cv::Point2d(24, -8),
                                 left + cv::Point2d(24, 8), left + cv::Point2d(0, 8)},
                                ColourOf(gap), 1.0);
                     }});
  }
  PutLegend(image, items, kErrorLegend,
            {kLeft_px, kRotationPanel.y + kRotationPanel.height + 62}, kPanelWidth_px);
}

}  // namespace

double RoundStep(double range, int parts) {
  if (!(range > 0 && std::isfinite(range))) return 1;
  const double raw = range / parts;
  const double power = std::pow(10.0, std::floor(std::log10(raw)));
  const double mantissa = raw / power;
  return power * (mantissa <= 1 ? 1 : mantissa <= 2 ? 2 : mantissa <= 5 ? 5 : 10);
}

cv::Mat DrawErrors(const ErrorCurve& curve, const RunTitle& title) {
  const int height = kErrorHeight_px + (curve.gaps.empty() ? 0 : kGapLegend_px);
  cv::Mat image(height, kErrorWidth_px, CV_8UC3, kWhite);
  PutErrorTitle(image, title, curve);
  for (const Panel& panel : {PositionPanel(curve), RotationPanel(curve)}) {
    ShadeGaps(image, panel, curve.gaps);
    PutPanelAxes(image, panel);
    PutErrorCurve(image, panel, curve.samples);
  }
  PutText(image, "seconds since the first frame",
          {kLeft_px + kPanelWidth_px / 2, kRotationPanel.y + kRotationPanel.height + 46},
          {10.5, kErrorInk, false, Align::kCentre});
  if (curve.samples.empty()) {
    PutText(image, Explain(curve.alignment),
            {kLeft_px + kPanelWidth_px / 2, kPositionPanel.y + kPositionPanel.height / 2},
            {12, kErrorWarning, true, Align::kCentre});
  }
  PutGapLegend(image, curve);
  return image;
}

}  // namespace eval
