#include "sim/sensor/report/sensor_figure.h"

#include <algorithm>
#include <cstdio>
#include <functional>
#include <opencv2/imgproc.hpp>

#include "sim/base/angle.h"

namespace sim {
namespace {

const cv::Scalar kInk(60, 60, 60), kGrid(225, 225, 225), kStated(190, 110, 30),
    kMeasured(40, 40, 210);

/// Axes of one diagram: millimetres upwards from 0.
class Diagram {
 public:
  Diagram(cv::Mat3b picture, cv::Rect area, double x_low, double x_high, double y_high)
      : picture_(std::move(picture)),
        area_(area),
        x_low_(x_low),
        x_high_(x_high),
        y_high_(y_high) {}

  void Frame(double x_step, const char* x_label, const char* title) {
    const double y_step = Step(y_high_);
    for (double y = 0; y <= y_high_ * 1.0001; y += y_step) {
      const cv::Point at = Place(x_low_, y);
      cv::line(picture_, at, Place(x_high_, y), kGrid);
      Text(Number(y), at + cv::Point(-46, 5));
    }
    for (double x = x_low_; x <= x_high_ * 1.0001; x += x_step) {
      cv::line(picture_, Place(x, 0), Place(x, y_high_), kGrid);
      Text(Number(x), Place(x, 0) + cv::Point(-10, 20));
    }
    cv::rectangle(picture_, area_, kInk);
    Text(x_label, {area_.x + area_.width / 2 - 60, area_.y + area_.height + 42});
    Text(title, {area_.x, area_.y - 12});
  }
  void Curve(const std::function<double(double)>& y_of) {
    std::vector<cv::Point> line;
    for (int i = 0; i <= 200; ++i) {
      const double x = x_low_ + (x_high_ - x_low_) * i / 200.0;
      const double y = y_of(x);
      if (y <= y_high_) line.push_back(Place(x, y));
    }
    cv::polylines(picture_, line, false, kStated, 2, cv::LINE_AA);
  }
  void Dot(double x, double y) {
    cv::circle(picture_, Place(x, std::min(y, y_high_)), 5, kMeasured, cv::FILLED, cv::LINE_AA);
  }
  void Text(const std::string& text, cv::Point at) {
    cv::putText(picture_, text, at, cv::FONT_HERSHEY_SIMPLEX, 0.45, kInk, 1, cv::LINE_AA);
  }

 private:
  static double Step(double high) {
    for (const double step : {0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0}) {
      if (high / step <= 8) return step;
    }
    return high / 5;
  }
  static std::string Number(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.4g", value);
    return text;
  }
  cv::Point Place(double x, double y) const {
    return {area_.x + cvRound((x - x_low_) / (x_high_ - x_low_) * area_.width),
            area_.y + area_.height - cvRound(y / y_high_ * area_.height)};
  }

  cv::Mat3b picture_;
  cv::Rect area_;
  double x_low_, x_high_, y_high_;
};

double Highest(const std::vector<WallMeasurement>& walls) {
  double highest = 0.1;
  for (const WallMeasurement& wall : walls) {
    highest = std::max({highest, 1.15e3 * wall.stated_sd_m, 1.15e3 * wall.sd_m});
  }
  return highest;
}

}  // namespace

cv::Mat3b DrawReport(const Sensor& sensor, const SensorReport& report) {
  cv::Mat3b picture(400, 1000, cv::Vec3b(255, 255, 255));
  Diagram depth(picture, {70, 40, 400, 290}, 0.5, 3.1, Highest(report.by_depth));
  depth.Frame(0.5, "depth z, m",
              ("sd of depth, mm: " + sensor.name + ", frontal wall").c_str());
  depth.Curve([&](double z) { return 1e3 * DepthSigma(sensor.depth, z, 0); });
  for (const WallMeasurement& wall : report.by_depth) depth.Dot(wall.z_m, 1e3 * wall.sd_m);

  Diagram tilt(picture, {570, 40, 400, 290}, 0, 80, Highest(report.by_tilt));
  tilt.Frame(20, "tilt of the wall, deg", "sd of depth, mm: wall at 1 m, tilted");
  tilt.Curve(
      [&](double deg) { return 1e3 * DepthSigma(sensor.depth, 1.0, deg * kDegree_rad); });
  for (const WallMeasurement& wall : report.by_tilt) {
    tilt.Dot(wall.tilt_rad / kDegree_rad, 1e3 * wall.sd_m);
  }
  depth.Text("line: stated   dots: measured", {85, 62});
  return picture;
}

}  // namespace sim
