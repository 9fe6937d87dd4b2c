#pragma once

#include <memory>

namespace slam {

/// Memory of ExtractPlanes that is used again from frame to frame; one a thread.
class PlaneWorkspace {
 public:
  struct Memory;
  PlaneWorkspace();
  ~PlaneWorkspace();
  PlaneWorkspace(PlaneWorkspace&&) noexcept;
  PlaneWorkspace& operator=(PlaneWorkspace&&) noexcept;
  Memory& memory() { return *memory_; }

 private:
  std::unique_ptr<Memory> memory_;
};

}  // namespace slam
