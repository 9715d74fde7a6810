#include "demo/movie.h"

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <string>
#include <vector>

namespace rubble::demo {
namespace {

// True when the program was found and ended with 0. No shell: names of files need no quoting.
bool runProgram(std::vector<std::string> arguments) {
  std::vector<char*> raw;
  for (std::string& argument : arguments) raw.push_back(argument.data());
  raw.push_back(nullptr);
  pid_t process = 0;
  if (posix_spawnp(&process, raw.front(), nullptr, nullptr, raw.data(), environ) != 0) return false;
  int status = 0;
  return waitpid(process, &status, 0) == process && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

}  // namespace

std::optional<std::filesystem::path> writeMovie(const std::filesystem::path& folder, const std::string& name,
                                                int frames, double fps) {
  const std::filesystem::path movie = folder / (name + ".mp4");
  const bool done =
      runProgram({"ffmpeg", "-nostdin", "-y", "-loglevel", "error", "-framerate", std::to_string(fps), "-i",
                  (folder / "frame_%04d.png").string(), "-frames:v", std::to_string(frames),
                  // Players want 4:2:0, which wants even sizes.
                  "-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2", "-pix_fmt", "yuv420p", movie.string()});
  if (!done) return std::nullopt;
  return movie;
}

}  // namespace rubble::demo
