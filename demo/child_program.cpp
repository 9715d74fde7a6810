#include "demo/child_program.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <system_error>

#include "rubble/machine_error.h"

namespace rubble::demo {
namespace {

std::string readEnd(int descriptor) {
  constexpr std::size_t kKept = 4096;  // [bytes]; the reason stands in the last line
  std::string text;
  std::array<char, kKept> buffer;
  while (true) {
    const ssize_t count = ::read(descriptor, buffer.data(), buffer.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return text;
    text.append(buffer.data(), std::size_t(count));
    if (text.size() > kKept) text.erase(0, text.size() - kKept);
  }
}

}  // namespace

std::optional<Ended> runProgram(const std::filesystem::path& folder, std::vector<std::string> arguments) {
  std::vector<char*> raw;
  for (std::string& argument : arguments) raw.push_back(argument.data());
  raw.push_back(nullptr);
  std::array<int, 2> pipe{};
  if (::pipe2(pipe.data(), O_CLOEXEC) != 0)
    throw MachineError("no pipe: " + std::generic_category().message(errno));
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, pipe[1], STDERR_FILENO);
  posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
  pid_t process = 0;
  const int failure = posix_spawnp(&process, raw.front(), &actions, nullptr, raw.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  ::close(pipe[1]);
  Ended ended;
  if (failure == 0) {
    ended.error = readEnd(pipe[0]);
    while (waitpid(process, &ended.status, 0) < 0 && errno == EINTR) continue;
  }
  ::close(pipe[0]);
  if (failure == ENOENT) return std::nullopt;
  if (failure != 0) throw MachineError(arguments.front() + ": " + std::generic_category().message(failure));
  return ended;
}

std::string problemOf(const Ended& ended) {
  if (WIFEXITED(ended.status) && WEXITSTATUS(ended.status) == 0) return {};
  const std::string how = WIFSIGNALED(ended.status)
                              ? "was ended by signal " + std::to_string(WTERMSIG(ended.status))
                              : "ended with exit code " + std::to_string(WEXITSTATUS(ended.status));
  const auto end = ended.error.find_last_not_of(" \n\r");
  if (end == std::string::npos) return how;
  const auto before = ended.error.find_last_of("\n\r", end);
  const std::size_t start = before == std::string::npos ? 0 : before + 1;
  return how + ": " + ended.error.substr(start, end + 1 - start);
}

}  // namespace rubble::demo
