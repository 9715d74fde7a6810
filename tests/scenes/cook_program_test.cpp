// `rubble cook` from outside: what it makes, what it refuses, and that nothing is left of what it refuses.
#include <array>
#include <bit>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>

#include "demo/world.h"
#include "rubble/asset.h"
#include "scenes/program.h"
#include "unit/cook/shapes.h"

namespace rubble::test {
namespace {

// A box of 2 x 1 x 0.5 with quadrilaterals, as modellers write it.
constexpr const char* kBox =
    "v 0 0 0\nv 2 0 0\nv 2 1 0\nv 0 1 0\nv 0 0 .5\nv 2 0 .5\nv 2 1 .5\nv 0 1 .5\n"
    "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 3 4 8 7\nf 2 3 7 6\nf 1 5 8 4\n";
// The corner of a cube: volume 1/6.
constexpr const char* kCorner =
    "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n";

std::string cornerAsBinaryStl() {
  std::string bytes(80, ' ');
  const auto append = [&bytes](auto value) {
    const auto raw = std::bit_cast<std::array<char, sizeof(value)>>(value);
    bytes.append(raw.data(), raw.size());
  };
  append(std::uint32_t(4));
  const std::array<std::array<float, 3>, 4> points = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  for (const std::array<std::size_t, 3>& triangle :
       {std::array<std::size_t, 3>{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}) {
    for (int k = 0; k < 3; ++k) append(0.0f);
    for (const std::size_t corner : triangle)
      for (const float x : points[corner]) append(x);
    append(std::uint16_t(0));
  }
  return bytes;
}

class CookProgram : public Program {
 protected:
  Asset cooked(const std::string& name) const { return load(m_folder.path() / name); }
  std::string lastHash(const std::string& name) const {
    std::ifstream stats(m_folder.path() / name);
    std::string hash = "none in " + name;
    for (std::string line; std::getline(stats, line);) hash = nlohmann::json::parse(line)["hash"].dump();
    return hash;
  }
  // Of the elements of the scene's first object.
  std::vector<Eigen::Vector3f> startingPlaces(const std::string& name) const {
    const demo::Scene scene = demo::loadScene(m_folder.path() / name);
    const demo::World world(scene, demo::cookObjects(scene));
    std::vector<ElementPose> poses(world.destruction().bodies()[0]->asset()->elementCount());
    world.destruction().bodies()[0]->poses(poses);
    std::vector<Eigen::Vector3f> places;
    for (const ElementPose& pose : poses) places.push_back(pose.position);
    return places;
  }
  // Refused, and nothing but the files of the test is there.
  void expectRefused(const std::string& arguments, const std::string& words) {
    const ChildResult result = run("cook " + arguments);
    expectError(result, 2, words);
    for (const auto& entry : std::filesystem::directory_iterator(m_folder.path()))
      EXPECT_EQ(entry.path().filename().string().find(".rubble-asset"), std::string::npos) << entry.path();
  }
};

TEST_F(CookProgram, MakesAnAssetThatLoadsAndSaysWhatIsInIt) {
  m_folder.write("box.obj", kBox);
  const ChildResult result = run("cook box.obj -o box.rubble-asset --elements 100 --anchor 0,-1,0");
  EXPECT_EQ(result.exitCode, 0) << result.error;
  const Asset asset = cooked("box.rubble-asset");
  EXPECT_EQ(asset.elementCount(), 100u);
  EXPECT_NEAR(asset.volume(), 1, 1e-9);
  double anchored = 0;  // the face y = 0 of 2 x 0.5
  for (const AssetAnchor& anchor : asset.anchors) {
    anchored += anchor.area;
    EXPECT_NEAR(anchor.point.y(), 0, 1e-9);
  }
  EXPECT_NEAR(anchored, 1, 1e-9);
  const std::string counts = "100 elements, " + std::to_string(asset.springs.size()) + " springs, " +
                             std::to_string(asset.anchors.size()) + " anchors, radius ";
  EXPECT_EQ(result.out.find("box.rubble-asset: " + counts), 0u) << result.out;
  EXPECT_NE(result.out.find(", volume 1 m^3, "), std::string::npos) << result.out;
  EXPECT_EQ(lines(result.out), 1) << result.out;

  const ChildResult info = run("info box.rubble-asset");
  EXPECT_EQ(info.exitCode, 0) << info.error;
  for (const std::string& text :
       {std::string("100, radius "),
        std::to_string(asset.springs.size()) + " and " + std::to_string(asset.anchors.size()) + " anchors",
        std::string("1 m^3")})
    EXPECT_NE(info.out.find(text), std::string::npos) << text << " in\n" << info.out;
}

// The asset keeps the preset; a scene takes it where it says nothing else, 2500 kg/m^3 of glass_soft.
TEST_F(CookProgram, KeepsTheMaterialItWasCookedFor) {
  m_folder.write("box.obj", kBox);
  ASSERT_EQ(run("cook box.obj -o box.rubble-asset --elements 60 --material glass_soft").exitCode, 0);
  EXPECT_EQ(cooked("box.rubble-asset").material().name, "glass_soft");
  EXPECT_NE(run("info box.rubble-asset").out.find("glass_soft"), std::string::npos);
  m_folder.write("scene.json", R"({"frames": 1, "objects": [{"asset": "box.rubble-asset"}]})");
  const auto expectInfo = [&](const std::string& options, const std::string& words) {
    const std::string text = run("info scene.json " + options).out;
    EXPECT_NE(text.find(words), std::string::npos) << words << " in\n" << text;
  };
  expectInfo("", "object 0, glass_soft\n");
  expectInfo("", "2500 kg");
  expectInfo("--set objects.0.material.density=1000", "object 0, glass_soft\n");
  expectInfo("--set objects.0.material.density=1000", "1000 kg");
  expectInfo("--set objects.0.material.preset=brick_soft", "1900 kg");
}

// 800 units long; nothing is refused.
TEST_F(CookProgram, WarnsOfAMeshThatLooksLikeMillimetres) {
  m_folder.write("long.obj",
                 "v 0 0 0\nv 800 0 0\nv 0 300 0\nv 0 0 300\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n");
  const std::string warning =
      "rubble: warning: long.obj: is 800 m long; if its units are millimetres, cook it with --scale 0.001\n";
  const auto told = [&](const std::string& scale) {
    const ChildResult result = runThatMayWarn("cook long.obj -o a.rubble-asset --elements 20" + scale);
    EXPECT_EQ(result.exitCode, 0) << result.error;
    return result.error;
  };
  EXPECT_EQ(told("").find(warning), 0u) << told("");
  EXPECT_EQ(told(" --scale 1").find("millimetres"), std::string::npos);
  EXPECT_EQ(told(" --scale 0.001").find("millimetres"), std::string::npos);
}

// In metres, of the mesh as scaled: the faces y = 0 and y = 1 of 2 x 0.5, each by a box of its own.
TEST_F(CookProgram, TiesWhatIsInBoxes) {
  m_folder.write("box.obj", kBox);
  const std::string common = "cook box.obj -o box.rubble-asset --elements 100 ";
  const ChildResult result =
      run(common + "--anchor-box -9,-0.01,-9,9,0.01,9 --anchor-box 9,1.01,9,-9,0.99,-9");
  ASSERT_EQ(result.exitCode, 0) << result.error;
  double tied = 0;
  for (const AssetAnchor& anchor : cooked("box.rubble-asset").anchors) tied += anchor.area;
  EXPECT_NEAR(tied, 2, 1e-9);
  EXPECT_NE(result.out.find(" anchors, radius "), std::string::npos);
}

TEST_F(CookProgram, RefusesBoxesThatTieNothing) {
  m_folder.write("box.obj", kBox);
  expectRefused("box.obj -o a.rubble-asset --elements 60 --anchor-box 7,7,7,8,8,8",
                "in the anchor box (7, 7, 7) to (8, 8, 8) m; the mesh is from ");
  for (const char* box : {"7,7,7,8,8", "0,0,0,1,1,nan", "here", "''"})
    expectRefused(std::string("box.obj -o a.rubble-asset --anchor-box ") + box, "--anchor-box");
}

// The counts are those of the asset's own list, and of its cells where it has none.
TEST_F(CookProgram, InfoTellsTheMaterials) {
  std::string painted = kBox;
  painted.insert(painted.find("f 1 4"), "usemtl old stone\n");
  painted.insert(painted.find("f 5 6"), "usemtl paint\n");
  m_folder.write("painted.obj", painted);
  m_folder.write("box.obj", kBox);
  const auto lineOf = [](std::size_t number, const std::string& name, std::size_t count) {
    return std::to_string(number) + ", " + name + ": " + std::to_string(count) + " triangles\n";
  };
  for (const char* name : {"painted", "box"})
    ASSERT_EQ(run(std::string("cook ") + name + ".obj -o " + name + ".rubble-asset --elements 50").exitCode,
              0);
  const std::vector<std::uint16_t> materials = cooked("painted.rubble-asset").materials;
  const auto countOf = [&](int m) { return std::size_t(std::ranges::count(materials, m)); };
  ASSERT_GT(std::min({countOf(0), countOf(1), countOf(2)}), 1u);
  const std::string info = run("info painted.rubble-asset").out;
  for (const std::string& line : {"materials             " + lineOf(0, "old stone", countOf(0)),
                                  lineOf(1, "paint", countOf(1)), lineOf(2, "inner faces", countOf(2))})
    EXPECT_NE(info.find(line), std::string::npos) << line << " in\n" << info;

  const Asset box = cooked("box.rubble-asset");
  std::size_t outer = 0;
  for (const Cell& cell : box.cells) outer += cell.outerTriangles;
  const std::string plain = run("info box.rubble-asset").out;
  for (const std::string& line :
       {lineOf(0, "the mesh, without a name", outer), lineOf(1, "inner faces", box.triangles.size() - outer)})
    EXPECT_NE(plain.find(line), std::string::npos) << line << " in\n" << plain;
}

TEST_F(CookProgram, TakesTheOtherFormats) {
  m_folder.write("a.off", kCorner);
  m_folder.write("b.stl", cornerAsBinaryStl());
  for (const char* name : {"a.off", "b.stl"}) {
    const ChildResult result = run(std::string("cook ") + name + " -o c.rubble-asset --elements 100");
    EXPECT_EQ(result.exitCode, 0) << result.error;
    EXPECT_NEAR(cooked("c.rubble-asset").volume(), 1.0 / 6, 1e-9) << name;
  }
}

TEST_F(CookProgram, ARadiusAloneSaysHowManyElements) {
  m_folder.write("box.obj", kBox);
  const ChildResult result = run("cook box.obj -o box.rubble-asset --radius 0.05");
  EXPECT_EQ(result.exitCode, 0) << result.error;
  const Asset asset = cooked("box.rubble-asset");
  EXPECT_EQ(asset.radius, 0.05);
  // 0.48 of the solid's 1 m^3, in balls of this radius.
  EXPECT_EQ(asset.elementCount(),
            std::size_t(std::round(0.48 / (4.0 / 3 * std::numbers::pi * 0.05 * 0.05 * 0.05))));
}

TEST_F(CookProgram, ScalesAndKeepsTheSeed) {
  m_folder.write("box.obj", kBox);
  const auto cookedWith = [&](const std::string& arguments) {
    EXPECT_EQ(run("cook box.obj -o box.rubble-asset --elements 50 --scale 0.1 " + arguments).exitCode, 0);
    return cooked("box.rubble-asset");
  };
  const Asset first = cookedWith("--seed 7"), again = cookedWith("--seed 7"), other = cookedWith("--seed 8");
  EXPECT_NEAR(first.volume(), 1e-3, 1e-12);
  EXPECT_EQ(first.positions, again.positions);
  EXPECT_NE(first.positions, other.positions);
}

TEST_F(CookProgram, RefusesMeshesByFileAndFault) {
  m_folder.write("open.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\n");
  expectRefused("open.obj -o a.rubble-asset", "open.obj: mesh: not closed: the edge from ");
  m_folder.write("empty.obj", "");
  expectRefused("empty.obj -o a.rubble-asset", "empty.obj: holds no faces that can be read as OBJ");
  m_folder.write("nan.obj", "v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  expectRefused("nan.obj -o a.rubble-asset", "nan.obj: line 1 is no vertex; allowed: ");
  m_folder.write("a.off", kCorner);
  expectRefused("a.off -o a.rubble-asset --scale 1e-5", "a.off: is 1.73205e-05 m across");
  m_folder.write("box.obj", kBox);
  std::filesystem::create_directory(m_folder.path() / "folder.obj");
  expectRefused("folder.obj -o a.rubble-asset", "folder.obj: is a folder; allowed: a mesh file");
  expectRefused("none.obj -o a.rubble-asset", "none.obj: no such file");
  expectRefused("a.off -o a.rubble-asset --elements 20 --radius 0.2",
                "a.off: cook: 20 elements of radius 0.2");
  expectRefused("box.obj -o a.rubble-asset --elements 100 --anchor 1,-1,0",
                "--anchor: box.obj: has no flat side");
}

// A box without one of its sides, of 1 x 0.5 m, and with one triangle turned.
TEST_F(CookProgram, RepairsAndSaysWhat) {
  const std::string box =
      "v 0 0 0\nv 2 0 0\nv 2 1 0\nv 0 1 0\nv 0 0 .5\nv 2 0 .5\nv 2 1 .5\nv 0 1 .5\n"
      "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 3 4 8 7\nf 1 5 8\nf 1 4 8\n";
  m_folder.write("box.obj", box);
  expectRefused("box.obj -o a.rubble-asset",
                "--repair mends that: filled 1 hole of 4 edges, 0.5 m^2, turned 1");
  const ChildResult result = run("cook box.obj -o box.rubble-asset --elements 100 --repair");
  EXPECT_EQ(result.exitCode, 0) << result.error;
  for (const char* line :
       {"rubble: box.obj: filled 1 hole of 4 edges, 0.5 m^2\n", "rubble: box.obj: turned 1 triangle\n"})
    EXPECT_NE(result.error.find(line), std::string::npos) << result.error;
  EXPECT_EQ(lines(result.out), 1) << result.out;
  EXPECT_NEAR(cooked("box.rubble-asset").volume(), 1, 1e-9);

  m_folder.write("good.obj", kBox);
  const ChildResult good = run("cook good.obj -o good.rubble-asset --elements 100 --repair");
  EXPECT_NE(good.error.find("rubble: good.obj: nothing to repair\n"), std::string::npos) << good.error;
  EXPECT_NE(run("cook --help").out.find("--repair"), std::string::npos);
}

// A sheet of two triangles holds nothing; a solid that has no room for its elements is no fault of the mesh.
TEST_F(CookProgram, PointsToRepairOnlyWhereItHelps) {
  m_folder.write("sheet.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 1\nf 1 2 3\nf 2 4 3\n");
  m_folder.write("a.off", kCorner);
  for (const char* arguments :
       {"sheet.obj -o a.rubble-asset", "a.off -o a.rubble-asset --elements 20 --radius 0.2"}) {
    const ChildResult result = run(std::string("cook ") + arguments);
    expectError(result, 2, "");
    EXPECT_EQ(result.error.find("repair"), std::string::npos) << result.error;
  }
  expectRefused("sheet.obj -o a.rubble-asset --repair", "sheet.obj: mesh: not closed");
}

TEST_F(CookProgram, RefusesArgumentsBeforeTheMeshIsLookedAt) {
  m_folder.write("a.off", kCorner);
  for (const char* arguments : {"",
                                "a.off",
                                "-o a.rubble-asset",
                                "'' -o a.rubble-asset",
                                "a.off -o ''",
                                "a.off -o a.asset",
                                "a.off -o a.off",
                                "a.off -o none/a.rubble-asset",
                                "a.off -o .",
                                "a.off -o a.rubble-asset --elements 0",
                                "a.off -o a.rubble-asset --elements -5",
                                "a.off -o a.rubble-asset --elements 10000001",
                                "a.off -o a.rubble-asset --elements many",
                                "a.off -o a.rubble-asset --radius 0",
                                "a.off -o a.rubble-asset --radius nan",
                                "a.off -o a.rubble-asset --radius 1e-6",
                                "a.off -o a.rubble-asset --scale 0",
                                "a.off -o a.rubble-asset --scale inf",
                                "a.off -o a.rubble-asset --anchor 0,0,0",
                                "a.off -o a.rubble-asset --anchor up",
                                "a.off -o a.rubble-asset --anchor 0,1",
                                "a.off -o a.rubble-asset --anchor 0,1,nan",
                                "a.off -o a.rubble-asset --anchor ''",
                                "a.off -o a.rubble-asset --material cheese",
                                "a.off -o a.rubble-asset --seed -1",
                                "a.off -o a.rubble-asset --wat"}) {
    SCOPED_TRACE(arguments);
    expectRefused(arguments, "");
  }
  EXPECT_EQ(std::filesystem::file_size(m_folder.path() / "a.off"), std::string(kCorner).size());
}

// Four blocks of 512 bytes hold no asset of 100 elements.
TEST_F(CookProgram, AFullDiskIsExitCode1AndLeavesNoHalfFile) {
  m_folder.write("a.off", kCorner);
  m_folder.write("a.rubble-asset", "the old one");
  const ChildResult result = runChild("cd " + m_folder.path().string() +
                                          " && trap '' XFSZ && ulimit -f 4 && " RUBBLE_PROGRAM
                                          " cook a.off -o a.rubble-asset --elements 100",
                                      m_folder.path());
  expectError(result, 1, "a.rubble-asset: cannot be written");
  EXPECT_EQ(std::filesystem::file_size(m_folder.path() / "a.rubble-asset"), 11u);
  int assets = 0;
  for (const auto& entry : std::filesystem::directory_iterator(m_folder.path()))
    assets += entry.path().filename().string().starts_with("a.rubble-asset");
  EXPECT_EQ(assets, 1);
}

TEST_F(CookProgram, AFolderThatCannotBeWrittenIsExitCode1) {
  m_folder.write("a.obj", kBox);
  expectError(run("cook a.obj -o /proc/a.rubble-asset"), 1, "/proc/a.rubble-asset: cannot be written");
}

TEST_F(CookProgram, ScenesRepairMeshes) {
  m_folder.write("open.obj",
                 "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
                 "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 3 4 8 7\nf 2 3 7 6\n");
  m_folder.write("scene.json", R"({"frames": 1, "objects": [{"mesh": "open.obj", "elements": 100}]})");
  expectError(run("run scene.json --no-render"), 2,
              "\"repair\": true mends that: filled 1 hole of 4 edges, 1 m^2");
  const ChildResult mended = run("run scene.json --no-render --set objects.0.repair=true");
  EXPECT_EQ(mended.exitCode, 0) << mended.error;
}

// The mesh lies beside the scene's file, not in the working folder.
TEST_F(CookProgram, ScenesTakeMeshesAndAssets) {
  const std::filesystem::path below = m_folder.path() / "below";
  std::filesystem::create_directory(below);
  m_folder.write("below/box.obj", kBox);
  m_folder.write("below/mesh.json", R"({"frames": 2, "statics": [{"shape": "plane"}],
      "objects": [{"mesh": "box.obj", "scale": 0.5, "elements": 60, "anchor": [0, -1, 0]}]})");
  // 2 x 1 x 0.5 m, halved, of 2400 kg/m^3.
  const ChildResult info = run("info below/mesh.json");
  EXPECT_EQ(info.exitCode, 0) << info.error;
  for (const char* text : {"60, radius ", "0.125 m^3", "300 kg"})
    EXPECT_NE(info.out.find(text), std::string::npos) << text << " in\n" << info.out;
  EXPECT_EQ(run("run below/mesh.json --no-render").exitCode, 0);

  // Cooked with the same numbers it is the same object: the runs agree to the last bit.
  ASSERT_EQ(
      run("cook below/box.obj -o below/box.rubble-asset --scale 0.5 --elements 60 --anchor 0,-1,0").exitCode,
      0);
  m_folder.write("below/asset.json",
                 R"({"extends": "mesh.json", "objects": [{"asset": "box.rubble-asset"}]})");
  EXPECT_EQ(run("run below/asset.json --no-render").exitCode, 0);
  EXPECT_EQ(lastHash("out/mesh/stats.jsonl"), lastHash("out/asset/stats.jsonl"));
}

// A run of what was cooked before is the run of what is cooked now, to the last bit, and what is kept is the
// file that `rubble cook` makes.
TEST_F(CookProgram, ScenesTakeFromTheCacheWhatTheyCookedBefore) {
  m_folder.write("box.obj", kBox);
  m_folder.write("mesh.json", R"({"frames": 3, "statics": [{"shape": "plane"}],
      "impactors": [{"shape": "sphere", "mass": 50, "radius": 0.1, "position": [1, 0.5, -0.2], "velocity": [0, 0, 10]}],
      "objects": [{"mesh": "box.obj", "elements": 60, "anchor": [0, -1, 0]}]})");
  const auto hashOf = [&](const std::string& options, const std::string& words) {
    const ChildResult result = run("run mesh.json --no-render " + options);
    EXPECT_EQ(result.exitCode, 0) << result.error;
    EXPECT_NE(result.error.find(words), std::string::npos) << options << '\n' << result.error;
    return lastHash("out/mesh/stats.jsonl");
  };
  const std::string fresh = hashOf("--no-cache", "mesh: cooking, ");
  EXPECT_EQ(hashOf("--cache kept", "mesh: cooking, "), fresh);
  EXPECT_EQ(hashOf("--cache kept", "mesh: taken from kept/"), fresh);
  EXPECT_EQ(hashOf("--no-cache", "mesh: cooking, "), fresh);
  EXPECT_NE(run("info mesh.json --cache kept").error.find("taken from kept/"), std::string::npos);
  EXPECT_NE(hashOf("--cache kept --seed 2", "mesh: cooking, "), fresh);

  ASSERT_EQ(run("cook box.obj -o box.rubble-asset --elements 60 --anchor 0,-1,0").exitCode, 0);
  bool isKept = false;
  for (const auto& entry : std::filesystem::directory_iterator(m_folder.path() / "kept"))
    isKept = isKept || fileBytes(entry.path()) == fileBytes(m_folder.path() / "box.rubble-asset");
  EXPECT_TRUE(isKept);

  // Without a word of it, beside the caches of other programs.
  m_folder.write("other.json", R"({"extends": "mesh.json", "seed": 3})");
  run("info other.json");
  EXPECT_NE(run("info other.json").error.find("other: taken from " + childCache().string() + "/rubble/"),
            std::string::npos);
  expectError(run("run mesh.json --cache kept --no-cache"), 2, "--no-cache");
}

// The box at geo-coordinates, an easting and a northing, all of whose corners doubles hold.
TEST_F(CookProgram, ScenesTakeSolidsAtGeoCoordinates) {
  std::string far;
  std::istringstream rows(kBox);
  for (std::string row; std::getline(rows, row); far += '\n') {
    double x = 0, y = 0, z = 0;
    if (std::sscanf(row.c_str(), "v %lf %lf %lf", &x, &y, &z) != 3) {
      far += row;
    } else {
      std::ostringstream vertex;
      vertex.precision(12);
      vertex << "v " << x + 500'000 << ' ' << y << ' ' << z + 6'000'000;
      far += vertex.str();
    }
  }
  m_folder.write("far.obj", far);
  ASSERT_EQ(run("cook far.obj -o far.rubble-asset --elements 60 --anchor 0,-1,0").exitCode, 0);
  // Its middle is 1, 0.5, 0.25 from that corner.
  EXPECT_NE(run("info far.rubble-asset").out.find("[500001, 0.5, 6000000.5] m in the mesh's coordinates"),
            std::string::npos)
      << run("info far.rubble-asset").out;

  m_folder.write("far.json", R"({"frames": 2, "objects": [{"asset": "far.rubble-asset"}]})");
  expectError(
      run("run far.json --no-render"), 2,
      "far.json: objects.0: it would stand at [500001, 0.5, 6000000.5] m, each must be -100000 to "
      "100000: beyond, the floats of the world hold no centimetres; mesh_origin = [500001, 1, 6000000] "
      "puts its middle at its position");
  const char* moved = " --set objects.0.mesh_origin=[500001,0.5,6000000.5]";
  EXPECT_EQ(run(std::string("run far.json --no-render") + moved).exitCode, 0);
  // The box cooked about the same place of it is the same object there, to the last bit.
  m_folder.write("near.json",
                 R"({"frames": 2, "objects": [{"mesh": "near.obj", "elements": 60, "anchor": [0, -1, 0]}]})");
  m_folder.write(
      "near.obj",
      "v -1 -.5 -.5\nv 1 -.5 -.5\nv 1 .5 -.5\nv -1 .5 -.5\nv -1 -.5 0\nv 1 -.5 0\nv 1 .5 0\nv -1 .5 0\n"
      "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 3 4 8 7\nf 2 3 7 6\nf 1 5 8 4\n");
  EXPECT_EQ(run("run near.json --no-render").exitCode, 0);
  EXPECT_EQ(lastHash("out/far/stats.jsonl"), lastHash("out/near/stats.jsonl"));

  // Places of the mesh count from mesh_origin and turn with the object: 7 m along -z become 7 m along -x.
  m_folder.write("turned.json", R"({"objects": [{"asset": "far.rubble-asset", "position": [3, 0, 0],
      "rotation_degrees": [0, 90, 0], "mesh_origin": [500001, 0.5, 6000007.5]}]})");
  m_folder.write("placed.json", R"({"objects": [{"asset": "far.rubble-asset", "position": [-4, 0, 0],
      "rotation_degrees": [0, 90, 0], "mesh_origin": [500001, 0.5, 6000000.5]}]})");
  const std::vector<Eigen::Vector3f> turned = startingPlaces("turned.json"),
                                     placed = startingPlaces("placed.json");
  ASSERT_EQ(turned.size(), 60u);
  for (std::size_t i = 0; i < turned.size(); ++i) EXPECT_LT((turned[i] - placed[i]).norm(), 1e-6) << i;
}

