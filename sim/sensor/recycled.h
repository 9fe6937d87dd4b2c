#pragma once

#include <opencv2/core/mat.hpp>

namespace sim {

/// An image to be written anew: the memory of the last one, unless somebody still holds it.
/// What it holds is left over. For images that are kept per thread.
template <typename Image>
Image& Recycled(Image& kept, const cv::Size& size) {
  if (kept.u != nullptr && kept.u->refcount > 1) kept.release();
  kept.create(size);
  return kept;
}

}  // namespace sim
