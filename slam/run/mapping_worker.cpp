#include "slam/run/mapping_worker.h"

#include <utility>

namespace slam {

MappingWorker::MappingWorker(std::function<void(int)> work, std::size_t max_waiting)
    : work_(std::move(work)), max_waiting_(max_waiting), thread_([this] { Run(); }) {}

MappingWorker::~MappingWorker() { End(Waiting::kDrop); }

void MappingWorker::Run() {
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [&] { return ending_ || !waiting_.empty(); });
    if (waiting_.empty()) return;
    const int keyframe = waiting_.front();
    waiting_.pop_front();
    lock.unlock();
    std::exception_ptr failure;
    try {
      work_(keyframe);
    } catch (...) {
      failure = std::current_exception();
    }
    lock.lock();
    if (failure) {
      failure_ = failure;
      return;
    }
  }
}

void MappingWorker::Submit(int keyframe) {
  Check();
  {
    const std::lock_guard lock(mutex_);
    waiting_.push_back(keyframe);
    if (waiting_.size() > max_waiting_) {
      waiting_.pop_front();
      ++dropped_;
    }
  }
  changed_.notify_all();
}

void MappingWorker::Check() {
  std::exception_ptr failure;
  {
    const std::lock_guard lock(mutex_);
    std::swap(failure, failure_);
  }
  if (failure) std::rethrow_exception(failure);
}

void MappingWorker::Finish(Waiting waiting) {
  End(waiting);
  Check();
}

void MappingWorker::End(Waiting waiting) {
  {
    const std::lock_guard lock(mutex_);
    if (waiting == Waiting::kDrop) {
      dropped_ += static_cast<int>(waiting_.size());
      waiting_.clear();
    }
    ending_ = true;
  }
  changed_.notify_all();
  if (thread_.joinable()) thread_.join();
}

int MappingWorker::dropped() const {
  const std::lock_guard lock(mutex_);
  return dropped_;
}

}  // namespace slam
