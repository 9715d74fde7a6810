#include "demo/output_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <tuple>
#include <utility>

#include "demo/input_error.h"
#include "rubble/machine_error.h"

namespace rubble::demo {
namespace {

MachineError cannotWrite(const std::filesystem::path& file, int reason) {
  return MachineError(file.string() + ": cannot be written: " + std::generic_category().message(reason));
}

// The folder itself, or the nearest one above it that is there.
std::filesystem::path existingPart(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::path part = std::filesystem::absolute(folder, error);
  while (!std::filesystem::exists(std::filesystem::status(part, error)) && part.has_relative_path())
    part = part.parent_path();
  return part;
}

void requireWritable(const std::filesystem::path& place, const std::filesystem::path& what) {
  if (access(place.c_str(), W_OK) != 0) throw cannotWrite(what, errno);
}

// Refuses names that no machine could write: too long, or a circle of links.
void requireName(const std::string& option, const std::filesystem::path& name) {
  std::error_code error;
  std::ignore = std::filesystem::status(name, error);
  if (error == std::errc::filename_too_long || error == std::errc::too_many_symbolic_link_levels)
    throw InputError(option, name.string(), error.message() + ", must be another name");
}

}  // namespace

OutputFile::OutputFile(std::filesystem::path file)
    : m_file(std::move(file)),
      m_descriptor(::open(m_file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666)) {
  if (m_descriptor < 0) throw cannotWrite(m_file, errno);
}

OutputFile::~OutputFile() {
  ::close(m_descriptor);
}

void OutputFile::append(const std::string& text) {
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t count = ::write(m_descriptor, text.data() + done, text.size() - done);
    if (count >= 0) {
      done += std::size_t(count);
    } else if (errno != EINTR) {
      const int reason = errno;
      takeBack();
      throw cannotWrite(m_file, reason);
    }
  }
  m_size += std::int64_t(text.size());
}

void OutputFile::takeBack() {
  struct stat status {};
  if (fstat(m_descriptor, &status) != 0 || !S_ISREG(status.st_mode)) return;  // a pipe or a device
  if (ftruncate(m_descriptor, m_size) != 0) return;  // shrinking needs no room; nothing better is left to do
  // Not through a link, such as /dev/stdout: the link is not ours.
  std::error_code ignored;
  if (m_size == 0 && std::filesystem::is_regular_file(std::filesystem::symlink_status(m_file, ignored)))
    std::filesystem::remove(m_file, ignored);
}

void writeWhole(const std::filesystem::path& file, const std::string& text) {
  const std::filesystem::path unfinished = file.string() + ".part";
  OutputFile(unfinished).append(text);
  std::error_code error, ignored;
  std::filesystem::rename(unfinished, file, error);
  if (!error) return;
  std::filesystem::remove(unfinished, ignored);
  throw cannotWrite(file, error.value());
}

void checkFolder(const std::string& option, const std::filesystem::path& folder) {
  requireName(option, folder);
  const std::filesystem::path base = existingPart(folder);
  std::error_code error;
  if (!std::filesystem::is_directory(base, error)) {
    throw InputError(option, folder.string(), base.string() + " is no folder, must be a folder");
  }
  requireWritable(base, folder);
}

void checkFile(const std::string& option, const std::filesystem::path& file,
               const std::filesystem::path& results) {
  requireName(option, file);
  std::error_code error;
  if (std::filesystem::is_directory(file, error) || file.filename().empty())
    throw InputError(option, file.string(), "is a folder, must be a file");
  const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : ".";
  if (std::filesystem::exists(std::filesystem::status(file, error))) {
    requireWritable(file, file);
  } else if (std::filesystem::is_directory(folder, error)) {
    requireWritable(folder, file);
  } else if (folder.lexically_normal() != results.lexically_normal()) {
    throw InputError(option, file.string(), "cannot be written, must be in an existing folder");
  }
}

void makeFolder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw cannotWrite(folder, error.value());
}

bool sameFile(const std::filesystem::path& a, const std::filesystem::path& b) {
  std::error_code error;
  const auto isThere = [&](const std::filesystem::path& file) {
    return std::filesystem::exists(std::filesystem::status(file, error));
  };
  if (isThere(a) && isThere(b))
    return std::filesystem::is_regular_file(a, error) && std::filesystem::equivalent(a, b, error);
  return std::filesystem::absolute(a, error).lexically_normal() ==
         std::filesystem::absolute(b, error).lexically_normal();
}

}  // namespace rubble::demo
