#pragma once

#include <condition_variable>
#include <mutex>

namespace slam {

/// Access to a map that tracking and mapping share: one of them at a time, and tracking goes
/// first, so that it never waits for more than the piece of work in hand.
class MapGate {
 public:
  void EnterTracking() {
    std::unique_lock lock(mutex_);
    tracking_waits_ = true;
    changed_.wait(lock, [&] { return !taken_; });
    tracking_waits_ = false;
    taken_ = true;
  }

  void EnterMapping() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return !taken_ && !tracking_waits_; });
    taken_ = true;
  }

  void Leave() {
    {
      const std::lock_guard lock(mutex_);
      taken_ = false;
    }
    changed_.notify_all();
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  bool taken_ = false, tracking_waits_ = false;
};

/// Keeps the map for tracking while it lives; nothing without a gate.
class TrackingHold {
 public:
  explicit TrackingHold(MapGate* gate) : gate_(gate) {
    if (gate_) gate_->EnterTracking();
  }
  ~TrackingHold() {
    if (gate_) gate_->Leave();
  }
  TrackingHold(const TrackingHold&) = delete;
  TrackingHold& operator=(const TrackingHold&) = delete;

 private:
  MapGate* gate_;
};

/// Keeps the map for mapping while it lives.
class MappingHold {
 public:
  explicit MappingHold(MapGate& gate) : gate_(gate) { gate_.EnterMapping(); }
  ~MappingHold() { gate_.Leave(); }
  MappingHold(const MappingHold&) = delete;
  MappingHold& operator=(const MappingHold&) = delete;

 private:
  MapGate& gate_;
};

}  // namespace slam
