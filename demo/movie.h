// Joins the pictures of a run into a movie, when ffmpeg is installed.
#pragma once

#include <filesystem>
#include <optional>

namespace rubble::demo {

/// Writes `folder`/`name`.mp4 from the first `frames` pictures. Nothing when ffmpeg is missing or fails.
std::optional<std::filesystem::path> writeMovie(const std::filesystem::path& folder, const std::string& name,
                                                int frames, double fps);

}  // namespace rubble::demo
