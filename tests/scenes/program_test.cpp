// The program from outside: exit codes, what it says, what it leaves behind.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "scenes/program.h"

namespace rubble::test {
namespace {

TEST_F(Program, RunsASceneAndSaysWhatHappened) {
  m_folder.write("small.json", kSmallWall);
  const ChildResult result = run("run small.json --no-render --frames 3 --events events.jsonl");
  EXPECT_EQ(result.exitCode, 0) << result.error;
  for (const char* word :
       {"elements", "springs", "fragments", "debris", "dust", "impactor", "ledger errors", "ms a frame"})
    EXPECT_NE(result.out.find(word), std::string::npos) << word << " in\n" << result.out;
  std::ifstream stats(m_folder.path() / "out/small/stats.jsonl");
  int frames = 0;
  for (std::string line; std::getline(stats, line);) ++frames;
  EXPECT_EQ(frames, 3);
  EXPECT_TRUE(exists("events.jsonl"));
}

TEST_F(Program, BadInputIsOneLineExitCode2AndNothingWritten) {
  m_folder.write("bad.json", R"({"objects": [{"size": [1, 1, 1], "radius": -1}]})");
  const ChildResult result = run("run bad.json --events events.jsonl");
  EXPECT_EQ(result.exitCode, 2);
  EXPECT_EQ(result.error, "rubble: error: bad.json: objects.0.radius: is -1, must be 0 to 100000\n");
  EXPECT_EQ(result.out, "");
  EXPECT_FALSE(exists("out"));
  EXPECT_FALSE(exists("events.jsonl"));
}

TEST_F(Program, EveryBadArgumentIsExitCode2AndOneLine) {
  m_folder.write("small.json", kSmallWall);
  for (const char* arguments : {"",
                                "fly wall",
                                "run",
                                "run none.json",
                                "run small.json --frames 0",
                                "run small.json --frames many",
                                "run small.json --size 12",
                                "run small.json --size 0x0",
                                "run small.json --size 1280x720x3",
                                "run small.json --threads 0",
                                "run small.json --set gravityy=1",
                                "run small.json --set gravity",
                                "run small.json --wat",
                                "run small.json --seed -1",
                                "run small.json --error",
                                "run small.json --error ''",
                                "run small.json --error -1%",
                                "run small.json --error '2 %'",
                                "run small.json --error 50%",
                                "info none.rubble-asset",
                                "view none",
                                "run small.json --no-render --set dust.backend=gl",
                                "run small.json --no-render --out small.json",
                                "run small.json --no-render --stats none/stats.jsonl",
                                "run small.json --no-render --out ''",
                                "run small.json --no-render --out small.json/below",
                                "run small.json --no-render --stats ''",
                                "run small.json --no-render --stats small.json",
                                "run small.json --no-render --stats .",
                                "run small.json --no-render --stats a --events ./a",
                                "run small.json --no-render --frames ''",
                                "run small.json --no-render --seed ''",
                                "run ''",
                                "report",
                                "report ''",
                                "report none",
                                "report cantilever none",
                                "report cantilever --set seed=2",
                                "report cantilever --quick --write none.md",
                                "report stability --cases 0",
                                "report stability --cases 1 --write none.md",
                                "report cantilever --cases 1",
                                "report small.json --out small.json",
                                "report small.json --sweep seed",
                                "report small.json --sweep 'fps=60;0'",
                                "report small.json --write none.md",
                                "report small.json --write small.json",
                                "bench",
                                "bench others",
                                "bench paper wall",
                                "bench paper --frames 0",
                                "bench paper --frames many",
                                "bench paper --size 12",
                                "bench paper --most-elements 127",
                                "bench paper --most-elements -1",
                                "bench paper --threads 0",
                                "bench paper --csv none/a.csv",
                                "bench paper --svg .",
                                "bench paper --csv ''",
                                "bench paper --csv a --svg ./a",
                                "bench paper --csv small.json --write small.json",
                                "bench paper --write small.json",
                                "bench paper --write none.md"}) {
    const ChildResult result = run(arguments);
    EXPECT_EQ(result.exitCode, 2) << arguments;
    const auto errors = result.error.rfind("rubble: error: ");
    ASSERT_NE(errors, std::string::npos) << arguments << '\n' << result.error;
    EXPECT_EQ(lines(result.error.substr(errors)), 1) << arguments << '\n' << result.error;
    EXPECT_EQ(result.out, "") << arguments;
  }
  EXPECT_FALSE(exists("out/small/stats.jsonl"));
}

// Each remedy that the line names is tried, and the scene is taken with it.
TEST_F(Program, TooManySubstepsAreRefusedBeforeTheCookWithWhatWouldDo) {
  m_folder.write("cube.json", R"({"frames": 1, "max_substeps_per_frame": 60, "statics": [{"shape": "plane"}],
      "objects": [{"size": [1, 1, 1], "position": [0, 0.5, 0], "elements": 4000}]})");
  const std::string command = "run cube.json --no-render";
  const ChildResult result = run(command);
  expectError(result, 2, "cube.json: objects.0: needs more than ");
  EXPECT_EQ(lines(result.error), 1) << result.error;  // no progress: nothing was cooked
  const auto number = [&](const std::string& before, const std::string& after) {
    const std::size_t end = result.error.find(after, result.error.find(before) + before.size());
    if (end == std::string::npos) return std::string("none");
    const std::size_t begin = result.error.rfind(' ', end - 1) + 1;
    return result.error.substr(begin, end - begin);
  };
  EXPECT_EQ(run(command + " --set max_substeps_per_frame=" + number("frame is 60:", " or ")).exitCode, 0);
  EXPECT_EQ(
      run(command + " --set objects.0.material.youngs_modulus=" + number("youngs_modulus", " or ")).exitCode,
      0);
  EXPECT_EQ(run(command + " --set objects.0.elements=" + number("youngs_modulus", " elements")).exitCode, 0);
  // So near to the limit that the elements must be known, and then it is exact.
  const ChildResult near = run(command + " --set max_substeps_per_frame=100");
  expectError(
      near, 2,
      "cube.json with --set max_substeps_per_frame: objects.0: material concrete_soft: stable substep is ");
  EXPECT_NE(near.error.find("max_substeps_per_frame is 100: "), std::string::npos) << near.error;
  EXPECT_NE(near.error.find(" would do, for contacts too, or a youngs_modulus of "), std::string::npos)
      << near.error;
  // An asset's are known at once.
  m_folder.write("corner.off",
                 "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n");
  ASSERT_EQ(run("cook corner.off -o box.rubble-asset --elements 100").exitCode, 0);
  m_folder.write("asset.json",
                 R"({"max_substeps_per_frame": 3, "objects": [{"asset": "box.rubble-asset"}]})");
  expectError(run("info asset.json"), 2, "asset.json: objects.0: needs more than ");
}

// What is found out after the scene has been read blames the option that gave the value, not the file alone.
TEST_F(Program, AnOptionAtFaultIsNamedWhateverFindsIt) {
  m_folder.write("cube.json", R"({"frames": 1, "objects": [{"size": [1, 1, 1], "elements": 100}],
      "impactors": [{"shape": "sphere", "radius": 0.1, "mass": 1, "position": [0, 2, 0]}]})");
  const std::string command = "run cube.json --no-render --frames 1 --set ";
  expectError(run(command + "objects.0.radius=0.4"), 2, "cube.json with --set objects.0.radius: objects.0: ");
  expectError(run(command + "max_substeps_per_frame=2"), 2,
              "cube.json with --set max_substeps_per_frame: objects.0: needs more than ");
  expectError(run(command + "impactors.0.position=[0,0.5,0] --set objects.0.position=[0,0.1,0]"), 2,
              "cube.json with --set impactors.0.position, --set objects.0.position: impactors.0: starts ");
  expectError(run(command + "dust.backend=gl"), 2, "--set: dust.backend: ");
}

