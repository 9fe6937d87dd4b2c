#include "sim/detect/confusions.h"

#include <array>
#include <utility>

namespace sim {

std::span<const char* const> ConfusedWith(const std::string& class_name) {
  using List = std::array<const char*, 2>;
  static constexpr std::array<std::pair<const char*, List>, 10> kTable{{
      {"book", {"cell phone", "laptop"}},
      {"keyboard", {"remote", "laptop"}},
      {"tv", {"laptop", "microwave"}},
      {"laptop", {"tv", "keyboard"}},
      {"cell phone", {"remote", "book"}},
      {"remote", {"cell phone", "keyboard"}},
      {"mouse", {"remote", "cell phone"}},
      {"teddy bear", {"dog", "person"}},
      {"potted plant", {"vase", "broccoli"}},
      {"suitcase", {"backpack", "handbag"}},
  }};
  static constexpr List kAnyOther{"book", "suitcase"};
  for (const auto& [name, confused] : kTable) {
    if (class_name == name) return confused;
  }
  return kAnyOther;
}

std::span<const char* const> PhantomClasses() {
  static constexpr std::array<const char*, 5> kClasses{"book", "mouse", "cell phone", "remote",
                                                       "clock"};
  return kClasses;
}

}  // namespace sim
