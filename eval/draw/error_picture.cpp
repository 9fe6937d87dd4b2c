#include "eval/draw/error_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "eval/draw/paint.h"
#include "eval/draw/run_gauge.h"
#include "eval/trajectory/alignment.h"
#include "eval/trajectory/match_stamps.h"

namespace eval {
namespace {

constexpr int kWidth_px = 1400, kHeight_px = 520;
const cv::Rect2d kPlot(86, 74, kWidth_px - 86 - 40, kHeight_px - 74 - 62);
const Colour kInk{60, 55, 50}, kFaintGrid{232, 229, 226}, kCurve{190, 95, 30},
    kLost{205, 205, 250};

struct Sample {
  double time_s, error_mm;
};

std::vector<Sample> Errors(const Run& run, const Sequence& sequence) {
  const Trajectory& truth = *sequence.groundtruth;
  const std::vector<StampMatch> matches = sequence.synthetic
                                              ? MatchEqual(truth, run.trajectory)
                                              : MatchNearest(truth, run.trajectory);
  std::vector<Eigen::Vector3d> x_w, y_g;
  for (const StampMatch& match : matches) {
    x_w.push_back(run.trajectory[match.estimate].T_wc.t);
    y_g.push_back(truth[match.truth].T_wc.t);
  }
  const auto umeyama = AlignUmeyama(x_w, y_g);
  const auto poses = AlignByPoses(run.trajectory, truth, sequence.synthetic);
  if (!umeyama && !poses) return {};
  const Pose T_gw = umeyama ? umeyama->T_gw : *poses;
  std::vector<Sample> samples;
  for (std::size_t i = 0; i < matches.size(); ++i) {
    samples.push_back(
        {run.trajectory[matches[i].estimate].stamp_s, (T_gw * x_w[i] - y_g[i]).norm() * 1e3});
  }
  return samples;
}

/// Pixels of the plot from seconds and millimetres.
struct ErrorAxes {
  double t0, t1, top_mm;
  cv::Point2d At(double t, double mm) const {
    return {kPlot.x + (t - t0) / (t1 - t0) * kPlot.width,
            kPlot.y + kPlot.height * (1 - mm / top_mm)};
  }
};

void PutAxes(cv::Mat& image, const ErrorAxes& axes) {
  const TextStyle style{9.5, kInk, false, Align::kRight};
  const double step = RoundStep(axes.top_mm, 6);
  for (double mm = 0; mm <= axes.top_mm * (1 + 1e-9); mm += step) {
    PutLine(image, axes.At(axes.t0, mm), axes.At(axes.t1, mm), kFaintGrid);
    PutText(image, fmt::format("{:g}", mm), axes.At(axes.t0, mm) + cv::Point2d(-9, 4.5), style);
  }
  const double tick = RoundStep(axes.t1 - axes.t0, 10);
  for (double t = 0; t <= axes.t1 - axes.t0 + 1e-9; t += tick) {
    const cv::Point2d at = axes.At(axes.t0 + t, 0);
    PutLine(image, at, at + cv::Point2d(0, 5), kInk);
    PutText(image, fmt::format("{:g}", t), at + cv::Point2d(0, 21),
            {9.5, kInk, false, Align::kCentre});
  }
  PutLine(image, axes.At(axes.t0, 0), axes.At(axes.t1, 0), kInk);
  PutText(image, "seconds since the first frame",
          {kPlot.x + kPlot.width / 2, kHeight_px - 16.0}, {10, kInk, false, Align::kCentre});
  PutText(image, "mm", {kPlot.x - 9, kPlot.y - 14}, {10, kInk, false, Align::kRight});
}

// Frames of the sequence without a pose.
void ShadeLost(cv::Mat& image, const ErrorAxes& axes, const Run& run,
               const Sequence& sequence) {
  std::vector<double> stamps;
  for (const StampedPose& pose : run.trajectory) stamps.push_back(pose.stamp_s);
  const double half = 0.5 * (axes.t1 - axes.t0) /
                      std::max<double>(1, static_cast<double>(sequence.frames.size()) - 1);
  for (const SequenceFrame& frame : sequence.frames) {
    if (FindStamp(stamps, frame.stamp_s)) continue;
    const double from = std::max(axes.t0, frame.stamp_s - half);
    const double to = std::min(axes.t1, frame.stamp_s + half);
    FillArea(image,
             {axes.At(from, 0), axes.At(to, 0), axes.At(to, axes.top_mm),
              axes.At(from, axes.top_mm)},
             kLost, 1.0);
  }
}

void PutCurve(cv::Mat& image, const ErrorAxes& axes, const std::vector<Sample>& samples,
              double frame_s) {
  std::vector<cv::Point2d> part;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (i > 0 && samples[i].time_s - samples[i - 1].time_s > 2.5 * frame_s) {
      PutPath(image, part, false, kCurve, 2);
      part.clear();
    }
    part.push_back(axes.At(samples[i].time_s, samples[i].error_mm));
    if (samples.size() < 120) PutDot(image, part.back(), 2.6, kCurve);
  }
  PutPath(image, part, false, kCurve, 2);
}

void PutTitle(cv::Mat& image, const std::vector<Sample>& samples, std::size_t frames) {
  double squares = 0, largest = 0;
  for (const Sample& sample : samples) {
    squares += sample.error_mm * sample.error_mm;
    largest = std::max(largest, sample.error_mm);
  }
  const double rmse = std::sqrt(squares / static_cast<double>(samples.size()));
  PutText(image, "Position error after rigid alignment", {kPlot.x, 34},
          {13, kInk, true, Align::kLeft});
  PutText(image,
          fmt::format("ATE rmse {:.2f} mm   max {:.2f} mm   {} of {} frames compared", rmse,
                      largest, samples.size(), frames),
          {kPlot.x + kPlot.width, 34}, {11, kInk, false, Align::kRight});
}

}  // namespace

double RoundStep(double range, int parts) {
  if (!(range > 0)) return 1;
  const double raw = range / parts;
  const double power = std::pow(10.0, std::floor(std::log10(raw)));
  const double mantissa = raw / power;
  return power * (mantissa <= 1 ? 1 : mantissa <= 2 ? 2 : mantissa <= 5 ? 5 : 10);
}

std::optional<cv::Mat> ErrorOverTime(const Run& run, const Sequence& sequence) {
  if (!sequence.groundtruth) return std::nullopt;
  const std::vector<Sample> samples = Errors(run, sequence);
  if (samples.size() < 2 || sequence.frames.size() < 2) return std::nullopt;
  double largest = 0.1;  // below, the curve would show round-off
  for (const Sample& sample : samples) largest = std::max(largest, sample.error_mm);
  const double step = RoundStep(largest, 6);
  const ErrorAxes axes{sequence.frames.front().stamp_s, sequence.frames.back().stamp_s,
                       step * std::ceil(largest * 1.02 / step)};
  cv::Mat image(kHeight_px, kWidth_px, CV_8UC3, kWhite);
  ShadeLost(image, axes, run, sequence);
  PutAxes(image, axes);
  PutCurve(image, axes, samples,
           (axes.t1 - axes.t0) / static_cast<double>(sequence.frames.size() - 1));
  PutTitle(image, samples, sequence.frames.size());
  return image;
}

}  // namespace eval
