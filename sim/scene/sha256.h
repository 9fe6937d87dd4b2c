#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

namespace sim {

/// SHA-256 of what is added, piece by piece.
class Sha256 {
 public:
  Sha256();
  ~Sha256();
  void Add(std::string_view bytes);
  /// 64 lower-case hexadecimal digits; nothing may be added after.
  std::string Hex();

 private:
  struct Context;
  std::unique_ptr<Context> context_;
};

/// SHA-256 of the bytes, 64 lower-case hexadecimal digits.
std::string Sha256Hex(std::string_view bytes);

/// The same of a file's content.
/// @throws InputError when the file cannot be read.
std::string Sha256OfFile(const std::filesystem::path& path);

}  // namespace sim