TEST_F(Program, InfoSaysWhatASceneNeeds) {
  m_folder.write("small.json", kSmallWall);
  const ChildResult result = run("info small.json --set debris=null");
  EXPECT_EQ(result.exitCode, 0) << result.error;
  // 0.5 x 0.5 x 0.08 m of 2400 kg/m^3.
  for (const char* text :
       {"128, radius", "48 kg", "stable substep", "16^3 cells", "debris                none", "OpenGL"})
    EXPECT_NE(result.out.find(text), std::string::npos) << text << " in\n" << result.out;
  EXPECT_FALSE(exists("out"));
}

TEST_F(Program, ReportComparesPrecisionsAndSubsteps) {
  m_folder.write("small.json", kSmallWall);
  const ChildResult result = run("report small.json --frames 2 --out report");
  EXPECT_EQ(result.exitCode, 0) << result.error;
  std::ifstream table(m_folder.path() / "report/small.csv");
  int rows = 0;
  for (std::string line; std::getline(table, line);) ++rows;
  EXPECT_EQ(rows, 7);  // a head, and three substeps in each of two precisions
}

// Neither is waited for: a pipe without a writer would be waited for without end.
TEST_F(Program, FoldersAndPipesAreNoScenesAndNoAssets) {
  for (const char* name : {"a.json", "a.rubble-asset"}) {
    std::filesystem::create_directory(m_folder.path() / name);
    expectError(run(std::string("info ") + name), 2, std::string(name) + ": is a folder");
    std::filesystem::remove(m_folder.path() / name);
    ASSERT_EQ(mkfifo((m_folder.path() / name).c_str(), 0600), 0);
    expectError(run(std::string("info ") + name), 2, std::string(name) + ": is a pipe");
  }
}

