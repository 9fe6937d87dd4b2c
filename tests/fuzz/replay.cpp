// Runs a libFuzzer harness without libFuzzer: every seed as it is, then so many mutations of
// them, the same ones each time. Finds less than ci/fuzz, which is led by what the code does,
// but needs no clang and takes seconds.
//   fuzz_replay_NAME DICTIONARY MUTATIONS SEED...
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

constexpr std::size_t kLongest = 4096;

/// splitmix64: the n-th draw of a stream is the same everywhere.
class Draws {
 public:
  explicit Draws(std::uint64_t seed) : state_(seed) {}
  std::size_t Below(std::size_t n) {
    std::uint64_t x = state_ += 0x9e3779b97f4a7c15;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9;
    x = (x ^ (x >> 27)) * 0x94d049bb133111eb;
    return static_cast<std::size_t>((x ^ (x >> 31)) % std::max<std::size_t>(n, 1));
  }

 private:
  std::uint64_t state_;
};

std::string Read(const char* path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) {
    std::fprintf(stderr, "fuzz_replay: cannot read %s\n", path);
    std::exit(2);
  }
  return {std::istreambuf_iterator<char>(in), {}};
}

/// What stands between quotes, line by line; \xHH and \\ as libFuzzer has them.
std::vector<std::string> Words(const std::string& dictionary) {
  std::vector<std::string> words;
  for (std::size_t at = 0; at < dictionary.size();) {
    const std::size_t end = std::min(dictionary.find('\n', at), dictionary.size());
    const std::string line = dictionary.substr(at, end - at);
    at = end + 1;
    if (line.empty() || line[0] == '#') continue;
    const std::size_t open = line.find('"'), close = line.rfind('"');
    if (open == close) continue;
    std::string word;
    for (std::size_t i = open + 1; i < close; ++i) {
      if (line[i] != '\\') {
        word += line[i];
      } else if (line[++i] == 'x') {
        word += static_cast<char>(std::stoi(line.substr(i + 1, 2), nullptr, 16));
        i += 2;
      } else {
        word += line[i];
      }
    }
    words.push_back(word);
  }
  return words;
}

/// A run of characters that a number may consist of, at or after a place drawn.
struct Span {
  std::size_t begin, length;
};
Span NumberIn(const std::string& text, Draws& draws) {
  const char* const kOfNumbers = "0123456789.-+e";
  const std::size_t begin = text.find_first_of("0123456789", draws.Below(text.size()));
  if (begin == std::string::npos) return {0, 0};
  const std::size_t end = std::min(text.find_first_not_of(kOfNumbers, begin), text.size());
  return {begin, end - begin};
}

std::string SomeNumber(Draws& draws) {
  static const char* const kOdd[] = {"0",    "-1",   "1e308", "-1e308", "1e-308",
                                     "nan",  ".inf", "-.inf", "1e9",    "4294967296",
                                     "-0.0", "0x10", "1e400", "65536",  "18446744073709551616"};
  const std::size_t kind = draws.Below(3);
  if (kind == 0) return kOdd[draws.Below(std::size(kOdd))];
  if (kind == 1) return std::to_string(draws.Below(20));
  return std::to_string(draws.Below(8)) + "." + std::to_string(draws.Below(1000));
}

/// One change to a text: as people do (numbers, words, lines), or as disks do (bytes).
void Mutate(std::string& text, const std::vector<std::string>& words,
            const std::vector<std::string>& seeds, Draws& draws) {
  const std::size_t at = draws.Below(text.size() + 1);
  const auto rest = [&] {
    return draws.Below(std::min<std::size_t>(text.size() - at, 64) + 1);
  };
  switch (draws.Below(8)) {
    case 0:
    case 1: {
      const Span number = NumberIn(text, draws);
      text.replace(number.begin, number.length, SomeNumber(draws));
      break;
    }
    case 2:
      text.insert(at, words[draws.Below(words.size())]);
      break;
    case 3:
      text.replace(at, rest(), words[draws.Below(words.size())]);
      break;
    case 4:
      text.erase(at, rest());
      break;
    case 5:
      text.insert(at, text.substr(at, rest()));
      break;
    case 6: {
      const std::string& other = seeds[draws.Below(seeds.size())];
      text.insert(at, other.substr(draws.Below(other.size() + 1), draws.Below(200)));
      break;
    }
    default:
      if (at < text.size()) text[at] = static_cast<char>(draws.Below(256));
  }
  text.resize(std::min(text.size(), kLongest));
}

void Run(const std::string& text) {
  LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 4) {
    std::fprintf(stderr, "usage: %s DICTIONARY MUTATIONS SEED...\n", argv[0]);
    return 2;
  }
  const std::vector<std::string> words = Words(Read(argv[1]));
  const std::size_t mutations = std::strtoull(argv[2], nullptr, 10);
  std::vector<std::string> seeds;
  for (int i = 3; i < argc; ++i) seeds.push_back(Read(argv[i]));
  for (const std::string& seed : seeds) Run(seed);
  for (std::size_t i = 0; i < mutations; ++i) {
    Draws draws(i);
    std::string text = seeds[i % seeds.size()];
    for (std::size_t changes = 1 + draws.Below(4); changes > 0; --changes) {
      Mutate(text, words, seeds, draws);
    }
    Run(text);
  }
  std::printf("fuzz_replay: %zu seeds and %zu mutations of them: no fault\n", seeds.size(),
              mutations);
}
