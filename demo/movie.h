// Joins the pictures of a run into a movie, when ffmpeg is installed.
#pragma once

#include <filesystem>
#include <string>

#include "demo/picture_list.h"

namespace rubble::demo {

/// Writes `folder`/`name` (an .mp4) from the first `frames` pictures and lists it in `list`. False when
/// ffmpeg is not installed. Throws MachineError with ffmpeg's reason when it fails; the movie is whole or not
/// there.
bool writeMovie(const std::filesystem::path& folder, const std::string& name, int frames, double fps,
                PictureList& list);

}  // namespace rubble::demo
