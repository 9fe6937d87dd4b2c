#pragma once

#include <cstddef>

namespace io {

/// Samples of a row from a PNG's order (red first, high byte first) to OpenCV's (blue first, low byte
/// first), or back: the way back is the same.
/// @param pixel_bytes  1 or 2: gray; 3: colour
void ReorderRow(const unsigned char* in, std::size_t pixel_bytes, std::size_t pixels,
                unsigned char* out);

}  // namespace io
