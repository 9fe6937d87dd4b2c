#include "sim/write/parallel_frames.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>

namespace sim {

void ForEachFrame(const std::vector<int>& frames, int threads,
                  const std::function<void(int)>& work, const std::function<void(int)>& done) {
  std::atomic<std::size_t> next{0};
  std::atomic<bool> stop{false};
  std::mutex mutex;
  std::exception_ptr error;
  int finished = 0;
  const auto loop = [&] {
    while (!stop) {
      const std::size_t i = next++;
      if (i >= frames.size()) return;
      try {
        work(frames[i]);
        const std::lock_guard lock(mutex);
        ++finished;
        if (done) done(finished);
      } catch (...) {
        const std::lock_guard lock(mutex);
        if (!error) error = std::current_exception();
        stop = true;
      }
    }
  };
  const int cores = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  const int count = std::clamp(threads > 0 ? threads : cores, 1,
                               std::max(1, static_cast<int>(frames.size())));
  std::vector<std::thread> workers;
  try {
    for (int i = 1; i < count; ++i) workers.emplace_back(loop);
  } catch (const std::system_error&) {  // the system allows no more: fewer do the same work
  }
  loop();
  for (std::thread& worker : workers) worker.join();
  if (error) std::rethrow_exception(error);
}

}  // namespace sim
