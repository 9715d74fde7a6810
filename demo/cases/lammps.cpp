#include "demo/cases/lammps.h"

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <sstream>

#include "demo/child_program.h"
#include "demo/console.h"
#include "demo/markdown_table.h"
#include "demo/output_file.h"
#include "rubble/machine_error.h"

namespace rubble::demo {
namespace {

constexpr const char* kProgram = "lmp";
constexpr const char* kAnswer = "answer ";

// A folder of its own, gone at the end.
class ScratchFolder {
 public:
  ScratchFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "rubble-XXXXXX").string();
    if (!::mkdtemp(name.data())) throw MachineError(name + ": cannot be made");
    m_path = name;
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  ~ScratchFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(m_path, ignored);
  }
  const std::filesystem::path& path() const { return m_path; }

 private:
  std::filesystem::path m_path;
};

std::string inputOf(const LammpsRun& run) {
  std::ostringstream text;
  text.precision(std::numeric_limits<double>::max_digits10);
  text << run.script << "timestep " << run.timestep << "\n";
  for (std::size_t i = 0; i < run.asked.size(); ++i)
    text << "variable v" << i << " equal " << run.asked[i] << "\n";
  text << "thermo 0\nrun " << std::lround(run.simulated / run.timestep) << "\nprint \"" << kAnswer;
  for (std::size_t i = 0; i < run.asked.size(); ++i) text << (i ? " " : "") << "$(v_v" << i << ":%.17g)";
  text << "\"\n";
  return text.str();
}

std::string contentOf(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

// One that lacks a package fails like any method, and says why.
CaseOutcome outcomeOf(double timestep, const std::function<CaseOutcome(double)>& run) {
  try {
    return run(timestep);
  } catch (const MachineError& error) {
    consoleLog()(LogLevel::Warning, error.what());
    return {.error = HUGE_VAL, .simulatedSeconds = 1};
  }
}

}  // namespace

bool hasLammps() {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path ? path : "");
  std::error_code error;
  for (std::string folder; std::getline(folders, folder, ':');)
    if (!folder.empty() && std::filesystem::is_regular_file(std::filesystem::path(folder) / kProgram, error))
      return true;
  return false;
}

LammpsResult readLammpsLog(const std::string& log, std::size_t asked) {
  LammpsResult result;
  std::istringstream lines(log);
  std::string wrong = "its log has no answer";
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string word;
    if (line.starts_with("Loop time of ")) {
      words >> word >> word >> word >> result.processorSeconds;
    } else if (line.starts_with(kAnswer)) {
      words >> word;
      for (double value; words >> value;) result.values.push_back(value);
    } else if (line.starts_with("ERROR")) {
      wrong = line;
    }
  }
  if (result.values.size() != asked || !(result.processorSeconds > 0)) throw MachineError("LAMMPS: " + wrong);
  return result;
}

LammpsResult runLammps(const LammpsRun& run) {
  const ScratchFolder folder;
  writeWhole(folder.path() / "in", inputOf(run));
  const auto ended = runProgram(folder.path(), {kProgram, "-in", "in", "-log", "log", "-screen", "none"});
  if (!ended) throw MachineError(std::string(kProgram) + ": is not installed");
  return readLammpsLog(contentOf(folder.path() / "log"), run.asked.size());
}

std::string lammpsScript(const LammpsSphere& sphere) {
  std::ostringstream text;
  text.precision(std::numeric_limits<double>::max_digits10);
  text << "units si\natom_style sphere\nboundary f f f\nnewton off\ncomm_modify vel yes\n"
       << "region box block -2 2 -1 1 -1 1\ncreate_box 1 box\n"
       << "create_atoms 1 single " << sphere.x << ' ' << sphere.y << " 0\n"
       << "set group all diameter " << 2 * sphere.radius << " density " << sphere.density << '\n'
       << "neighbor 0.05 bin\npair_style gran/hooke 1 0 0 0 0 0\npair_coeff * *\n"
       << "fix wall all wall/gran " << (sphere.friction ? "hooke/history " : "hooke ") << sphere.stiffness
       << (sphere.friction ? " NULL " : " 0 ") << sphere.damping << " 0 " << (sphere.friction ? "1 0" : "0 0")
       << " yplane 0 NULL\n"
       << "fix move all nve/sphere\n";
  return text.str();
}

std::vector<CaseRun> lammpsRuns(const std::string& method, std::initializer_list<double> timesteps,
                                const std::function<CaseOutcome(double)>& run) {
  std::vector<CaseRun> runs;
  if (!hasLammps()) return runs;
  for (const double timestep : timesteps)
    runs.push_back({.method = method,
                    .setting = "timestep " + rounded(timestep) + " s",
                    .quick = true,
                    .run = [=] { return outcomeOf(timestep, run); },
                    .isForeign = true});
  return runs;
}

}  // namespace rubble::demo
