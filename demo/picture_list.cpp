#include "demo/picture_list.h"

#include <charconv>
#include <fstream>
#include <optional>
#include <utility>

#include "demo/input_error.h"
#include "rubble/machine_error.h"

namespace rubble::demo {
namespace {

constexpr const char* kHead = "rubble: what the last run has drawn in this folder; the next one removes it";
constexpr std::uintmax_t kLargestList = 64u << 20;  // [bytes]; two million pictures
const std::string kUnfinished = ".part";

std::string withoutPart(const std::string& name) {
  return name.ends_with(kUnfinished) ? name.substr(0, name.size() - kUnfinished.size()) : name;
}

// The frame of a picture's name, none for any other name.
std::optional<int> frameOf(const std::string& name) {
  constexpr std::string_view kBefore = "frame_";
  if (!name.starts_with(kBefore)) return std::nullopt;
  int frame = -1;
  std::from_chars(name.data() + kBefore.size(), name.data() + name.size(), frame);
  if (frame < 0 || pictureName(frame) != name) return std::nullopt;
  return frame;
}

bool isPlainMovie(const std::string& name) {
  return name.ends_with(".mp4") && name.find('/') == std::string::npos;
}

}  // namespace

std::string pictureName(int frame) {
  const std::string digits = std::to_string(frame);
  return "frame_" + std::string(digits.size() < 4 ? 4 - digits.size() : 0, '0') + digits + ".png";
}

PictureList::PictureList(std::filesystem::path folder, std::string movie)
    : m_folder(std::move(folder)), m_movie(std::move(movie)) {
  read();
}

void PictureList::read() {
  const std::filesystem::path file = m_folder / kName;
  std::error_code error;
  const auto status = std::filesystem::symlink_status(file, error);
  if (!std::filesystem::exists(status)) return;
  const auto refuse = [&] {
    throw InputError("--out", file.string(),
                     "is not a list of rubble's, must be moved away or another folder be named");
  };
  if (!std::filesystem::is_regular_file(status) || std::filesystem::file_size(file, error) > kLargestList)
    refuse();
  std::ifstream stream(file);
  if (!stream) throw MachineError(file.string() + ": cannot be read");
  std::string line;
  if (std::getline(stream, line) && line != kHead) refuse();
  while (std::getline(stream, line)) {
    const std::string name = withoutPart(line);
    if (frameOf(name) || name == m_movie) {
      m_listed.insert({line, name + kUnfinished});
    } else if (isPlainMovie(name)) {
      m_otherMovies.push_back(line);
    }
  }
}

bool PictureList::isOurs(const std::filesystem::path& file) const {
  std::error_code error;
  return m_listed.contains(file.filename().string()) &&
         std::filesystem::is_regular_file(std::filesystem::symlink_status(file, error));
}

void PictureList::requireFree(int frames) const {
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(m_folder, error)) {
    const std::string name = withoutPart(entry.path().filename().string());
    const std::optional<int> frame = frameOf(name);
    const bool isInTheWay = name == m_movie || (frame && *frame < frames);
    if (isInTheWay && !isOurs(entry.path())) {
      throw InputError("--out", entry.path().string(),
                       "is in the way and no picture of an earlier run, must be moved away or another folder "
                       "be named");
    }
  }
}

void PictureList::startAnew() {
  for (const std::string& name : m_listed) {
    const std::filesystem::path file = m_folder / name;
    std::error_code error;
    if (isOurs(file)) std::filesystem::remove(file, error);
    if (error) throw MachineError(file.string() + ": cannot be removed: " + error.message());
  }
  m_listed.clear();
  m_file = std::make_unique<OutputFile>(m_folder / kName);
  std::string text = std::string(kHead) + "\n";
  for (const std::string& movie : m_otherMovies) text += movie + "\n";
  m_file->append(text);
}

void PictureList::add(const std::string& name) {
  m_file->append(name + "\n");
}

}  // namespace rubble::demo
