#include "sim/trace/ray_scene.h"

#include <embree3/rtcore.h>
#include <time.h>

#include <algorithm>
#include <cstring>
#include <map>
#include <mutex>
#include <stdexcept>
#include <string>

#include "sim/trace/lanes.h"

namespace sim {
namespace {

const char* NameOf(InstructionSet set) {
  switch (set) {
    case InstructionSet::kSse42:
      return "sse4.2";
    case InstructionSet::kAvx2:
      return "avx2";
    case InstructionSet::kAvx512:
      return "avx512";
    case InstructionSet::kPinned:
      break;
  }
  __builtin_cpu_init();
  return __builtin_cpu_supports("avx2") ? "avx2" : "sse4.2";
}

/// One device a process and instruction set: it holds no state that a query could change.
RTCDevice SharedDevice(InstructionSet set) {
  struct Device {
    RTCDevice handle;
    explicit Device(InstructionSet wanted)
        : handle(rtcNewDevice(
              (std::string("isa=") + NameOf(wanted) + ",threads=1,set_affinity=0").c_str())) {}
    ~Device() {
      if (handle != nullptr) rtcReleaseDevice(handle);
    }
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;
  };
  static std::mutex mutex;
  static std::map<std::string, Device> devices;
  const std::lock_guard lock(mutex);
  const Device& device = devices.try_emplace(NameOf(set), set).first->second;
  if (device.handle == nullptr) {
    throw std::runtime_error("the ray tracer (Embree) does not start; it needs SSE4.2 or AVX2");
  }
  return device.handle;
}

/// What all rays have in common. The ray tracer leaves it alone.
void FillConstants(RTCRay8& rays) {
  for (unsigned i = 0; i < RayPacket::kLanes; ++i) {
    rays.time[i] = 0.0F;
    rays.mask[i] = ~0U;
    rays.id[i] = i;
    rays.flags[i] = 0;
  }
}

/// Fills the rest with the packet from `first` on. @returns whether any lane is cast
SIM_LANES bool CopyRays(const RayRow& rays, int first, RTCRay8& out, int* valid) {
  constexpr std::size_t kBytes = sizeof out.org_x;
  std::memcpy(out.org_x, rays.x + first, kBytes);
  std::memcpy(out.org_y, rays.y + first, kBytes);
  std::memcpy(out.org_z, rays.z + first, kBytes);
  std::memcpy(out.dir_x, rays.dx + first, kBytes);
  std::memcpy(out.dir_y, rays.dy + first, kBytes);
  std::memcpy(out.dir_z, rays.dz + first, kBytes);
  std::memcpy(out.tnear, rays.near + first, kBytes);
  std::memcpy(out.tfar, rays.far + first, kBytes);
  int any = 0;
  for (int i = 0; i < RayPacket::kLanes; ++i) {
    valid[i] = rays.far[first + i] > rays.near[first + i] ? -1 : 0;
    any |= valid[i];
  }
  return any != 0;
}

SIM_LANES void ForgetHits(RTCHit8& hits) {
  for (auto& id : hits.geomID) id = RTC_INVALID_GEOMETRY_ID;
}

SIM_LANES void ReadHits(const RTCHit8& hits, const int* valid, int* triangle) {
  for (int i = 0; i < RayPacket::kLanes; ++i) {
    const bool hit = (valid[i] != 0) & (hits.geomID[i] != RTC_INVALID_GEOMETRY_ID);
    triangle[i] = hit ? static_cast<int>(hits.primID[i]) : PacketHits::kNothing;
  }
}

SIM_LANES void ReadBlocked(const RTCRay8& rays, const int* valid, std::uint8_t* blocked) {
  for (int i = 0; i < RayPacket::kLanes; ++i) {
    blocked[i] = ((valid[i] != 0) & (rays.tfar[i] < 0.0F)) ? 1 : 0;  // Embree writes -inf
  }
}

RTCIntersectContext CoherentContext() {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  return context;
}

}  // namespace

struct RayScene::Embree {
  RTCScene scene = nullptr;
  ~Embree() {
    if (scene != nullptr) rtcReleaseScene(scene);
  }
};

void RayPacket::Set(int lane, const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
                    float from, float to) {
  const auto i = static_cast<std::size_t>(lane);
  x[i] = static_cast<float>(origin.x());
  y[i] = static_cast<float>(origin.y());
  z[i] = static_cast<float>(origin.z());
  dx[i] = static_cast<float>(direction.x());
  dy[i] = static_cast<float>(direction.y());
  dz[i] = static_cast<float>(direction.z());
  near[i] = from;
  far[i] = to;
}

bool HasInstructionSet(InstructionSet set) {
  __builtin_cpu_init();
  switch (set) {
    case InstructionSet::kAvx2:
      return __builtin_cpu_supports("avx2");
    case InstructionSet::kAvx512:
      return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
             __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl") &&
             __builtin_cpu_supports("avx512cd");
    case InstructionSet::kSse42:
    case InstructionSet::kPinned:
      break;
  }
  return __builtin_cpu_supports("sse4.2");
}

RayScene::RayScene(std::span<const Triangle> triangles, InstructionSet set)
    : embree_(std::make_unique<Embree>()) {
  const RTCDevice device = SharedDevice(set);
  embree_->scene = rtcNewScene(device);
  rtcSetSceneFlags(embree_->scene, RTC_SCENE_FLAG_NONE);
  rtcSetSceneBuildQuality(embree_->scene, RTC_BUILD_QUALITY_HIGH);
  if (!triangles.empty()) {
    const RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* corners = static_cast<float*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                3 * sizeof(float), 3 * triangles.size()));
    auto* indices = static_cast<unsigned*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                3 * sizeof(unsigned), triangles.size()));
    if (corners == nullptr || indices == nullptr) throw std::bad_alloc();
    unsigned next = 0;
    for (const Triangle& triangle : triangles) {
      for (const Eigen::Vector3d& corner : triangle.corners_w) {
        for (int axis = 0; axis < 3; ++axis) *corners++ = static_cast<float>(corner[axis]);
        *indices++ = next++;
      }
    }
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(embree_->scene, geometry);
    rtcReleaseGeometry(geometry);
  }
  rtcCommitScene(embree_->scene);
  if (rtcGetDeviceError(device) != RTC_ERROR_NONE) {
    throw std::runtime_error("the ray tracer (Embree) cannot build the scene");
  }
}

