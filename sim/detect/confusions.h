#pragma once

#include <span>
#include <string>

namespace sim {

/// Classes that a detector takes the class for, most likely first; never empty, never itself.
std::span<const char* const> ConfusedWith(const std::string& class_name);

/// Classes of boxes reported where nothing is.
std::span<const char* const> PhantomClasses();

}  // namespace sim
