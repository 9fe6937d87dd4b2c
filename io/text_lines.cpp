#include "io/text_lines.h"

#include <ios>
#include <string_view>

#include "io/input_error.h"
#include "io/read_file.h"

namespace io {
namespace {

constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";  // of UTF-8

}  // namespace

TextLines::TextLines(const std::filesystem::path& file, const std::string& mend,
                     std::size_t max_line_bytes)
    : file_(file), stream_(OpenFile(file, mend)), max_line_bytes_(max_line_bytes) {}

std::string TextLines::where() const { return Where(file_, number_); }

bool TextLines::Next(std::string& text) {
  text.clear();
  ++number_;
  std::streambuf& bytes = *stream_.rdbuf();
  bool ended = false;
  try {
    for (int byte = bytes.sbumpc(); byte != std::streambuf::traits_type::eof();
         byte = bytes.sbumpc()) {
      ended = byte == '\n';
      if (ended) break;
      if (text.size() == max_line_bytes_) {
        throw InputError(where(), "too long a line for a text file");
      }
      text += static_cast<char>(byte);
    }
  } catch (const std::ios_base::failure&) {
    throw InputError(where(), "cannot be read to its end; copy the file again");
  }
  const bool read = ended || !text.empty();
  if (number_ == 1 && text.starts_with(kByteOrderMark)) text.erase(0, kByteOrderMark.size());
  return read;
}

}  // namespace io