TEST_F(Program, AnAssetCanBeShownAndNothingElse) {
  m_folder.write("a.rubble-asset", "no asset");
  for (const char* command : {"run", "view", "report"})
    expectError(run(std::string(command) + " a.rubble-asset"), 2,
                "a.rubble-asset: is an asset, must be a scene");
  expectError(run("info a.rubble-asset --frames 3"), 2,
              "--frames: frames: changes a scene and not an asset, must be left out");
}

TEST_F(Program, AFullDiskIsExitCode1AndOneLine) {
  m_folder.write("small.json", kSmallWall);
  expectError(run("run small.json --no-render --frames 1 --stats /dev/full"), 1,
              "/dev/full: cannot be written: No space");
  expectError(run("run small.json --no-render --frames 5 --events /dev/full"), 1,
              "/dev/full: cannot be written: No space");
}

// 4 blocks of 512 bytes hold two lines of statistics, not five.
TEST_F(Program, StatisticsOfAFullDiskEndWithAWholeFrame) {
  m_folder.write("small.json", kSmallWall);
  const ChildResult result =
      runChild("cd " + m_folder.path().string() +
                   " && trap '' XFSZ && ulimit -f 4 && " RUBBLE_PROGRAM " run small.json --no-render",
               m_folder.path());
  expectError(result, 1, "stats.jsonl: cannot be written");
  std::ifstream stats(m_folder.path() / "out/small/stats.jsonl");
  int frames = 0;
  for (std::string line; std::getline(stats, line); ++frames) {
    EXPECT_FALSE(stats.eof()) << "the last line has no end";
    EXPECT_TRUE(nlohmann::json::accept(line)) << line;
  }
  EXPECT_GT(frames, 0);
  EXPECT_LT(frames, 5);
}

// Nobody can make a folder in /proc.
TEST_F(Program, AFolderThatCannotBeMadeIsExitCode1) {
  m_folder.write("small.json", kSmallWall);
  expectError(run("run small.json --no-render --out /proc/rubble"), 1, "/proc/rubble: cannot be written");
  expectError(run("report small.json --frames 1 --out /proc/rubble"), 1, "cannot be written");
}

TEST_F(Program, StandardOutputOnAFullDiskIsExitCode1) {
  m_folder.write("small.json", kSmallWall);
  const ChildResult result = runChild(
      "(" RUBBLE_PROGRAM " info " + m_folder.path().string() + "/small.json >/dev/full)", m_folder.path());
  expectError(result, 1, "standard output");
}

