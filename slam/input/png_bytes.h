#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace slam {

/// The first bytes of every PNG file (ISO/IEC 15948, 5.2).
inline constexpr std::array<std::uint8_t, 8> kPngSignature = {0x89, 'P',  'N', 'G',
                                                              '\r', '\n', 26,  '\n'};

/// A number of four bytes as PNG has them, the highest first.
inline std::uint32_t PngNumber(std::span<const std::uint8_t> bytes, std::size_t at) {
  return std::uint32_t{bytes[at]} << 24 | std::uint32_t{bytes[at + 1]} << 16 |
         std::uint32_t{bytes[at + 2]} << 8 | std::uint32_t{bytes[at + 3]};
}

}  // namespace slam
