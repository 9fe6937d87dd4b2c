#pragma once

#include <optional>
#include <string_view>

namespace io {

/// Width and height of an image, pixels, and whether the mark of its end is there.
struct ImageSize {
  int width = 0, height = 0;
  bool whole = false;
};

/// The size that the header of a PNG or a JPEG file tells, before anything is decoded: a header
/// of a few bytes may ask for gigabytes. Nothing for other bytes, and sizes of 2^31 or more.
std::optional<ImageSize> ImageSizeOf(std::string_view bytes);

}  // namespace io
