#pragma once

#include <Eigen/Core>
#include <array>
#include <filesystem>
#include <string>
#include <vector>

namespace sim {

inline constexpr double kMinSize_m = 1e-5, kMaxSize_m = 50;  ///< lengths of a body's sides

/// How a mesh of the user's own is read.
struct ModelOptions {
  std::string file;   ///< as the scene names it, relative to the scene file
  double scale = 1;   ///< metres a unit of the file
  bool flip = false;  ///< the file turns its triangles inside out
  /// Triangles belong to one plane when all their corners lie within this of it.
  double flatness_m = 2e-4;
  double min_plane_m2 = 4e-4;  ///< smaller flat parts have no plane
  double open_edges =
      0;  ///< share of edges that may lack their second triangle, or have a third
  /// Outlines of the planes, in the coordinates of the file; empty: planes are looked for.
  std::vector<std::vector<Eigen::Vector3d>> declared;
};

/// A flat part of a mesh, in the object's frame o. n . x + d = 0, n outwards.
struct ModelPlane {
  Eigen::Vector3d n_o = Eigen::Vector3d::UnitZ();
  double d = 0;
  double area_m2 = 0;                                 ///< without its holes
  std::vector<Eigen::Vector3d> outline_o;             ///< counter-clockwise seen from the front
  std::vector<std::vector<Eigen::Vector3d>> holes_o;  ///< clockwise
};

/// A mesh of the user's own. Frame o: the file's axes, metres, origin in the middle of its box.
struct Model {
  ModelOptions options;
  std::string sha256;  ///< hash of the mesh file, followed by the files it names
  Eigen::Vector3d middle_f =
      Eigen::Vector3d::Zero();  ///< middle of its box, from the file's origin, metres
  Eigen::Vector3d size = Eigen::Vector3d::Zero();  ///< lengths of its box, metres
  std::vector<Eigen::Vector3d> vertices_o;
  std::vector<std::array<int, 3>> triangles;   ///< counter-clockwise seen from outside
  std::vector<int> plane_of;                   ///< by triangle: index into planes, -1 = none
  std::vector<int> colour_of;                  ///< by triangle: index into colours
  std::vector<std::array<double, 3>> colours;  ///< diffuse, linear RGB
  std::vector<ModelPlane> planes;  ///< by their largest triangle, largest first; or as declared
};

/// Reads a mesh (OBJ, PLY, STL, glTF ... by Assimp) and finds its planes.
/// @param folder  what options.file is relative to
/// @throws InputError for a file that cannot be read or has no triangles, coordinates that are
///   not finite, more than options.open_edges of bad edges, a mesh that is inside out, and a
///   declared plane without triangles; the message begins with the file's path
Model ReadModel(const ModelOptions& options, const std::filesystem::path& folder);

}  // namespace sim
