#include "demo/window/png.h"

#include <png.h>

#include <cerrno>
#include <string>
#include <system_error>
#include <vector>

#include "rubble/machine_error.h"

namespace rubble::demo {
namespace {

// Opaque pictures need no alpha: a quarter less to compress.
std::vector<std::uint8_t> withoutAlpha(const Image& image) {
  std::vector<std::uint8_t> rgb;
  rgb.reserve(image.pixels.size() / 4 * 3);
  for (std::size_t i = 0; i < image.pixels.size(); i += 4) {
    rgb.insert(rgb.end(), {image.pixels[i], image.pixels[i + 1], image.pixels[i + 2]});
  }
  return rgb;
}

}  // namespace

void writePng(const std::filesystem::path& file, const Image& image) {
  const std::string name = file.string();
  if (image.width < 1 || image.height < 1 ||
      image.pixels.size() != std::size_t{4} * std::size_t(image.width) * std::size_t(image.height)) {
    throw Error(name + ": a picture of " + std::to_string(image.width) + " x " +
                std::to_string(image.height) + " pixels cannot be written");
  }
  const std::vector<std::uint8_t> rgb = withoutAlpha(image);
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  png.width = png_uint_32(image.width);
  png.height = png_uint_32(image.height);
  png.format = PNG_FORMAT_RGB;
  // Beside the file first, so that who watches the folder never sees half a picture.
  const std::string unfinished = name + ".part";
  errno = 0;
  if (!png_image_write_to_file(&png, unfinished.c_str(), 0, rgb.data(), 0, nullptr)) {
    // libpng says "Write Error" for a full disk; the system knows better.
    const std::string reason = errno != 0 ? std::generic_category().message(errno) : png.message;
    std::error_code ignored;
    std::filesystem::remove(unfinished, ignored);
    throw MachineError(name + ": cannot be written: " + reason);
  }
  std::error_code failure;
  std::filesystem::rename(unfinished, file, failure);
  if (!failure) return;
  std::error_code ignored;
  std::filesystem::remove(unfinished, ignored);
  throw MachineError(name + ": cannot be written: " + failure.message());
}

}  // namespace rubble::demo
