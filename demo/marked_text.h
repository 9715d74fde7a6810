// Text that a program keeps up to date inside a Markdown file, between two comments:
//
//     <!-- rubble report wall --frames 45 -->
//     ... what that command wrote ...
//     <!-- end: depends on 0123456789abcdef -->
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace rubble::demo {

/// A part between markers.
struct MarkedPart {
  std::string command;    ///< of the first marker
  std::string dependsOn;  ///< of the second; empty before the first writing
};
/// All parts of a file whose command is of `program`, "rubble" or "rubble_bench". Throws InputError for a
/// part without an end.
std::vector<MarkedPart> markedParts(const std::filesystem::path& file, const std::string& program);

/// What a second marker holds: 16 hexadecimal digits.
std::string hashText(std::uint64_t hash);

class MarkedText {
 public:
  /// Throws InputError when the file cannot be read or holds no such part.
  MarkedText(std::filesystem::path file, std::string command);

  /// Puts `text` between the markers; the file is replaced as a whole or not at all. Throws
  /// MachineError.
  void replace(const std::string& text, const std::string& dependsOn);

 private:
  std::filesystem::path m_file;
  std::string m_command;
};

}  // namespace rubble::demo
