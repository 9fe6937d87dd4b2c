#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace io {

/// The first bytes of every PNG file (ISO/IEC 15948, 5.2).
inline constexpr std::string_view kPngSignature = "\x89PNG\r\n\x1a\n";

/// What each byte of a row is stored as the difference from; stands before the row (9.2).
enum class PngFilter : std::uint8_t { kNone = 0, kLeft = 1, kAbove = 2, kMean = 3, kPaeth = 4 };

/// A number of four bytes as PNG has them, the highest first.
inline std::uint32_t PngNumber(std::string_view bytes, std::size_t at) {
  std::uint32_t number = 0;
  for (const char c : bytes.substr(at, 4)) {
    number = number << 8 | static_cast<unsigned char>(c);
  }
  return number;
}

}  // namespace io
