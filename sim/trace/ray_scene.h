#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "sim/shapes/mesh.h"

namespace sim {

/// Rays side by side, from points to directions, world frame. Ray i is cast when far[i] > near[i].
struct RayRow {
  const float *x, *y, *z;     ///< origins, metres
  const float *dx, *dy, *dz;  ///< directions, any length
  const float *near, *far;    ///< in units of the direction
};

/// Eight rays.
struct RayPacket {
  static constexpr int kLanes = 8;
  alignas(32) std::array<float, kLanes> x{}, y{}, z{};     ///< origins, metres
  alignas(32) std::array<float, kLanes> dx{}, dy{}, dz{};  ///< directions, any length
  alignas(32) std::array<float, kLanes> near{};            ///< in units of the direction
  alignas(32) std::array<float, kLanes> far{};

  void Set(int lane, const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
           float from, float to = std::numeric_limits<float>::infinity());
  void Disable(int lane) { far[static_cast<std::size_t>(lane)] = -1.0F; }
  RayRow Row() const {
    return {x.data(),  y.data(),  z.data(),    dx.data(),
            dy.data(), dz.data(), near.data(), far.data()};
  }
};

/// What the lanes hit: triangle index, or kNothing.
struct PacketHits {
  static constexpr int kNothing = -1;
  alignas(32) std::array<int, RayPacket::kLanes> triangle{};
};

/// Rays that were cast, in order.
struct RayLog {
  std::vector<RayPacket> nearest, blocked;
  /// Takes down the packets of a row that hold a ray to cast.
  static void Add(const RayRow& rays, int count, std::vector<RayPacket>& packets);
};

/// Which instructions the ray tracer may use. Its answers at edges differ with them.
enum class InstructionSet {
  kPinned,  ///< AVX2, SSE4.2 where there is none: these two agree
  kSse42,
  kAvx2,
  kAvx512
};

/// Whether this processor has it (and the ray tracer was built for it).
bool HasInstructionSet(InstructionSet set);

/// Triangles to cast rays at (Embree, behind a wall). Queries are const and safe to call from
/// many threads; answers do not depend on threads. The traversal is the fast one: about once in
/// a million rays it slips through the line between two triangles, so whoever needs that line
/// right looks again (SceneEdges). A closed body it cannot pass: there are two sides of it.
class RayScene {
 public:
  /// @throws std::runtime_error when the ray tracer cannot start.
  explicit RayScene(std::span<const Triangle> triangles,
                    InstructionSet set = InstructionSet::kPinned);
  ~RayScene();

  /// Nearest hit of each lane.
  PacketHits Nearest(const RayPacket& rays) const;
  /// The same of a row, a packet at a time.
  /// @param count     a multiple of RayPacket::kLanes
  /// @param triangle  as PacketHits::triangle
  void Nearest(const RayRow& rays, int count, int* triangle) const;
  /// True where anything lies between near and far.
  std::array<bool, RayPacket::kLanes> Blocked(const RayPacket& rays) const;
  /// The same of a row: 1 where anything does, else 0.
  void Blocked(const RayRow& rays, int count, std::uint8_t* blocked) const;
  /// Seconds of processor time that the ray tracer alone takes to cast these rays again, from
  /// packets in its own form: what no renderer on top of it can be faster than.
  double TimeToCast(const RayLog& log) const;

 private:
  struct Embree;
  std::unique_ptr<Embree> embree_;
};

}  // namespace sim