TEST_F(Program, MemoryThatIsNotThereIsExitCode1) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "the sanitizer itself needs more than the limit";
#endif
  m_folder.write("small.json", kSmallWall);
  // [KiB]; a grid of 256^3 cells needs more than that for its velocities alone.
  const ChildResult result = runChild("ulimit -v 250000; " RUBBLE_PROGRAM " run " + m_folder.path().string() +
                                          "/small.json --no-render --threads 1 --set dust.resolution=256",
                                      m_folder.path());
  expectError(result, 1, "out of memory");
}

// Contacts that need a shorter substep than the elements alone, more than were allowed.
// Stiff contacts: the block alone needs the substeps that `info` tells, and four times as many on the ground.
TEST_F(Program, ContactsTooStiffForTheSubstepsAllowedAreSoftenedAndToldOf) {
  const auto scene = [](const std::string& substeps) {
    return R"({"frames": 30, "breaking": false, "statics": [{"shape": "plane"}], "max_substeps_per_frame": )" +
           substeps + R"(, "objects": [{"size": [0.5, 0.5, 0.5], "position": [0, 0.3, 0], "elements": 128,
               "regime": "elements", "material": {"contact_stiffness": 20}}]})";
  };
  m_folder.write("tight.json", scene("1000"));
  const ChildResult info = run("info tight.json");
  const std::size_t end = info.out.find(" substeps a frame");
  ASSERT_NE(end, std::string::npos) << info.out;
  const std::size_t begin = info.out.rfind(' ', end - 1) + 1;
  m_folder.write("tight.json", scene(info.out.substr(begin, end - begin)));
  const ChildResult softened =
      runChild("cd " + m_folder.path().string() + " && " RUBBLE_PROGRAM " run tight.json --no-render",
               m_folder.path());
  EXPECT_EQ(softened.exitCode, 0) << softened.error;
  EXPECT_NE(softened.error.find("warning: object 0: its contacts would need a substep of"), std::string::npos)
      << softened.error;
  EXPECT_NE(softened.error.find("of their stiffness until they part"), std::string::npos) << softened.error;
  // They still bear its 300 kg, which fall 5 cm and sink in by less than one.
  std::ifstream stats(m_folder.path() / "out/tight/stats.jsonl");
  nlohmann::json last;
  for (std::string line; std::getline(stats, line);) last = nlohmann::json::parse(line);
  EXPECT_LT(last["energy_J"]["error"].get<double>(), 1e-3);
  EXPECT_NEAR(last["energy_J"]["gravity"].get<double>(), 300 * 9.81 * 0.055, 300 * 9.81 * 0.005);
}

// Material as soft as E = 1 Pa and 1 kPa, thrown and turned at the highest speeds that a scene may have, and
// nothing may break: no substep follows that.
TEST_F(Program, NumbersThatRunAwayStopTheRunWithExitCode3AndTheCause) {
  const auto stop = [&](const std::string& scene, const std::string& words) {
    m_folder.write("wild.json", scene);
    expectError(
        runChild("cd " + m_folder.path().string() + " && " RUBBLE_PROGRAM " run wild.json --no-render",
                 m_folder.path()),
        3, words);
    EXPECT_TRUE(exists("out/wild/stats.jsonl"));
  };
  const std::string spinning =
      R"({"frames": 6, "fps": 1, "bullet_rate": 1, "max_substeps_per_frame": 1000, "breaking": false,
           "precision": "double", "gravity": [0, -1000, 0],
           "objects": [{"size": [3.6, 3.6, 0.18], "elements": 40, "velocity": [0, -10000, 0],
                        "spin": [-10000, 10000, 10000],
                        "regime": "elements", "material": {"youngs_modulus": 1, "spring_damping": 0.5}}]})";
  stop(spinning,
       "object 0 (concrete_soft, 3.6 m tall): its elements move or turn faster than light, the fastest of "
       "them ");
  stop(spinning,
       "of its tick; lower substep_safety, or look for units other than metres, seconds, kilograms; its own");
  stop(spinning, "strength of 2 MPa (tick 0, after 0 s)");
  // What its weight foretells is said with it: rho g H = 1e5 kg/m^3 x 1000 m/s^2 x 0.16 m.
  stop(R"({"frames": 6, "breaking": false, "precision": "double", "gravity": [0, 1000, 0],
           "objects": [{"size": [0.16, 0.16, 0.16], "elements": 40, "velocity": [0, 0, 10000],
                        "spin": [10000, 10000, -10000], "anchor": [0, -1, 0], "regime": "elements",
                        "material": {"youngs_modulus": 1000, "density": 100000}}]})",
       "kilograms; its own weight pulls at its top with 16 MPa, more than its tensile strength of 200 kPa");
}

