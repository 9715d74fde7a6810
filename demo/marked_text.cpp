#include "demo/marked_text.h"

#include <fstream>
#include <iomanip>
#include <sstream>
#include <utility>

#include "demo/input_error.h"
#include "demo/output_file.h"

namespace rubble::demo {
namespace {

const std::string kOpen = "<!-- ", kClose = " -->", kEnd = "<!-- end: depends on ";

std::string beginOf(const std::string& command) {
  return kOpen + command + kClose + "\n";
}

std::string readAll(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  if (!stream) throw InputError("--write", file.string(), "cannot be read, must be a Markdown file");
  return text.str();
}

// Where the part of a command ends: the place of its end marker.
std::size_t endOf(const std::string& text, std::size_t begin, const std::filesystem::path& file,
                  const std::string& command) {
  const std::size_t end = text.find(kEnd, begin);
  const std::size_t next = text.find(kOpen + "rubble", begin);  // of any program
  if (end == std::string::npos || next < end) {
    throw InputError("--write", file.string(),
                     "has no end behind the marker of \"" + command + "\", must have " + kEnd +
                         "0000000000000000" + kClose);
  }
  return end;
}

}  // namespace

std::vector<MarkedPart> markedParts(const std::filesystem::path& file, const std::string& program) {
  const std::string text = readAll(file);
  std::vector<MarkedPart> parts;
  const std::string open = "\n" + kOpen + program + " ";
  for (std::size_t at = text.find(open); at != std::string::npos; at = text.find(open, at + 1)) {
    const std::size_t name = at + 1 + kOpen.size();
    const std::string command = text.substr(name, text.find(kClose, name) - name);
    const std::size_t hash = endOf(text, name, file, command) + kEnd.size();
    parts.push_back({command, text.substr(hash, text.find(kClose, hash) - hash)});
  }
  return parts;
}

std::string hashText(std::uint64_t hash) {
  std::ostringstream text;
  text << std::hex << std::setw(16) << std::setfill('0') << hash;
  return text.str();
}

MarkedText::MarkedText(std::filesystem::path file, std::string command)
    : m_file(std::move(file)), m_command(std::move(command)) {
  const std::string text = readAll(m_file);
  const std::size_t begin = text.find(beginOf(m_command));
  if (begin == std::string::npos) {
    throw InputError("--write", m_file.string(),
                     "has no place for this report, must hold the lines " + kOpen + m_command + kClose +
                         " and " + kEnd + "0000000000000000" + kClose);
  }
  endOf(text, begin + beginOf(m_command).size(), m_file, m_command);
}

void MarkedText::replace(const std::string& part, const std::string& dependsOn) {
  const std::string text = readAll(m_file);
  const std::size_t begin = text.find(beginOf(m_command)) + beginOf(m_command).size();
  const std::size_t end = endOf(text, begin, m_file, m_command);
  const std::size_t rest = text.find(kClose, end);
  writeWhole(m_file, text.substr(0, begin) + "\n" + part + "\n" + kEnd + dependsOn + text.substr(rest));
}

}  // namespace rubble::demo
