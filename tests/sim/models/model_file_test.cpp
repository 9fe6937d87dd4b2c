#include "sim/models/model_file.h"

#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "io/sha256.h"
#include "tests/support/temporary_folder.h"

namespace sim {
namespace {

// One library sorts before the mesh by its name, the other after it.
TEST(ModelFile, HashesEveryFileThatTheMeshNames) {
  const test_support::TemporaryFolder temporary;
  const auto write = [&](const std::string& name, const std::string& text) {
    std::ofstream(temporary.path() / name) << text;
  };
  const auto library = [](const std::string& name, const std::string& red) {
    return "newmtl " + name + "\nKd " + red + " 0.1 0.1\n";
  };
  const std::string mesh =
      "mtllib a.mtl\nmtllib z.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"
      "usemtl first\nf 1 2 3\nusemtl second\nf 1 2 4\n";
  const auto read = [&] { return ReadModelFile(temporary.path() / "it.obj"); };
  write("it.obj", mesh);
  write("a.mtl", library("first", "0.8"));
  write("z.mtl", library("second", "0.6"));
  const ModelFile before = read();
  EXPECT_EQ(before.sha256,
            io::Sha256Hex(mesh + library("first", "0.8") + library("second", "0.6")));
  write("z.mtl", library("second", "0.5"));
  const std::string second_changed = read().sha256;
  EXPECT_NE(second_changed, before.sha256);
  write("a.mtl", library("first", "0.7"));
  EXPECT_NE(read().sha256, second_changed);
  write("a.mtl", library("first", "0.8"));
  write("z.mtl", library("second", "0.6"));
  EXPECT_EQ(read().sha256, before.sha256);
}

}  // namespace
}  // namespace sim
