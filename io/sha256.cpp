#include "io/sha256.h"

#include <openssl/evp.h>

#include <array>
#include <memory>
#include <stdexcept>
#include <vector>

#include "io/input_error.h"
#include "io/read_file.h"

namespace io {
namespace {

/// The sum of what is added, piece by piece.
class Sha256 {
 public:
  Sha256() { Require(context_ && EVP_DigestInit_ex(context_.get(), EVP_sha256(), nullptr)); }
  void Add(std::string_view bytes) {
    Require(EVP_DigestUpdate(context_.get(), bytes.data(), bytes.size()));
  }
  std::string Hex() {
    std::array<unsigned char, EVP_MAX_MD_SIZE> sum{};
    unsigned length = 0;
    Require(EVP_DigestFinal_ex(context_.get(), sum.data(), &length));
    std::string hex;
    for (unsigned i = 0; i < length; ++i) {
      hex += "0123456789abcdef"[sum[i] >> 4];
      hex += "0123456789abcdef"[sum[i] & 15];
    }
    return hex;
  }

 private:
  static void Require(bool done) {
    if (!done) throw std::runtime_error("SHA-256 is not available in this OpenSSL");
  }
  std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> context_{EVP_MD_CTX_new(),
                                                                   &EVP_MD_CTX_free};
};

}  // namespace

std::string Sha256Hex(std::string_view bytes) {
  Sha256 sum;
  sum.Add(bytes);
  return sum.Hex();
}

std::string Sha256OfFile(const std::filesystem::path& path) {
  std::ifstream file = OpenFile(path);
  Sha256 sum;
  std::vector<char> block(1 << 16);
  while (file.read(block.data(), static_cast<std::streamsize>(block.size())) ||
         file.gcount() > 0) {
    sum.Add({block.data(), static_cast<std::size_t>(file.gcount())});
  }
  if (file.bad()) throw InputError(path.string(), "cannot be read to its end");
  return sum.Hex();
}

}  // namespace io
