#pragma once

#include <libdeflate.h>

#include <array>
#include <cstdint>
#include <memory>
#include <opencv2/core.hpp>
#include <string>
#include <string_view>

namespace io {

inline void AppendPngNumber(std::uint32_t value, std::string& out) {
  for (int shift = 24; shift >= 0; shift -= 8) out += static_cast<char>(value >> shift & 0xFFu);
}

inline void AppendPngChunk(std::string_view type, std::string_view data, std::string& out) {
  AppendPngNumber(static_cast<std::uint32_t>(data.size()), out);
  const std::size_t start = out.size();
  out.append(type).append(data);
  AppendPngNumber(libdeflate_crc32(0, out.data() + start, out.size() - start), out);
}

inline std::string Packed(const std::string& bytes) {
  constexpr int kLevel = 6;
  const std::unique_ptr<libdeflate_compressor, decltype(&libdeflate_free_compressor)> packer(
      libdeflate_alloc_compressor(kLevel), libdeflate_free_compressor);
  std::string packed(libdeflate_zlib_compress_bound(packer.get(), bytes.size()), '\0');
  packed.resize(libdeflate_zlib_compress(packer.get(), bytes.data(), bytes.size(),
                                         packed.data(), packed.size()));
  return packed;
}

/// Bits a sample, kind of colour as in the header, samples a pixel.
struct PngKind {
  int bits = 8, colour = 2, samples = 3;
};
constexpr PngKind kRgb{8, 2, 3}, kRgb16{16, 2, 3}, kGray16{16, 0, 1}, kGray8{8, 0, 1},
    kGray4{4, 0, 1}, kGray1{1, 0, 1}, kPalette{8, 3, 1}, kPalette2{2, 3, 1}, kRgba{8, 6, 4};

struct PngMake {
  int width = 37, height = 23;
  int filter = -1;         ///< of all rows; -1: each in turn
  std::size_t parts = 1;   ///< chunks of pixels
  std::string extra = {};  ///< type of a chunk before them
  int extra_bytes = 6;
  std::string ending = "IEND";
  bool interlaced = false;
};

/// A PNG file of this kind, its rows of filtered bytes made up at random: whatever they come to, all
/// decoders must agree.
inline std::string MadePng(const PngKind& kind, const PngMake& make) {
  cv::RNG random(7);
  std::string rows;
  int filter = 0;
  const auto add_rows = [&](int width, int height) {
    const int bytes = (width * kind.samples * kind.bits + 7) / 8;
    for (int v = 0; width > 0 && v < height; ++v) {
      rows += static_cast<char>(make.filter >= 0 ? make.filter : filter++ % 5);
      for (int i = 0; i < bytes; ++i) rows += static_cast<char>(random.uniform(0, 256));
    }
  };
  if (!make.interlaced) add_rows(make.width, make.height);
  // Adam7: where each pass begins and its steps, u and v.
  constexpr std::array<std::array<int, 4>, 7> kPasses = {{{0, 0, 8, 8},
                                                          {4, 0, 8, 8},
                                                          {0, 4, 4, 8},
                                                          {2, 0, 4, 4},
                                                          {0, 2, 2, 4},
                                                          {1, 0, 2, 2},
                                                          {0, 1, 1, 2}}};
  for (const auto& [u, v, du, dv] : kPasses) {
    if (make.interlaced)
      add_rows((make.width - u + du - 1) / du, (make.height - v + dv - 1) / dv);
  }
  const std::string packed = Packed(rows);

  std::string file("\x89PNG\r\n\x1a\n"), header;
  AppendPngNumber(static_cast<std::uint32_t>(make.width), header);
  AppendPngNumber(static_cast<std::uint32_t>(make.height), header);
  for (const int byte : {kind.bits, kind.colour, 0, 0, make.interlaced ? 1 : 0}) {
    header += static_cast<char>(byte);
  }
  AppendPngChunk("IHDR", header, file);
  if (kind.colour == 3) {
    std::string colours;
    for (int i = 0; i < 3 << kind.bits; ++i)
      colours += static_cast<char>(random.uniform(0, 256));
    AppendPngChunk("PLTE", colours, file);
  }
  if (!make.extra.empty()) {
    AppendPngChunk(make.extra, std::string(static_cast<std::size_t>(make.extra_bytes), '\0'),
                   file);
  }
  for (std::size_t k = 0; k < make.parts; ++k) {
    const std::size_t begin = k * packed.size() / make.parts;
    const std::size_t end = (k + 1) * packed.size() / make.parts;
    AppendPngChunk("IDAT", packed.substr(begin, end - begin), file);
  }
  AppendPngChunk(make.ending, {}, file);
  return file;
}

}  // namespace io
