#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>

namespace eval::testing {

/// The folder with reference figures and recordings: PAS_SHARED_DIR, else beside the sources.
inline std::filesystem::path SharedFolder() {
  const char* named = std::getenv("PAS_SHARED_DIR");
  return named != nullptr ? std::filesystem::path(named)
                          : std::filesystem::path(PAS_SOURCE_DIR) / "../shared";
}

}  // namespace eval::testing

/// Skips the case, with the reason, where the reference data are not installed.
#define SKIP_WITHOUT(folder)                                                       \
  if (!std::filesystem::exists(folder)) {                                          \
    GTEST_SKIP() << "no reference data at " << (folder) << "; set PAS_SHARED_DIR"; \
  }
