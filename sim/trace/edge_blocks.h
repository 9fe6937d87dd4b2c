#pragma once

#include <cstdint>
#include <vector>

#include "sim/camera/camera.h"

namespace sim {

/// Square blocks of an image, and which of them the edges of a view may pass.
class EdgeBlocks {
 public:
  static constexpr int kSide = 8;          ///< pixels
  static constexpr double kStep_px = 2.0;  ///< at most, between marks on an edge

  /// Forgets all marks.
  void Start(const Camera& camera);
  /// An edge passes here.
  void Mark(double u, double v);
  /// Whether all edges stay out of the block and of the pixels round it.
  bool Clear(int column, int row) const { return passed_[At(column, row)] == 0; }
  int columns() const { return columns_; }
  int rows() const { return rows_; }
  std::size_t At(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(column);
  }

 private:
  int columns_ = 0, rows_ = 0;
  std::vector<std::uint8_t> passed_;
};

}  // namespace sim
