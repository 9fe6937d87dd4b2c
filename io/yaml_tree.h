#pragma once

#include <string>
#include <vector>

namespace io {

/// A node of a YAML document as it was written, with the line it stands in.
struct YamlNode {
  enum class Kind { kMissing, kNothing, kScalar, kList, kMapping };
  Kind kind = Kind::kNothing;
  int line = 1;
  std::string text;               ///< the scalar
  bool quoted = false;            ///< it stood in quotes
  std::string key;                ///< its key, if it is in a mapping
  int key_line = 0;               ///< where that stands
  std::vector<YamlNode> entries;  ///< members of a list or mapping, in the order of the file
};

/// The root of a text's only document; kNothing when the text is empty.
/// @throws InputError with file:line for bad syntax, a second document, anchors and aliases,
///   keys that are repeated or no plain text, and nesting without reason
YamlNode ParseYamlTree(const std::string& text, const std::string& file);

}  // namespace io
