#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>

namespace slam {

/// A thread that maps keyframes one after the other, in the order in which they came. Whoever
/// gives them never waits: when more than `max_waiting` wait, the oldest of these is dropped
/// (it stays in the map as it is, and its neighbours' mapping reaches it).
///
/// What the work throws ends the thread and is thrown again to the giver by the next call.
class MappingWorker {
 public:
  MappingWorker(std::function<void(int keyframe)> work, std::size_t max_waiting);
  /// Drops what waits; the work in hand is finished first.
  ~MappingWorker();
  MappingWorker(const MappingWorker&) = delete;
  MappingWorker& operator=(const MappingWorker&) = delete;

  void Submit(int keyframe);
  /// Throws what the work threw, once; otherwise does nothing.
  void Check();

  enum class Waiting { kDo, kDrop };
  /// Ends the thread, after all or none of what waits. Later calls change nothing.
  void Finish(Waiting waiting);

  int dropped() const;

 private:
  void Run();
  void End(Waiting waiting);

  std::function<void(int)> work_;
  std::size_t max_waiting_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<int> waiting_;
  bool ending_ = false;
  int dropped_ = 0;
  std::exception_ptr failure_;
  std::thread thread_;  ///< last: it uses the rest
};

}  // namespace slam
