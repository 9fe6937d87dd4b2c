#pragma once

#include <opencv2/core.hpp>
#include <string>
#include <vector>

/// Smooth text, lines and translucent areas on BGR images. All positions are pixels, fractions
/// count.
namespace eval {

using Colour = cv::Scalar;  ///< BGR, 0 to 255

inline const Colour kWhite{255, 255, 255};
inline const Colour kBlack{0, 0, 0};

/// The colour of a map plane: hues a golden angle apart, so that neighbouring ids differ and an
/// id has one colour in every picture of every run.
Colour ColourOfPlane(int id);
/// A darker shade of a colour, readable on white.
Colour Darker(const Colour& colour, double factor = 0.6);

enum class Align { kLeft, kCentre, kRight };

struct TextStyle {
  double height_px = 11;  ///< height of a capital letter
  Colour colour = kWhite;
  bool bold = false;
  Align align = Align::kLeft;
};

/// Width of the text in pixels.
double TextWidth(const std::string& text, const TextStyle& style);
/// The text, cut off with "..." where it is wider than `width_px`.
std::string Fitted(const std::string& text, const TextStyle& style, double width_px);
/// Writes text whose base line starts (or is centred, or ends) at `base`. Characters outside
/// ASCII become '?'.
void PutText(cv::Mat& image, const std::string& text, cv::Point2d base, const TextStyle& style);

void PutLine(cv::Mat& image, cv::Point2d from, cv::Point2d to, const Colour& colour,
             int width_px = 1);
void PutDashedLine(cv::Mat& image, cv::Point2d from, cv::Point2d to, const Colour& colour,
                   int width_px = 1, double dash_px = 7);
void PutPath(cv::Mat& image, const std::vector<cv::Point2d>& points, bool closed,
             const Colour& colour, int width_px = 1);
void PutDot(cv::Mat& image, cv::Point2d centre, double radius_px, const Colour& colour);
/// A dot with a ring around it.
void PutRingedDot(cv::Mat& image, cv::Point2d centre, double radius_px, const Colour& fill,
                  const Colour& ring);
/// A line on a dark one, seen on any ground.
void PutHaloedPath(cv::Mat& image, const std::vector<cv::Point2d>& points, bool closed,
                   const Colour& colour, int width_px);
/// Fills a polygon; opacity 0 to 1.
void FillArea(cv::Mat& image, const std::vector<cv::Point2d>& polygon, const Colour& colour,
              double opacity);
/// Fills the pixels where the mask (CV_8U, same size) is set.
void FillMask(cv::Mat& image, const cv::Mat& mask, const Colour& colour, double opacity);

}  // namespace eval
