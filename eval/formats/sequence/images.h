#pragma once

#include <filesystem>
#include <map>
#include <opencv2/core.hpp>
#include <string>

#include "eval/formats/folder.h"

namespace eval {

/// Either of 8 and 16 bits.
inline constexpr int kAnyDepth = -1;
/// Colour or gray, with alpha or without.
inline constexpr int kAnyColour = -1;

/// What an image of a folder must be.
struct ImageKind {
  int depth = CV_8U;  ///< CV_8U, CV_16U or kAnyDepth
  int channels = 1;   ///< or kAnyColour
  cv::Size size;      ///< any when it is empty
};

/// Decodes a PNG as it is stored; colour (8 bits, kAnyColour) may be JPEG. One that is cut off or
/// broken, or of another kind, is a fault, and the image is then empty.
cv::Mat ReadImage(Folder& folder, const std::string& file, const ImageKind& kind);

/// Pixels of a plane or an object; inclusive box of pixel centres.
struct PixelSet {
  int count = 0;
  int x0 = 0, y0 = 0, x1 = -1, y1 = -1;
  void Add(int u, int v);
};

/// The pixels of every id in an image of ids (CV_16U) but 0, which is none.
std::map<int, PixelSet> PixelsOfIds(const cv::Mat1w& ids);

/// An image of labels or depths, of this kind and no other, widened to 16 bits.
/// @throws InputError
cv::Mat1w ReadLabels(const std::filesystem::path& file, const ImageKind& kind);

/// A colour image, PNG or JPEG, as CV_8UC3 in BGR order, its pixels as they are stored whatever the
/// file says of the camera's orientation.
/// @throws InputError when it cannot be read, is no colour image or is too large
cv::Mat ReadColour(const std::filesystem::path& file);

}  // namespace eval
