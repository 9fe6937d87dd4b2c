#include "slam/calibrate/warp_file.h"

#include <fmt/format.h>

#include <cmath>

#include "io/input_error.h"
#include "io/yaml_value.h"

namespace slam {
namespace {

constexpr const char* kWarpFormat = "pas-depth-warp/1";
constexpr double kMillion = 1e6;
constexpr double kMaxPattern_ppm = 100000;  // a tenth of the depth: no sensor is so far off
constexpr int kMaxImage_px = 8192;

/// A list a row of cells.
Eigen::VectorXd ReadCells(const io::YamlValue& value, const WarpCells& cells,
                          const io::Interval& domain) {
  const std::vector<io::YamlValue> rows = value.List();
  if (static_cast<int>(rows.size()) != cells.rows) {
    value.Fail(
        fmt::format("has {} rows; expected {}, as cells: says", rows.size(), cells.rows));
  }
  Eigen::VectorXd all(cells.count());
  for (int row = 0; row < cells.rows; ++row) {
    all.segment(row * cells.cols, cells.cols) =
        rows[static_cast<std::size_t>(row)].Numbers(cells.cols, domain, "ppm") / kMillion;
  }
  return all;
}

std::string CellRows(const char* key, const WarpCells& cells, const Eigen::VectorXd& values) {
  std::string text = fmt::format("{}:\n", key);
  for (int row = 0; row < cells.rows; ++row) {
    text += "  - [";
    for (int col = 0; col < cells.cols; ++col) {
      text += fmt::format("{}{}", col > 0 ? ", " : "",
                          std::lround(kMillion * values[row * cells.cols + col]));
    }
    text += "]\n";
  }
  return text;
}

}  // namespace

DepthWarp ReadWarp(const std::filesystem::path& file, const Camera& camera) {
  const io::YamlMap map(io::ReadYaml(file, "make it with `pas calibrate SEQ -o FILE`"),
                        {"format", "image", "cells", "law", "pattern_ppm", "sigma_ppm"});
  map.At("format").OneOf({kWarpFormat});
  const io::YamlMap image(map.At("image"), {"width", "height"});
  const io::YamlMap grid(map.At("cells"), {"cols", "rows"});
  DepthWarp warp;
  WarpCells& cells = warp.cells;
  cells.width = image.At("width").Whole(io::Interval(1, kMaxImage_px));
  cells.height = image.At("height").Whole(io::Interval(1, kMaxImage_px));
  if (cells.width != camera.width || cells.height != camera.height) {
    map.At("image").Fail(fmt::format(
        "the warp is that of images of {} x {}, those of the camera have {} x {}; make it "
        "from a recording of this camera",
        cells.width, cells.height, camera.width, camera.height));
  }
  cells.cols = grid.At("cols").Whole(io::Interval(1, cells.width));
  cells.rows = grid.At("rows").Whole(io::Interval(1, cells.height));
  // Files of before it was asked have none.
  if (map.Has("law")) warp.law = static_cast<BendLaw>(map.At("law").OneOf(BendLawNames()));
  warp.pattern =
      ReadCells(map.At("pattern_ppm"), cells, io::Interval(-kMaxPattern_ppm, kMaxPattern_ppm));
  warp.sigma = ReadCells(map.At("sigma_ppm"), cells, io::Interval(0, kMaxPattern_ppm));
  return warp;
}

std::string WarpText(const DepthWarp& warp, const std::string& comment) {
  const WarpCells& cells = warp.cells;
  return fmt::format(
             "# {}\nformat: {}\nimage: {{width: {}, height: {}}}\n"
             "cells: {{cols: {}, rows: {}}}\n"
             "law: {}  # depth: p is the same at all distances; disparity: that of {} m, and "
             "goes "
             "with the distance\n"
             "# Millionths p by which depth is measured too far, at the middle of each cell, "
             "row "
             "by row.\n",
             comment, kWarpFormat, cells.width, cells.height, cells.cols, cells.rows,
             NameOf(warp.law), kBendDistance_m) +
         CellRows("pattern_ppm", cells, warp.pattern) + "# Their standard deviations.\n" +
         CellRows("sigma_ppm", cells, warp.sigma);
}

}  // namespace slam
