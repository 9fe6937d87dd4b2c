#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

namespace test_support {

/// The folder with reference figures and recordings: PAS_SHARED_DIR, else beside the sources.
inline std::filesystem::path SharedFolder() {
  const char* named = std::getenv("PAS_SHARED_DIR");
  return named != nullptr ? std::filesystem::path(named)
                          : std::filesystem::path(PAS_SOURCE_DIR) / "../shared";
}

/// The first 37 frames of TUM's fr1/xyz, with the truth of the whole recording.
inline std::filesystem::path TumRecording() {
  return SharedFolder() / "data/tum_fr1_xyz_first37";
}

}  // namespace test_support

/// Skips the case, with the reason, where the reference data are not installed.
#define SKIP_WITHOUT(folder)                                                       \
  if (!std::filesystem::exists(folder)) {                                          \
    GTEST_SKIP() << "no reference data at " << (folder) << "; set PAS_SHARED_DIR"; \
  }