TEST_F(CookProgram, ScenesRefuseMeshesAndAssetsByKey) {
  m_folder.write("open.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\n");
  m_folder.write("bad.rubble-asset", "no asset");
  const auto refuse = [&](const std::string& object, const std::string& words) {
    m_folder.write("scene.json", R"({"objects": [)" + object + "]}");
    expectError(run("run scene.json --no-render"), 2, "scene.json: objects.0" + words);
    EXPECT_FALSE(exists("out"));
  };
  refuse(R"({"mesh": "open.obj"})", ": open.obj: mesh: not closed");
  refuse(R"({"mesh": "none.obj"})", ": none.obj: no such file");
  refuse(R"({"asset": "bad.rubble-asset"})", ": bad.rubble-asset: is not a rubble asset");
  refuse(R"({"mesh": 5})", ".mesh: is 5, must be the name of a file");
  refuse(R"({"mesh": "open.obj", "size": [1, 1, 1]})", ".size: unknown key");
  refuse(R"({"mesh": "open.obj", "asset": "bad.rubble-asset"})", ".asset: unknown key");
  refuse(R"({"asset": "bad.rubble-asset", "elements": 5})", ".elements: unknown key");
  refuse(R"({"size": [1, 1, 1], "scale": 2})", ".scale: unknown key");
  refuse(R"({"mesh": "open.obj", "scale": 0})", ".scale: is 0, must be 1e-09 to 1000000");
  refuse("{}", ".size: is missing");
}

}  // namespace
}  // namespace rubble::test
