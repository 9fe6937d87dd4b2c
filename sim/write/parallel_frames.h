#pragma once

#include <functional>
#include <vector>

namespace sim {

/// Calls work(frame) once for each frame, on `threads` threads (0: one a core) or as many as the
/// system allows, each taking the next frame that is left; `done(count)` follows each finished
/// frame, one call at a time.
/// When a call throws, the others finish their frame, no new one starts, and it is thrown again
/// here.
void ForEachFrame(const std::vector<int>& frames, int threads,
                  const std::function<void(int)>& work, const std::function<void(int)>& done);

}  // namespace sim
