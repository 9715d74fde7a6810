#include "base/input_file.h"

#include <system_error>

namespace rubble::base {

std::uint64_t inputSize(const std::filesystem::path& file, const std::string& wanted) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(file, error);
  switch (status.type()) {
    case std::filesystem::file_type::regular:
      break;
    case std::filesystem::file_type::not_found:
      refuseFile(file, "no such file");
    case std::filesystem::file_type::directory:
      refuseFile(file, "is a folder; allowed: " + wanted);
    case std::filesystem::file_type::fifo:
      refuseFile(file, "is a pipe; allowed: " + wanted);
    case std::filesystem::file_type::socket:
      refuseFile(file, "is a socket; allowed: " + wanted);
    case std::filesystem::file_type::block:
    case std::filesystem::file_type::character:
      refuseFile(file, "is a device; allowed: " + wanted);
    default:
      refuseFile(file, "cannot be read: " + (error ? error.message() : "it is no regular file"));
  }
  const std::uintmax_t size = std::filesystem::file_size(file, error);
  if (error) refuseFile(file, "cannot be read: " + error.message());
  return size;
}

}  // namespace rubble::base