// Before the first of its runs, most of which draw.
TEST_F(Program, WithoutEglABenchWithPicturesIsRefusedAtOnce) {
  const std::string preload =
      "ASAN_OPTIONS=verify_asan_link_order=0 LD_PRELOAD=" WITHOUT_EGL " " RUBBLE_PROGRAM;
  const ChildResult result =
      runChild("cd " + m_folder.path().string() + " && " + preload + " bench paper --frames 1 --csv a.csv",
               m_folder.path());
  expectError(result, 1, "libEGL.so.1 cannot be loaded; --no-render does without");
  EXPECT_EQ(lines(result.error), 1) << result.error;
  EXPECT_FALSE(exists("a.csv"));
}

// Said before the long work, which would announce itself.
TEST_F(Program, WithoutEglPicturesAreRefusedAtOnce) {
  m_folder.write("small.json", kSmallWall);
  // The address sanitizer would rather be the first library.
  const std::string preload =
      "ASAN_OPTIONS=verify_asan_link_order=0 LD_PRELOAD=" WITHOUT_EGL " " RUBBLE_PROGRAM;
  const std::string arguments = " run small.json --frames 1";
  const auto start = [&](const std::string& command) {
    return runChild("cd " + m_folder.path().string() + " && " + command, m_folder.path());
  };
  const ChildResult result = start(preload + arguments);
  expectError(result, 1, "libEGL.so.1 cannot be loaded; --no-render does without");
  EXPECT_EQ(lines(result.error), 1) << result.error;
  EXPECT_FALSE(exists("out"));
  EXPECT_EQ(start(preload + arguments + " --no-render").exitCode, 0);
  EXPECT_EQ(start(preload + " info small.json").exitCode, 0);
}

TEST_F(Program, ShadersThatAreNotInstalledAreExitCode1) {
  m_folder.write("small.json", kSmallWall);
  const ChildResult result = runChild(
      "cd " + m_folder.path().string() + " && RUBBLE_DATA=none " RUBBLE_PROGRAM " run small.json --frames 1",
      m_folder.path());
  expectError(result, 1, "");
  EXPECT_FALSE(exists("out"));
}

TEST_F(Program, InfoOfASceneWithDustOnGlIsWhole) {
  m_folder.write("small.json", kSmallWall);
  const ChildResult result = run("info small.json --set dust.backend=gl");
  EXPECT_EQ(result.exitCode, 0) << result.error;
  for (const char* text : {"16^3 cells", "needed: dust.backend is gl", "debris"})
    EXPECT_NE(result.out.find(text), std::string::npos) << text << " in\n" << result.out;
}

TEST_F(Program, HelpListsTheExitCodes) {
  for (const char* arguments : {"--help", "run --help"})
    EXPECT_NE(run(arguments).out.find("Exit codes: 0 done"), std::string::npos) << arguments;
}

TEST_F(Program, HelpAndVersionAreNoErrors) {
  EXPECT_EQ(run("--help").exitCode, 0);
  EXPECT_EQ(run("run --help").exitCode, 0);
  EXPECT_EQ(run("--version").out.find("rubble "), 0u);
}

}  // namespace
}  // namespace rubble::test
