#include "sim/trace/prints/baked_print.h"

#include <algorithm>

namespace sim {
namespace {

constexpr int kBandRows = 16;

}  // namespace

void BakedPrint::Include(const Eigen::Vector2d& uv) {
  low_ = low_.cwiseMin(uv);
  high_ = high_.cwiseMax(uv);
}

const Texture& BakedPrint::Get(double texel_m, int max_texels) {
  if (!ready_.load(std::memory_order_acquire)) {
    {
      const std::lock_guard lock(mutex_);
      const bool plain = material_.print == Print::kPlain;
      if (!texture_) {
        texture_.emplace(material_, low_, high_ - low_, texel_m, plain ? 1 : max_texels);
      }
    }
    Help();
  }
  return *texture_;
}

/// Takes bands of rows until none is left, then waits for the others. All memory is there:
/// nothing throws, so nobody waits in vain.
void BakedPrint::Help() {
  int baked = 0;
  const int rows = texture_->rows();
  for (int first = next_row_.fetch_add(kBandRows); first < rows;
       first = next_row_.fetch_add(kBandRows)) {
    const int last = std::min(first + kBandRows, rows);
    texture_->BakeRows(first, last);
    baked += last - first;
  }
  std::unique_lock lock(mutex_);
  baked_rows_ += baked;
  if (baked > 0 && baked_rows_ == rows) {
    texture_->Finish();
    ready_.store(true, std::memory_order_release);
    became_ready_.notify_all();
  }
  became_ready_.wait(lock, [&] { return ready_.load(std::memory_order_relaxed); });
}

}  // namespace sim
