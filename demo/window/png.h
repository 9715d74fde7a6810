// Pictures to PNG files.
#pragma once

#include <filesystem>

#include "rubble/render.h"

namespace rubble::demo {

/// Writes the picture without its alpha channel. The file appears whole or not at all. Throws
/// MachineError naming the file.
void writePng(const std::filesystem::path& file, const Image& image);

}  // namespace rubble::demo
