#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace io {

enum class ImageFormat { kPng, kJpeg };

/// What the header of an image file tells before anything is decoded: a header of a few bytes may ask
/// for gigabytes.
struct ImageHeader {
  ImageFormat format = ImageFormat::kPng;
  int width = 0, height = 0;  ///< pixels
  std::string pixels;         ///< "8-bit RGB" (palettes too), "16-bit gray" and so on
  bool whole = false;         ///< the mark of its end is there
};

/// Nothing for bytes that are no PNG or JPEG file, are cut off in the header, or have sides of 2^31
/// pixels and more.
std::optional<ImageHeader> ReadImageHeader(std::string_view bytes);

}  // namespace io
