#include "io/image/png_row.h"

#include <algorithm>
#include <cstdint>
#include <cstring>

namespace io {

void ReorderRow(const unsigned char* in, std::size_t pixel_bytes, std::size_t pixels,
                unsigned char* out) {
  if (pixel_bytes == 1) std::copy_n(in, pixels, out);
  for (std::size_t i = 0; pixel_bytes == 2 && i < pixels; ++i) {
    std::uint16_t sample;
    std::memcpy(&sample, in + 2 * i, sizeof sample);
    sample = static_cast<std::uint16_t>(sample << 8 | sample >> 8);
    std::memcpy(out + 2 * i, &sample, sizeof sample);
  }
  for (std::size_t i = 0; pixel_bytes == 3 && i < pixels; ++i) {
    out[3 * i] = in[3 * i + 2];
    out[3 * i + 1] = in[3 * i + 1];
    out[3 * i + 2] = in[3 * i];
  }
}

}  // namespace io
