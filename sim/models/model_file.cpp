#include "sim/models/model_file.h"

#include <assimp/DefaultIOSystem.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <cmath>
#include <set>

#include "io/input_error.h"
#include "io/read_file.h"
#include "io/sha256.h"
#include "sim/models/loops.h"

namespace sim {
namespace {

constexpr std::uintmax_t kMaxBytes = 64u << 20;

/// Notes what a mesh file makes the reader open: material libraries, buffers.
class NotingFiles : public Assimp::DefaultIOSystem {
 public:
  explicit NotingFiles(std::vector<std::string>& opened) : opened_(opened) {}
  /// Without opening it, as Assimp does: a pipe would wait for its writer.
  bool Exists(const char* file) const override {
    std::error_code ignored;
    return std::filesystem::is_regular_file(file, ignored);
  }
  Assimp::IOStream* Open(const char* file, const char* mode) override {
    if (!Exists(file)) return nullptr;
    Assimp::IOStream* stream = DefaultIOSystem::Open(file, mode);
    if (stream != nullptr) opened_.emplace_back(file);
    return stream;
  }

 private:
  std::vector<std::string>& opened_;
};

/// The file first, then each other one once, in the order of their names.
std::string HashOf(const std::filesystem::path& path, const std::vector<std::string>& opened) {
  std::string bytes = io::ReadFile(path);
  for (const std::string& other : std::set<std::string>(opened.begin(), opened.end())) {
    std::error_code ignored;
    const bool file = std::filesystem::is_regular_file(other, ignored);
    if (file && !std::filesystem::equivalent(other, path, ignored))
      bytes += io::ReadFile(other);
  }
  return io::Sha256Hex(bytes);
}

std::array<double, 3> ColourOf(const aiMaterial& material) {
  aiColor3D diffuse(0.6F, 0.6F, 0.6F);
  material.Get(AI_MATKEY_COLOR_DIFFUSE, diffuse);
  std::array<double, 3> colour{};
  for (unsigned i = 0; i < 3; ++i) {
    const double part = std::round(static_cast<double>(diffuse[i]) * 1e6) / 1e6;
    colour[i] = part > 0 ? std::min(part, 1.0) : 0;
  }
  return colour;
}

void AddTriangles(const aiMesh& mesh, ModelFile& file) {
  for (unsigned i = 0; i < mesh.mNumFaces; ++i) {
    const aiFace& face = mesh.mFaces[i];
    if (face.mNumIndices < 3) continue;  // points and lines
    std::vector<Eigen::Vector3d> polygon;
    for (unsigned k = 0; k < face.mNumIndices; ++k) {
      const aiVector3D& x = mesh.mVertices[face.mIndices[k]];
      polygon.push_back(Eigen::Vector3f(x.x, x.y, x.z).cast<double>());
    }
    for (const auto& [a, b, c] : Triangulated(polygon)) {
      file.triangles.push_back({polygon[a], polygon[b], polygon[c]});
      file.colour_of.push_back(static_cast<int>(mesh.mMaterialIndex));
    }
  }
}

}  // namespace

ModelFile ReadModelFile(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) {
    throw io::InputError(path.string(),
                         "is not there; `mesh` names a file relative to the scene file");
  }
  if (std::filesystem::file_size(path, error) > kMaxBytes || error) {
    throw io::InputError(path.string(),
                         "cannot be read or is larger than 64 MiB; simplify the mesh");
  }
  std::vector<std::string> opened;
  Assimp::Importer importer;
  importer.SetIOHandler(new NotingFiles(opened));  // the importer owns it
  // Its own triangulation folds some polygons that are not convex.
  const aiScene* scene = importer.ReadFile(path.string(), aiProcess_PreTransformVertices);
  if (scene == nullptr) {
    throw io::InputError(path.string(), std::string("is no mesh that can be read: ") +
                                            importer.GetErrorString());
  }
  ModelFile file;
  for (unsigned i = 0; i < scene->mNumMaterials; ++i) {
    file.colours.push_back(ColourOf(*scene->mMaterials[i]));
  }
  for (unsigned i = 0; i < scene->mNumMeshes; ++i) AddTriangles(*scene->mMeshes[i], file);
  if (file.triangles.empty()) {
    throw io::InputError(path.string(), "has no triangles; export faces, not points or curves");
  }
  file.sha256 = HashOf(path, opened);
  return file;
}

}  // namespace sim
