// Counts what the whole program asks the heap for.
#include <gtest/gtest.h>

#include <atomic>
#include <cerrno>
#include <cmath>
#include <cstddef>
#include <vector>

#include "slam/segment/plane_segments.h"
#include "tests/support/closed_form_depth.h"

// With glibc one's own malloc stands in for the library's; sanitizers have theirs.
#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define PAS_COUNTS_ALLOCATIONS 1
#else
#define PAS_COUNTS_ALLOCATIONS 0
#endif
#if defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer) || \
    __has_feature(memory_sanitizer)
#undef PAS_COUNTS_ALLOCATIONS
#define PAS_COUNTS_ALLOCATIONS 0
#endif
#endif

namespace {
std::atomic<long> allocation_count{0};
}  // namespace

#if PAS_COUNTS_ALLOCATIONS
extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* old, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);

void* malloc(std::size_t size) {
  ++allocation_count;
  return __libc_malloc(size);
}
void* calloc(std::size_t count, std::size_t size) {
  ++allocation_count;
  return __libc_calloc(count, size);
}
void* realloc(void* old, std::size_t size) {
  ++allocation_count;
  return __libc_realloc(old, size);
}
void* memalign(std::size_t alignment, std::size_t size) {
  ++allocation_count;
  return __libc_memalign(alignment, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) {
  ++allocation_count;
  return __libc_memalign(alignment, size);
}
int posix_memalign(void** out, std::size_t alignment, std::size_t size) {
  ++allocation_count;
  *out = __libc_memalign(alignment, size);
  return *out != nullptr ? 0 : ENOMEM;
}
}
#endif

namespace slam {
namespace {

/// A desk with books, one hidden in part by another, bent by a sensor's warp or not.
cv::Mat1f DeskWithBooks(const Camera& camera, int books, double warp_m) {
  closed_form::World world = closed_form::Desk();
  for (int k = 0; k < books; ++k)
    closed_form::PutOnDesk(world, 0.15 * k - 0.2, 0.04 * k, {0.12, 0.17, 0.02 + 0.03 * k},
                           0.4 * k, "book");
  const Pose T_cw = closed_form::LookAt({0.05, -0.6, 0.6}, {0, 0, 0});
  cv::Mat1f depth_m = closed_form::AddKinectNoise(
      closed_form::Render(world, camera, T_cw).depth_m, 3u + static_cast<unsigned>(books));
  for (int v = 0; v < depth_m.rows; ++v) {
    for (int u = 0; u < depth_m.cols; ++u) {
      if (depth_m(v, u) > 0.0f)
        depth_m(v, u) += static_cast<float>(warp_m * std::sin(0.05 * u) * std::sin(0.04 * v));
    }
  }
  return depth_m;
}

TEST(PlaneExtractor, AsksForNoMemoryOnceItIsWarm) {
  if (!PAS_COUNTS_ALLOCATIONS) GTEST_SKIP() << "this build's heap cannot be watched";
  const Camera camera;
  const std::vector<cv::Mat1f> images{
      DeskWithBooks(camera, 4, 0.0), DeskWithBooks(camera, 1, 0.0),
      DeskWithBooks(camera, 3, 0.006), DeskWithBooks(camera, 5, 0.0)};
  PlaneExtractor extractor(camera, PixelRays(camera), {}, {});
  Frame frame;
  constexpr int kPasses = 4;
  for (int pass = 0; pass < kPasses; ++pass) {
    for (std::size_t k = 0; k < images.size(); ++k) {
      frame.depth_m = images[k];
      const long before = allocation_count;
      extractor.Extract(frame);
      const long asked = allocation_count - before;
      EXPECT_GE(frame.planes.size(), 2u);
      if (pass == 0 && k == 0) {
        EXPECT_GT(asked, 100) << "nothing is counted";
      }
      if (pass + 1 == kPasses) {
        EXPECT_EQ(asked, 0) << "image " << k;
      }
    }
  }
}

}  // namespace
}  // namespace slam
