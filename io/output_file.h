#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace io {

/// What may become of things that exist.
struct OutputRules {
  bool force = false;  ///< an older file is replaced
  /// Files that the command reads, and folders of such files: never replaced.
  std::vector<std::filesystem::path> inputs = {};
  /// Name of a file that the command itself writes into an input folder, and may replace there.
  std::string own_name = {};
};

/// The one file that a command is told to write. It is made before the work, to refuse what
/// would fail, and written after it: a regular file whole or not at all; a device, a pipe or an
/// open descriptor (/dev/stdout) as it is, without a file being put in its place.
class OutputFile {
 public:
  /// @throws InputError when the place is a folder, a link to a file, an input, a file (unless
  ///   forced), or cannot be written to
  OutputFile(std::filesystem::path path, OutputRules rules);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  /// @throws InputError, also when something has appeared there since
  void Write(std::string_view bytes) const { WriteTogether({{this, std::string(bytes)}}); }

  struct Content {
    const OutputFile* file;
    std::string bytes;
  };
  /// Several outputs of one command: none comes to its place before all of them can, and of two
  /// commands that write the same files at once the later one replaces or leaves all of them.
  /// @throws InputError as Write
  static void WriteTogether(const std::vector<Content>& contents);

 private:
  void RequirePlace() const;
  void RefuseWhatIsThere() const;
  void RefuseInput() const;
  void OpenStream(std::filesystem::file_type type);

  std::filesystem::path path_;
  OutputRules rules_;
  int stream_ = -1;  ///< descriptor of what is no regular file
};

/// Refuses two outputs of one command that are one file, of which the later would replace the
/// earlier. Empty paths are none; a device, a pipe or a descriptor takes both.
/// @throws InputError
void RefuseSameFile(const std::vector<std::filesystem::path>& outputs);

/// Refuses a folder that is to be replaced although it holds one of the inputs.
/// @throws InputError naming both
void RefuseInputsInside(const std::filesystem::path& folder,
                        const std::vector<std::filesystem::path>& inputs);

}  // namespace io
