#pragma once

#include <string>
#include <vector>

namespace io {

/// The known word that is spelt nearly as `word`, but for a third of its letters; or an empty
/// one.
std::string NearestWord(const std::string& word, const std::vector<std::string>& known);

}  // namespace io
