#pragma once

#include <Eigen/Core>
#include <array>
#include <filesystem>
#include <string>
#include <vector>

namespace sim {

/// Triangles as a file has them: its own units and axes; corners are not shared yet.
struct ModelFile {
  std::vector<std::array<Eigen::Vector3d, 3>> triangles;
  std::vector<int> colour_of;                  ///< by triangle
  std::vector<std::array<double, 3>> colours;  ///< diffuse, linear RGB
  std::string sha256;  ///< hash of the file's bytes, followed by those of the files it names
};

/// @throws InputError when it cannot be read, is larger than 64 MiB, or has no triangles
ModelFile ReadModelFile(const std::filesystem::path& path);

}  // namespace sim
