#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "sim/trace/frame_renderer.h"
#include "sim/trace/lights.h"
#include "sim/trace/render_world.h"
#include "sim/trace/view/view_facets.h"

namespace sim {

inline constexpr int kLanes = RayPacket::kLanes;  ///< pixels at once

/// What is seen where nothing is.
inline const cv::Vec3f kSky(0.55F, 0.6F, 0.66F);

/// Something else that throws shadows on what a view shows.
struct Blocker {
  const RayScene* rays = nullptr;
  Pose T_bw;  ///< from the frame of the view's world to its own
};

/// Where a world stands among others that move past it.
struct Surroundings {
  Pose T_sw;  ///< from its frame to that of the sun and the lights
  std::vector<Blocker> others;
  /// How many of four rays a pixel hit; 0 or 4 off the edges. Left alone when null, or without
  /// colour.
  cv::Mat1b* coverage = nullptr;
};

/// The work of one Render call. Its memory is kept from one view to the next.
class View {
 public:
  /// @param log  takes down the rays through pixel centres and those from what they hit
  void Render(const RenderWorld& world, const Pose& T_wc, const RenderOptions& options,
              const Surroundings& around, Rendering& out, RayLog* log = nullptr);

 private:
  /// What belongs to one row of pixels, as long as whole packets.
  struct RowArrays {
    std::vector<double> x, y;                      ///< ray (x, y, 1), camera frame
    std::vector<double> dx, dy, dz;                ///< the same, world frame
    std::vector<float> start_x, start_y, start_z;  ///< where second rays begin, world frame
    std::vector<float> to_eye_x, to_eye_y, to_eye_z;
    std::vector<float> sun_far, eye_far;  ///< how far second rays go; negative: none
    std::vector<std::uint8_t> blocked;    ///< of second rays
    std::vector<float> print_u, print_v;  ///< places on the prints
    /// The same in all rows of a view.
    std::vector<float> camera_x, camera_y, camera_z, view_near, view_far;
    std::vector<float> to_sun_x, to_sun_y, to_sun_z, zero;
    void Resize(std::size_t size);
    void FillConstants(std::size_t width, const Eigen::Vector3d& camera_w,
                       const Eigen::Vector3d& to_sun_w);
  };
  /// At most a packet of pixels of one triangle in a row. Their footprints hardly differ: that
  /// of the middle one serves all.
  struct Stretch {
    int first = 0, last = 0;
    int triangle = 0;
    const Texture* print = nullptr;
    TextureFootprint footprint;
  };

  /// One of the four looks at a pixel on an edge.
  struct Look {
    Eigen::Vector3d ray;  ///< (x, y, 1), camera frame
    int triangle = -1;
    double z = 0;
    bool sunlit = false;
    cv::Vec3f lights;               ///< on it, beside the sun's
    std::uint32_t lights_seen = 0;  ///< as in surfaces_ of its pixel; the sun apart
  };
  /// Bits of surfaces_ from here on are those of the lights; below are surface and sun.
  static constexpr int kLightBit = 18;
  static constexpr std::uint32_t kSurfaceBits = (1u << kLightBit) - 2;
  static constexpr int kCast = PacketHits::kNothing - 1;  ///< its pixels need rays

  void Prepare();
  /// Whether anything, of this world or another, is between near and far: as RayScene's.
  void Block(const RayRow& rays, int count, std::uint8_t* blocked) const;
  std::array<bool, RayPacket::kLanes> Blocked(const RayPacket& packet) const;
  void LoadRow(int v);
  void Trace();
  void TraceRow(int v, const std::vector<float>& far);
  void TraceLoaded(int length, const std::vector<float>& far, int* triangles);
  bool CanFill() const;
  void TraceFilling();
  void TraceCorners(int v);
  void FindFill();
  void DecideEdges();
  void DecidePixel(const EdgePixel& edge);
  void RecordRow(int v);
  void RecordSky(int v, int first, int last);
  void RecordRun(int v, int first, int last, const SeenFacet& facet);
  void RecordSensed(int v, int first, int last, const SeenFacet& facet);
  void CastToSun(int v);
  void CastToEye(int v);
  void CastToLights(int v);
  LightAtSpots LightsAt(const Spots& spots) const;
  void PlacePrints(int v);
  void ShadeRow(int v);
  void ShadeRun(int v, const Stretch& stretch);
  /// Place on the print of what the ray (x, y, 1) meets at depth z, metres.
  static std::array<float, 2> PrintAt(const SeenFacet& facet, double x, double y, float z);
  TextureFootprint Footprint(const SeenFacet& facet, const std::array<float, 2>& at, float z);
  float LightOn(const SeenFacet& facet, double x, double y, bool sunlit) const;
  /// What a glossy face adds to the colour of the ray (x, y, 1) that meets it at depth z.
  /// @param surface  as in surfaces_: sun and lights
  cv::Vec3f Mirrored(const SeenFacet& facet, double x, double y, double z,
                     std::uint32_t surface) const;
  Eigen::Vector3d NormalAt(const SeenFacet& facet, double x, double y) const;
  /// Makes what the ray (x, y, 1) meets at depth z one of the places.
  void SetSpot(int lane, const SeenFacet& facet, double x, double y, double z,
               Spots& spots) const;
  void SmoothEdges(int v);
  void MarkEdges(int v, std::vector<int>& columns) const;
  void CastLooks(int v, std::size_t first);
  void SunOnLooks(int v);
  std::optional<bool> SunAround(int u, int v, std::uint32_t surface) const;
  cv::Vec3f MeanOf(std::span<const Look> looks);

  int* Triangles(int v) { return triangles_.data() + Index(v) * stride_; }
  std::uint32_t* Surfaces(int v) { return surfaces_.data() + Index(v) * stride_; }
  const std::uint32_t* Surfaces(int v) const { return surfaces_.data() + Index(v) * stride_; }
  static std::size_t Index(int i) { return static_cast<std::size_t>(i); }

  const RenderWorld* world_ = nullptr;
  Pose T_wc_;
  const Surroundings* around_ = nullptr;
  Eigen::Vector3d to_sun_w_;
  RenderOptions options_;
  cv::Range rows_;  ///< to render
  Rendering* out_ = nullptr;
  RayLog* log_ = nullptr;
  Eigen::Vector3d eye_w_;
  std::size_t stride_ = 0;
  RowArrays row_;
  std::vector<Stretch> stretches_;  ///< the row's
  ViewFacets facets_;
  std::vector<int> triangles_;  ///< what each pixel shows
  /// SeenFacet::surface, + 1 in the sun; then a bit for each light.
  std::vector<std::uint32_t> surfaces_;
  LightPoints lights_;
  std::vector<cv::Vec3f> lights_row_;  ///< light of the lights on a row; empty without lights
  std::vector<EdgePixel> edges_;
  EdgeBlocks blocks_;
  std::vector<int> fill_;     ///< by block: the triangle that all its pixels show, or kCast
  std::vector<int> corners_;  ///< what a row shows at the blocks' corners
  std::vector<std::uint8_t> decided_;  ///< by pixel, while edges are decided
  std::vector<int> on_edge_;           ///< columns of a row
  std::vector<Look> looks_;            ///< four for each of these
};

}  // namespace sim
