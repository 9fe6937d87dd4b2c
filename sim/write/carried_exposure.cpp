#include "sim/write/carried_exposure.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "sim/write/carry_rows.h"

namespace sim {
namespace {

/// What is nearest is looked for in blocks of the image's width over this, and those around:
/// 16 to 32 px of 640; in 30 ms a hand shifts near things against far ones by less.
constexpr int kBlocksAcross = 40;

std::size_t Index(int i) { return static_cast<std::size_t>(i); }

/// Exposes rows from one rendering. Holds the memory of a frame and of a row.
class Carrier {
 public:
  void Start(const Camera& camera, const Rendering& rendering);
  /// @param T_vb, T_ve  from the camera at the begin and at the end of row v's exposure to that
  ///   of the rendering
  void Expose(const FrameRenderer& renderer, const Pose& T_vb, const Pose& T_ve, int v,
              float* radiance);

 private:
  CarriedRow Row() { return {x_.data(), y_.data(), inverse_z_.data(), u_.data(), v_.data()}; }

  TapRow Taps() {
    return {tap_u_.data(), tap_v_.data(), step_u_.data(), step_v_.data(), taps_.data()};
  }

  std::vector<float> lit_;
  LitView view_;
  int block_px_ = 1;
  cv::Mat1f nearest_;  ///< inverse depth, 1/m, of the nearest thing in each block and around
  std::vector<double> x_, y_, inverse_z_, u_, v_, end_u_, end_v_;
  std::vector<std::int32_t> tap_u_, tap_v_, step_u_, step_v_, taps_;
};

void Carrier::Start(const Camera& camera, const Rendering& rendering) {
  const std::size_t width = Index(camera.width);
  for (auto* row : {&x_, &y_, &inverse_z_, &u_, &v_, &end_u_, &end_v_}) row->resize(width);
  for (auto* row : {&tap_u_, &tap_v_, &step_u_, &step_v_, &taps_}) row->resize(width);
  view_ = {nullptr, camera.width, camera.height};
  lit_.resize(Index(view_.Stride()) * Index(camera.height + 1));
  view_.pixels = lit_.data();
  block_px_ = (camera.width + kBlocksAcross - 1) / kBlocksAcross;
  nearest_.create((camera.height + block_px_ - 1) / block_px_, kBlocksAcross);
  nearest_ = 0.0F;
  for (int v = 0; v <= camera.height; ++v) {
    const int seen = std::min(v, camera.height - 1);
    float* lit = lit_.data() + Index(view_.Stride()) * Index(v);
    LightRow(rendering.radiance.ptr<float>(seen), rendering.depth_m[seen], camera.width, lit);
    RaiseBlocks(lit, camera.width, block_px_, nearest_[seen / block_px_]);
  }
  cv::dilate(nearest_, nearest_, cv::Mat());
}

void Carrier::Expose(const FrameRenderer& renderer, const Pose& T_vb, const Pose& T_ve, int v,
                     float* radiance) {
  const Camera& camera = renderer.camera();
  const Pose middle{0.5 * (T_vb.R + T_ve.R), 0.5 * (T_vb.t + T_ve.t)};
  renderer.image_rays().Row(v, x_.data(), y_.data());
  // Which point a pixel sees: what the view shows where the nearest thing around would be, or
  // where that would be itself. The nearer of the two hides the other.
  for (int u = 0; u < camera.width; ++u) {
    inverse_z_[Index(u)] = nearest_(v / block_px_, u / block_px_);
  }
  CarryRow(middle, camera, Row());
  std::fill(inverse_z_.begin(), inverse_z_.end(), 0.0);
  LookNearer(view_, middle, Row());
  CarryRow(middle, camera, Row());
  LookNearer(view_, middle, Row());

  // Where the view shows that point at the begin and at the end of the exposure.
  CarriedRow end = Row();
  end.u = end_u_.data(), end.v = end_v_.data();
  CarryRow(T_vb, camera, Row());
  CarryRow(T_ve, camera, end);

  PlaceTaps(u_.data(), v_.data(), end_u_.data(), end_v_.data(), camera.width, Taps());
  MeanOfTaps(view_, Taps(), radiance);
}

}  // namespace

bool CanCarry(const FrameRenderer& renderer) {
  const auto& objects = renderer.scene().objects;
  return std::none_of(objects.begin(), objects.end(),
                      [](const Object& object) { return !object.way.empty(); });
}

void CarryExposure(const FrameRenderer& renderer, const Exposure& exposure,
                   const PoseAround& around, const Pose& T_wc, Rendering& rendering) {
  thread_local Carrier carrier;  // memory only
  carrier.Start(renderer.camera(), rendering);
  const Pose T_vw = Inverse(T_wc);
  const int height = renderer.camera().height;
  const double half_s = 0.5 * exposure.shutter_s;
  for (int v = 0; v < height; ++v) {
    const double row_s = RowTime_s(exposure, v, height);
    carrier.Expose(renderer, T_vw * around(row_s - half_s), T_vw * around(row_s + half_s), v,
                   rendering.radiance.ptr<float>(v));
  }
}

}  // namespace sim
