#include "demo/movie.h"

#include <system_error>

#include "demo/child_program.h"
#include "rubble/machine_error.h"

namespace rubble::demo {
bool writeMovie(const std::filesystem::path& folder, const std::string& name, int frames, double fps,
                PictureList& list) {
  const std::filesystem::path movie = folder / name;
  const std::string part = name + ".part";
  list.add(part);
  std::error_code error, ignored;
  // ffmpeg works inside the folder: a % in the folder's name would be read as part of the pictures' pattern.
  const auto ended =
      runProgram(folder, {"ffmpeg", "-nostdin", "-y", "-loglevel", "error", "-framerate", std::to_string(fps),
                          "-start_number", "0", "-i", "frame_%04d.png", "-frames:v", std::to_string(frames),
                          // Players want 4:2:0, which wants even sizes.
                          "-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2", "-pix_fmt", "yuv420p",
                          // "file:": a colon in the name would be read as the end of a protocol's.
                          "-f", "mp4", "file:" + part});
  if (!ended) return false;
  std::string problem = problemOf(*ended);
  if (problem.empty()) {
    list.add(name);
    std::filesystem::rename(folder / part, movie, error);
    if (!error) return true;
    problem = "left no movie: " + error.message();
  }
  std::filesystem::remove(folder / part, ignored);
  throw MachineError(movie.string() + ": no movie, the pictures are whole: ffmpeg " + problem);
}

}  // namespace rubble::demo
