#include "io/sha256.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "io/input_error.h"
#include "tests/support/temporary_folder.h"

namespace io {
namespace {

// FIPS 180-4, examples of the standard.
TEST(Sha256, AgreesWithThePublishedExamples) {
  EXPECT_EQ(Sha256Hex(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(Sha256Hex("abc"),
            "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(Sha256Hex(std::string(1000000, 'a')),
            "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

TEST(Sha256, OfAFileIsThatOfItsBytes) {
  const test_support::TemporaryFolder folder;
  const std::filesystem::path path = folder / "bytes.bin";
  const std::string bytes(200001, 'x');
  std::ofstream(path, std::ios::binary) << bytes;
  EXPECT_EQ(Sha256OfFile(path), Sha256Hex(bytes));
  std::filesystem::remove(path);
  EXPECT_THROW(Sha256OfFile(path), InputError);
}

}  // namespace
}  // namespace io