RayScene::~RayScene() = default;

void RayScene::Nearest(const RayRow& rays, int count, int* triangle) const {
  RTCRayHit8 query;
  FillConstants(query.ray);
  RTCIntersectContext context = CoherentContext();
  alignas(32) int valid[RayPacket::kLanes];
  for (int first = 0; first < count; first += RayPacket::kLanes) {
    ForgetHits(query.hit);
    if (CopyRays(rays, first, query.ray, valid)) {
      rtcIntersect8(valid, embree_->scene, &context, &query);
    }
    ReadHits(query.hit, valid, triangle + first);
  }
}

PacketHits RayScene::Nearest(const RayPacket& rays) const {
  PacketHits hits;
  Nearest(rays.Row(), RayPacket::kLanes, hits.triangle.data());
  return hits;
}

void RayScene::Blocked(const RayRow& rays, int count, std::uint8_t* blocked) const {
  RTCRay8 query;
  FillConstants(query);
  RTCIntersectContext context = CoherentContext();
  alignas(32) int valid[RayPacket::kLanes];
  for (int first = 0; first < count; first += RayPacket::kLanes) {
    if (CopyRays(rays, first, query, valid)) {
      rtcOccluded8(valid, embree_->scene, &context, &query);
    }
    ReadBlocked(query, valid, blocked + first);
  }
}

std::array<bool, RayPacket::kLanes> RayScene::Blocked(const RayPacket& rays) const {
  std::array<std::uint8_t, RayPacket::kLanes> found;
  Blocked(rays.Row(), RayPacket::kLanes, found.data());
  std::array<bool, RayPacket::kLanes> blocked{};
  std::copy(found.begin(), found.end(), blocked.begin());
  return blocked;
}

void RayLog::Add(const RayRow& rays, int count, std::vector<RayPacket>& packets) {
  for (int first = 0; first < count; first += RayPacket::kLanes) {
    RayPacket packet;
    const auto copy = [&](const float* from, auto& to) {
      std::copy_n(from + first, to.size(), to.begin());
    };
    copy(rays.x, packet.x), copy(rays.y, packet.y), copy(rays.z, packet.z);
    copy(rays.dx, packet.dx), copy(rays.dy, packet.dy), copy(rays.dz, packet.dz);
    copy(rays.near, packet.near), copy(rays.far, packet.far);
    if (std::any_of(packet.far.begin(), packet.far.end(), [](float far) { return far >= 0; })) {
      packets.push_back(packet);
    }
  }
}

namespace {

double ThreadSeconds() {
  timespec now{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// A packet in the ray tracer's own form.
template <typename Query>
struct Prepared {
  Query query;
  alignas(32) int valid[RayPacket::kLanes];
};

constexpr std::size_t kAtOnce = 64;  ///< packets that stay in the processor's cache

/// Time of cast(packet) for all packets, without the time of making them.
template <typename Query, typename Fill, typename Cast>
double TimeOf(const std::vector<RayPacket>& packets, const Fill& fill, const Cast& cast) {
  std::vector<Prepared<Query>> batch(kAtOnce);
  double seconds = 0;
  for (std::size_t first = 0; first < packets.size(); first += kAtOnce) {
    const std::size_t count = std::min(kAtOnce, packets.size() - first);
    for (std::size_t i = 0; i < count; ++i) fill(packets[first + i], batch[i]);
    const double start = ThreadSeconds();
    for (std::size_t i = 0; i < count; ++i) cast(batch[i]);
    seconds += ThreadSeconds() - start;
  }
  return seconds;
}

}  // namespace

double RayScene::TimeToCast(const RayLog& log) const {
  RTCIntersectContext context = CoherentContext();
  const RTCScene scene = embree_->scene;
  const double nearest = TimeOf<RTCRayHit8>(
      log.nearest,
      [](const RayPacket& rays, Prepared<RTCRayHit8>& to) {
        FillConstants(to.query.ray);
        CopyRays(rays.Row(), 0, to.query.ray, to.valid);
        ForgetHits(to.query.hit);
      },
      [&](Prepared<RTCRayHit8>& to) { rtcIntersect8(to.valid, scene, &context, &to.query); });
  const double blocked = TimeOf<RTCRay8>(
      log.blocked,
      [](const RayPacket& rays, Prepared<RTCRay8>& to) {
        FillConstants(to.query);
        CopyRays(rays.Row(), 0, to.query, to.valid);
      },
      [&](Prepared<RTCRay8>& to) { rtcOccluded8(to.valid, scene, &context, &to.query); });
  return nearest + blocked;
}

}  // namespace sim
