#pragma once

#include <atomic>
#include <condition_variable>
#include <mutex>
#include <optional>

#include "sim/trace/prints/texture.h"

namespace sim {

/// A print that is baked when it is first looked at. Who asks for it meanwhile helps.
class BakedPrint {
 public:
  explicit BakedPrint(const Material& material) : material_(material) {}
  /// Before the first look: the print must hold this place, metres.
  void Include(const Eigen::Vector2d& uv);
  /// Safe to call from many threads; the same texture whatever their number.
  /// @param texel_m, max_texels  as Texture's; those of the first call count
  const Texture& Get(double texel_m, int max_texels);

 private:
  void Help();

  Material material_;
  Eigen::Vector2d low_ = Eigen::Vector2d::Constant(1e9);
  Eigen::Vector2d high_ = Eigen::Vector2d::Constant(-1e9);
  std::optional<Texture> texture_;
  std::atomic<int> next_row_{0};  ///< that nobody bakes yet
  std::atomic<bool> ready_{false};
  std::mutex mutex_;
  std::condition_variable became_ready_;
  int baked_rows_ = 0;
};

}  // namespace sim
