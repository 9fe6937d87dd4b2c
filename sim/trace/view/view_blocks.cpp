// Blocks of a view in which every pixel shows the same triangle, as its corners tell.
//
// In the image inverse depth is affine on a triangle, and the part of the image that it covers
// ends at its edges. So where no edge passes, hidden ones included, each triangle covers all of a
// convex piece of the image or nothing; and one that is in front of all others at the corners of
// the piece is so everywhere in it. The corners are those of the pixels round the block: what a
// lens bends stays inside. Edges are told from kNear_m in front of the camera on: nothing is nearer.
#include <algorithm>

#include "sim/trace/view/view.h"

namespace sim {
namespace {

constexpr int kSide = EdgeBlocks::kSide;

/// Whether pixels of a column, or row, are at corners of the pixels round blocks.
bool AtCorner(int u) { return u % kSide == 0 || u % kSide == kSide - 1; }

}  // namespace

/// The bare ray tracer is measured on the rays of all pixels.
bool View::CanFill() const {
  return options_.exact_edges && log_ == nullptr &&
         rows_ == cv::Range(0, world_->camera.height);
}

void View::TraceFilling() {
  FindFill();
  std::vector<float>& far = row_.sun_far;  // free still
  for (int j = 0; j < blocks_.rows(); ++j) {
    const int* fill = fill_.data() + blocks_.At(0, j);
    far = row_.view_far;
    const auto for_filled = [&](const auto& work) {
      for (int i = 0; i < blocks_.columns(); ++i) {
        if (fill[i] != kCast) work(i * kSide, fill[i]);
      }
    };
    for_filled([&](int u, int) { std::fill_n(far.begin() + u, kSide, -1.0F); });
    for (int v = j * kSide; v < std::min((j + 1) * kSide, rows_.end); ++v) {
      TraceRow(v, far);
      int* triangles = Triangles(v);
      for_filled([&](int u, int shown) { std::fill_n(triangles + u, kSide, shown); });
    }
  }
}

/// What blocks are to be filled with. Those at the image's border have no pixels round them.
void View::FindFill() {
  fill_.assign(blocks_.At(0, blocks_.rows()), kCast);
  for (int v = 0; v < rows_.end; ++v) {
    if (AtCorner(v)) TraceCorners(v);
  }
  for (int j = 1; (j + 1) * kSide < rows_.end; ++j) {
    const int *above = Triangles(j * kSide - 1), *below = Triangles((j + 1) * kSide);
    for (int i = 1; (i + 1) * kSide < world_->camera.width; ++i) {
      const int left = i * kSide - 1, right = (i + 1) * kSide, shown = above[left];
      const bool same = above[right] == shown && below[left] == shown && below[right] == shown;
      if (same && blocks_.Clear(i, j)) fill_[blocks_.At(i, j)] = shown;
    }
  }
}

void View::TraceCorners(int v) {
  LoadRow(v);
  const int width = world_->camera.width;
  int count = 0;
  for (int u = 0; u < width; ++u) {
    if (!AtCorner(u)) continue;
    row_.x[Index(count)] = row_.x[Index(u)];
    row_.y[Index(count)] = row_.y[Index(u)];
    ++count;
  }
  corners_.resize(stride_);
  TraceLoaded((count + kLanes - 1) / kLanes * kLanes, row_.view_far, corners_.data());
  const int* shown = corners_.data();
  for (int u = 0; u < width; ++u) {
    if (AtCorner(u)) Triangles(v)[u] = *shown++;
  }
}

}  // namespace sim
