#include "eval/draw/paint.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace eval {
namespace {

constexpr int kShift = 4;  // OpenCV draws at 1/16 pixel
constexpr int kTextZoom = 4;
constexpr int kFont = cv::FONT_HERSHEY_SIMPLEX;
constexpr double kCapitalHeight_px = 21.0;  // of the font at scale 1

cv::Point Fixed(cv::Point2d p) {
  // Beyond this OpenCV's fixed point overflows; nothing out there is seen anyway.
  const auto clamp = [](double v) { return std::clamp(v, -20000.0, 20000.0); };
  return {cvRound(clamp(p.x) * (1 << kShift)), cvRound(clamp(p.y) * (1 << kShift))};
}

std::string Ascii(const std::string& text) {
  std::string ascii;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte >= 0x80 && byte < 0xC0) continue;  // inside a UTF-8 character
    ascii += byte >= 0x20 && byte < 0x7F ? c : '?';
  }
  return ascii;
}

double Scale(const TextStyle& style) { return style.height_px * kTextZoom / kCapitalHeight_px; }

int Thickness(const TextStyle& style) {
  return std::max(1, cvRound(style.height_px * kTextZoom * (style.bold ? 0.19 : 0.125)));
}

void Blend(cv::Mat& image, const cv::Mat& mask, cv::Point at, const Colour& colour,
           double opacity) {
  const cv::Rect area = cv::Rect(at, mask.size()) & cv::Rect({0, 0}, image.size());
  for (int y = area.y; y < area.y + area.height; ++y) {
    auto* row = image.ptr<cv::Vec3b>(y);
    const auto* weights = mask.ptr<uchar>(y - at.y);
    for (int x = area.x; x < area.x + area.width; ++x) {
      const double a = weights[x - at.x] * opacity / 255.0;
      if (a <= 0) continue;
      for (int c = 0; c < 3; ++c) {
        row[x][c] = cv::saturate_cast<uchar>(row[x][c] * (1 - a) + colour[c] * a);
      }
    }
  }
}

}  // namespace

Colour ColourOfPlane(int id) {
  const double hue = std::fmod(0.11 + 0.61803398875 * id, 1.0) * 6;
  // Three shades tell hues apart that come close after many ids.
  const double value = id % 3 == 0 ? 245 : id % 3 == 1 ? 215 : 235;
  const double saturation = id % 3 == 1 ? 0.85 : 0.68;
  const auto channel = [&](double n) {
    const double k = std::fmod(n + hue, 6.0);
    return value * (1 - saturation * std::clamp(std::min(k, 4 - k), 0.0, 1.0));
  };
  return {channel(1), channel(3), channel(5)};
}

Colour Darker(const Colour& colour, double factor) {
  return {colour[0] * factor, colour[1] * factor, colour[2] * factor};
}

double TextWidth(const std::string& text, const TextStyle& style) {
  int base = 0;
  const cv::Size size =
      cv::getTextSize(Ascii(text), kFont, Scale(style), Thickness(style), &base);
  return static_cast<double>(size.width) / kTextZoom;
}

std::string Fitted(const std::string& text, const TextStyle& style, double width_px) {
  std::string fitted = Ascii(text);
  if (TextWidth(fitted, style) <= width_px) return fitted;
  const std::string dots = "...";
  while (!fitted.empty() && TextWidth(fitted + dots, style) > width_px) fitted.pop_back();
  return fitted + dots;
}

void PutText(cv::Mat& image, const std::string& text, cv::Point2d base,
             const TextStyle& style) {
  const std::string ascii = Ascii(text);
  if (ascii.empty()) return;
  const double width = TextWidth(ascii, style);
  if (style.align == Align::kCentre) base.x -= width / 2;
  if (style.align == Align::kRight) base.x -= width;
  const int above = cvCeil(style.height_px * 1.6) + 2,
            below = cvCeil(style.height_px * 0.7) + 2;
  const int pad = 3;
  const cv::Point corner(cvFloor(base.x) - pad, cvFloor(base.y) - above);
  cv::Mat large = cv::Mat::zeros((above + below) * kTextZoom,
                                 (cvCeil(width) + 2 * pad + 2) * kTextZoom, CV_8U);
  const cv::Point origin(cvRound((base.x - corner.x) * kTextZoom),
                         cvRound((base.y - corner.y) * kTextZoom));
  cv::putText(large, ascii, origin, kFont, Scale(style), cv::Scalar(255), Thickness(style),
              cv::LINE_AA);
  cv::Mat mask;
  cv::resize(large, mask, {}, 1.0 / kTextZoom, 1.0 / kTextZoom, cv::INTER_AREA);
  Blend(image, mask, corner, style.colour, 1.0);
}

void PutLine(cv::Mat& image, cv::Point2d from, cv::Point2d to, const Colour& colour,
             int width_px) {
  cv::line(image, Fixed(from), Fixed(to), colour, width_px, cv::LINE_AA, kShift);
}

void PutDashedLine(cv::Mat& image, cv::Point2d from, cv::Point2d to, const Colour& colour,
                   int width_px, double dash_px) {
  const cv::Point2d along = to - from;
  const double length = std::hypot(along.x, along.y);
  if (!(length > 0 && length < 1e5)) return;
  for (double s = 0; s < length; s += 2 * dash_px) {
    PutLine(image, from + along * (s / length),
            from + along * (std::min(s + dash_px, length) / length), colour, width_px);
  }
}

void PutPath(cv::Mat& image, const std::vector<cv::Point2d>& points, bool closed,
             const Colour& colour, int width_px) {
  if (points.size() < 2) return;
  std::vector<cv::Point> fixed;
  fixed.reserve(points.size());
  for (const cv::Point2d& p : points) fixed.push_back(Fixed(p));
  cv::polylines(image, fixed, closed, colour, width_px, cv::LINE_AA, kShift);
}

void PutDot(cv::Mat& image, cv::Point2d centre, double radius_px, const Colour& colour) {
  cv::circle(image, Fixed(centre), cvRound(radius_px * (1 << kShift)), colour, cv::FILLED,
             cv::LINE_AA, kShift);
}

void PutRingedDot(cv::Mat& image, cv::Point2d centre, double radius_px, const Colour& fill,
                  const Colour& ring) {
  PutDot(image, centre, radius_px, ring);
  PutDot(image, centre, radius_px * 0.58, fill);
}

void PutHaloedPath(cv::Mat& image, const std::vector<cv::Point2d>& points, bool closed,
                   const Colour& colour, int width_px) {
  PutPath(image, points, closed, kBlack, width_px + 2);
  PutPath(image, points, closed, colour, width_px);
}

void FillArea(cv::Mat& image, const std::vector<cv::Point2d>& polygon, const Colour& colour,
              double opacity) {
  if (polygon.size() < 3) return;
  std::vector<cv::Point> fixed;
  fixed.reserve(polygon.size());
  for (const cv::Point2d& p : polygon) fixed.push_back(Fixed(p));
  cv::Mat mask = cv::Mat::zeros(image.size(), CV_8U);
  cv::fillPoly(mask, std::vector<std::vector<cv::Point>>{fixed}, cv::Scalar(255), cv::LINE_AA,
               kShift);
  Blend(image, mask, {0, 0}, colour, opacity);
}

void FillMask(cv::Mat& image, const cv::Mat& mask, const Colour& colour, double opacity) {
  Blend(image, mask, {0, 0}, colour, opacity);
}

}  // namespace eval
