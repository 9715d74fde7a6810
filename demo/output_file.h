// Text files that a run writes: never half a line, and the reason when one cannot be written.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace rubble::demo {

/// A file that grows piece by piece and can be read meanwhile. A piece that does not fit on the disk is taken
/// back, so the file always ends with a whole one; a file that would be left empty by that is removed.
class OutputFile {
 public:
  /// Makes or empties the file. Throws MachineError.
  explicit OutputFile(std::filesystem::path file);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  /// Hands all of `text` to the system before it returns. Throws MachineError.
  void append(const std::string& text);

 private:
  void takeBack();

  std::filesystem::path m_file;
  int m_descriptor;
  std::int64_t m_size = 0;  // [bytes] of whole pieces
};

/// Writes the file whole or not at all: beside it first, as FILE.part. Throws MachineError.
void writeWhole(const std::filesystem::path& file, const std::string& text);

/// Refuses, before the long work, a folder of results that could not be made or written after it. InputError
/// where `folder` cannot be a folder, MachineError where the machine does not let it be written.
void checkFolder(const std::string& option, const std::filesystem::path& folder);

/// The same for a file of results; its folder must exist or be `results`, which will be made.
void checkFile(const std::string& option, const std::filesystem::path& file,
               const std::filesystem::path& results);

/// Makes the folder where there is none. Throws MachineError.
void makeFolder(const std::filesystem::path& folder);

/// True when both names lead to one regular file on disk, or will.
bool sameFile(const std::filesystem::path& a, const std::filesystem::path& b);

}  // namespace rubble::demo
