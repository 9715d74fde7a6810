// Reading scenes: what is accepted, and the exact line that refuses everything else.
#include "demo/scene.h"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "demo/input_error.h"
#include "scenes/scene_file.h"

namespace rubble::test {
namespace {

using demo::InputError;
using demo::Override;
using demo::Scene;

class SceneFile : public testing::Test {
 protected:
  Scene load(const std::string& text, const std::vector<Override>& overrides = {}) {
    return demo::loadScene(m_folder.write("scene.json", text), overrides);
  }
  // What the scene is refused with, without the folder's name.
  std::string refusal(const std::string& text, const std::vector<Override>& overrides = {}) {
    try {
      load(text, overrides);
    } catch (const InputError& error) {
      return withoutFolder(error.what());
    }
    return "accepted";
  }
  std::string withoutFolder(std::string text) const {
    const std::string folder = m_folder.path().string() + "/";
    for (auto at = text.find(folder); at != std::string::npos; at = text.find(folder))
      text.erase(at, folder.size());
    return text;
  }
  TestFolder m_folder;
};

TEST_F(SceneFile, EmptyObjectIsTheDefaults) {
  const Scene scene = load("{}");
  EXPECT_EQ(scene.name, "scene");
  EXPECT_EQ(scene.frames, 180);
  EXPECT_EQ(scene.bulletRate, 240);
  EXPECT_EQ(scene.gravity.y(), -9.81);
  EXPECT_EQ(scene.precision, Precision::Float);
  EXPECT_TRUE(scene.objects.empty());
}

TEST_F(SceneFile, AnObjectIsWholeUnlessItSaysElements) {
  const Scene scene =
      load(R"({"objects": [{"size": [1, 1, 1]}, {"size": [1, 1, 1], "regime": "elements"}]})");
  EXPECT_EQ(scene.objects[0].regime, Regime::RigidUntilStruck);
  EXPECT_EQ(scene.objects[1].regime, Regime::Elements);
}

TEST_F(SceneFile, PartsThatAreNotNamedAreLeftOut) {
  EXPECT_FALSE(load("{}").dust);
  EXPECT_FALSE(load("{}").debris);
  EXPECT_TRUE(load(R"({"dust": {}, "debris": {}})").dust);
  EXPECT_TRUE(load(R"({"dust": {}, "debris": {}})").debris);
  EXPECT_FALSE(load(R"({"dust": {}})", {{"dust", "null"}}).dust);
}

TEST_F(SceneFile, KeysOverrideTheirPreset) {
  const Scene scene = load(R"({"objects": [{"size": [1, 1, 1],
      "material": {"friction": 0.1, "preset": "concrete_soft"},
      "model": {"debris_sizes": "mass", "preset": "paper"}}]})");
  EXPECT_EQ(scene.objects[0].material.friction, 0.1);
  EXPECT_EQ(scene.objects[0].material.youngsModulus, material("concrete_soft").youngsModulus);
  EXPECT_EQ(scene.objects[0].model.debrisSizes, DebrisSizes::Mass);
  EXPECT_EQ(scene.objects[0].model.breakCriterion, BreakCriterion::Stretch);
}

TEST_F(SceneFile, VariantChangesOnlyWhatItNames) {
  m_folder.write("base.json", R"({"frames": 7, "dust": {"resolution": 32, "opacity": 2},
      "impactors": [{"shape": "sphere", "radius": 1, "mass": 2, "velocity": [1, 2, 3]}]})");
  const Scene scene =
      load(R"({"extends": "base", "dust": {"opacity": 3}, "impactors.0.velocity": [0, 0, 4]})");
  EXPECT_EQ(scene.frames, 7);
  EXPECT_EQ(scene.dust->resolution, 32);
  EXPECT_EQ(scene.dust->opacity, 3);
  EXPECT_EQ(scene.impactors[0].radius, 1);
  EXPECT_EQ(scene.impactors[0].velocity, Eigen::Vector3d(0, 0, 4));
}

TEST_F(SceneFile, SetTakesJsonAndBareWords) {
  const Scene scene = load(R"({"impactors": [{"shape": "sphere", "radius": 1, "mass": 2}]})",
                           {{"precision", "double"},
                            {"dust.backend", "gl"},
                            {"impactors.0.velocity", "[0,0,-20]"},
                            {"frames", "3"}});
  EXPECT_EQ(scene.precision, Precision::Double);
  EXPECT_EQ(scene.dust->backend, demo::DustBackend::Gl);
  EXPECT_EQ(scene.impactors[0].velocity.z(), -20);
  EXPECT_EQ(scene.frames, 3);
}

TEST_F(SceneFile, SeedsOf53BitsAreExact) {
  EXPECT_EQ(load("{}", {{"seed", "9007199254740991"}}).seed, 9007199254740991u);
}

TEST_F(SceneFile, MissingFileIsRefused) {
  try {
    demo::loadScene((m_folder.path() / "none.json").string());
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_EQ(withoutFolder(error.what()),
              "none.json: there is no such file, must be a scene file or one of: " + demo::sceneNames());
  }
}

TEST_F(SceneFile, AFolderIsNotAScene) {
  EXPECT_THROW(demo::loadScene(m_folder.path().string()), InputError);
}

TEST_F(SceneFile, BrokenJsonIsRefusedWithItsLine) {
  EXPECT_EQ(refusal("{\n  \"frames\": 5,\n  \"fps\" 60\n}"),
            "scene.json: line 3, column 10: is not JSON here, must be an object {...}");
  EXPECT_EQ(refusal(""), "scene.json: line 1, column 1: is not JSON here, must be an object {...}");
  EXPECT_EQ(refusal("[1]"), "scene.json: is [1], must be an object {...}");
}

TEST_F(SceneFile, UnknownKeysAreRefused) {
  EXPECT_EQ(refusal(R"({"debris": {"buget": 5}})"),
            "scene.json: debris.buget: unknown key, allowed here: budget");
  EXPECT_EQ(refusal(R"({"camera": {}, "light": {"colour": 1}})"),
            "scene.json: light.colour: unknown key, allowed here: direction, ambient");
  EXPECT_EQ(refusal("{}", {{"debris.buget", "5"}}), "--set: debris.buget: unknown key, allowed here: budget");
  EXPECT_EQ(refusal("{}", {{"", "5"}}).find("--set: unknown key, allowed here: objects, impactors"), 0u);
}

TEST_F(SceneFile, KeysOfAnotherShapeAreRefused) {
  EXPECT_EQ(refusal(R"({"statics": [{"shape": "box", "size": [1, 1, 1], "offset": 2}]})"),
            "scene.json: statics.0.offset: unknown key, allowed here: shape, size, position, "
            "rotation_degrees, friction, restitution");
}

TEST_F(SceneFile, NumbersOutOfRangeAreRefused) {
  const std::string object = R"({"objects": [{"size": [1, 1, 0.08]}]})";
  EXPECT_EQ(refusal(object, {{"objects.0.radius", "-0.1"}}),
            "--set: objects.0.radius: is -0.1, must be 0 to 100000");
  EXPECT_EQ(refusal(object, {{"objects.0.radius", "0.05"}}),
            "--set: objects.0.radius: is 0.05, must be at most 0.04, half the smallest edge of the box");
  EXPECT_EQ(refusal(object, {{"objects.0.elements", "0"}}),
            "--set: objects.0.elements: is 0, must be a whole number 1 to 10000000");
  EXPECT_EQ(refusal(object, {{"objects.0.elements", "2.5"}}),
            "--set: objects.0.elements: is 2.5, must be a whole number 1 to 10000000");
  EXPECT_EQ(refusal(object, {{"frames", "-3"}}), "--set: frames: is -3, must be a whole number 1 to 1000000");
  EXPECT_EQ(refusal(object, {{"objects.0.size.1", "0"}}),
            "--set: objects.0.size.1: is 0, must be 1e-04 to 100000");
}

TEST_F(SceneFile, NotANumberIsRefused) {
  EXPECT_EQ(refusal(R"({"fps": NaN})"),
            "scene.json: line 1, column 9: is not JSON here, must be an object {...}");
  EXPECT_EQ(refusal("{}", {{"fps", "nan"}}), "--set: fps: is \"nan\", must be a number 1 to 10000");
  EXPECT_EQ(refusal("{}", {{"fps", "1e999"}}), "--set: fps: is \"1e999\", must be a number 1 to 10000");
  EXPECT_EQ(refusal(R"({"fps": 1e999})"), "scene.json: line 1, column 9: is 1e999, must be within +-1.8e308");
  EXPECT_EQ(refusal("{\n  \"gravity\": [0,\n    -1e400, 0]\n}"),
            "scene.json: line 3, column 5: is -1e400, must be within +-1.8e308");
  EXPECT_EQ(refusal("{\"fps\": 1" + std::string(400, '0') + "}"),
            "scene.json: line 1, column 9: is 1" + std::string(59, '0') + "..., must be within +-1.8e308");
  EXPECT_EQ(refusal(R"({"gravity": [0, "down", 0]})"),
            "scene.json: gravity.1: is \"down\", must be a number -1000 to 1000");
}

TEST_F(SceneFile, WrongKindsAreRefused) {
  EXPECT_EQ(refusal(R"({"objects": {}})"), "scene.json: objects: is {}, must be a list [...]");
  EXPECT_EQ(refusal(R"({"objects": [1]})"), "scene.json: objects.0: is 1, must be an object {...}");
  EXPECT_EQ(refusal(R"({"sleep": 1})"), "scene.json: sleep: is 1, must be true or false");
  EXPECT_EQ(refusal(R"({"gravity": 9})"), "scene.json: gravity: is 9, must be a list of three numbers");
  EXPECT_EQ(refusal(R"({"precision": "half"})"),
            "scene.json: precision: is \"half\", must be one of: float, double");
}

TEST_F(SceneFile, ValuesThatDoNotFitEachOtherAreRefused) {
  EXPECT_EQ(refusal(R"({"dust": {"resolution": 48}})"),
            "scene.json: dust.resolution: is 48, must be a power of two, 8 to 256");
  EXPECT_EQ(refusal(R"({"dust": {"max": [1, -1, 1]}})"),
            "scene.json: dust.max: is [1, -1, 1], must be above dust.min by 0.001 to 100000 m in x, y and z");
  EXPECT_EQ(refusal(R"({"camera": {"eye": [1, 2, 3], "target": [1, 2, 3]}})"),
            "scene.json: camera.target: is [1, 2, 3], must differ from camera.eye");
  EXPECT_EQ(refusal(R"({"bullet_rate": 30})"), "scene.json: fps: is 60, must be at most bullet_rate, 30");
  EXPECT_EQ(refusal(R"({"objects": [{"size": [1, 1, 1], "material": {"tensile_strength": 5e6}}]})"),
            "scene.json: objects.0.material.compressive_strength: is 2000000, must be at least "
            "tensile_strength, 5000000");
  EXPECT_EQ(refusal(R"({"objects": [{"size": [1, 1, 1], "anchor": [0, 0, 0]}]})"),
            "scene.json: objects.0.anchor: has no direction, must not be [0, 0, 0]");
}

TEST_F(SceneFile, RequiredKeysAreAskedFor) {
  EXPECT_EQ(refusal(R"({"impactors": [{"shape": "sphere", "mass": 1}]})"),
            "scene.json: impactors.0.radius: is missing, must be given (number, 1e-04 to 100000)");
}

TEST_F(SceneFile, AnErrorNamesTheFileThatItsValueCameFrom) {
  m_folder.write("base.json", R"({"fps": -1, "dust": {"drag": 1, "opacity": 1}})");
  EXPECT_EQ(refusal(R"({"extends": "base"})"), "base.json: fps: is -1, must be 1 to 10000");
  EXPECT_EQ(refusal(R"({"extends": "base", "fps": 30, "dust": {"drag": -2}})"),
            "scene.json: dust.drag: is -2, must be 0 to 1000");
}

// From wherever the program was started: the file's own folder counts.
TEST_F(SceneFile, ExtendsLooksBesideTheFileThatSaysIt) {
  m_folder.write("base.json", R"({"frames": 7})");
  EXPECT_EQ(load(R"({"extends": "base.json"})").frames, 7);
  EXPECT_EQ(load(R"({"extends": "./base.json"})").frames, 7);
  m_folder.write("scene.json", R"({"extends": "base"})");
  const std::filesystem::path before = std::filesystem::current_path();
  std::filesystem::current_path(m_folder.path());
  EXPECT_NO_THROW(EXPECT_EQ(demo::loadScene("scene.json").frames, 7));
  std::filesystem::current_path(before);
}

TEST_F(SceneFile, AMissingBaseIsRefusedWithTheFileThatWantsIt) {
  EXPECT_EQ(refusal(R"({"extends": "none.json"})"),
            "scene.json: extends: none.json: there is no such file, must be a scene file or one of: " +
                demo::sceneNames());
}

TEST_F(SceneFile, CirclesOfExtendsAreRefused) {
  EXPECT_EQ(refusal(R"({"extends": "scene"})"),
            "scene.json: extends: goes in a circle, must end at a whole scene");
}

TEST_F(SceneFile, PathsThroughValuesAreRefused) {
  EXPECT_EQ(refusal(R"({"frames": 5})", {{"frames.first", "1"}}),
            "--set: frames: is 5, has no keys of its own");
  EXPECT_THROW(demo::parseOverride("frames"), InputError);
  EXPECT_THROW(demo::parseOverride("=5"), InputError);
}

TEST_F(SceneFile, AnIndexBehindTheLastIsRefused) {
  const std::string one = R"({"objects": [{"size": [1, 1, 1]}]})";
  const std::string unknown = ": unknown index, allowed: ";
  const std::string known = unknown + "0, or 1 for a new entry given whole";
  for (const char* index : {"9", "1", "01", "-1", "x"}) {
    const std::string place = std::string("objects.") + index;
    EXPECT_EQ(refusal(one, {{place + ".size", "[1,1,1]"}}), "--set: " + place + known);
    m_folder.write("base.json", one);
    EXPECT_EQ(refusal("{\"extends\": \"base\", \"" + place + ".size\": [1, 1, 1]}"),
              "scene.json: " + place + known);
  }
  EXPECT_EQ(refusal(one, {{"objects.1", "null"}}), "--set: objects.1" + known);
  EXPECT_EQ(load(one, {{"objects.1", R"({"size": [1, 2, 3]})"}}).objects.size(), 2u);
  EXPECT_EQ(refusal(R"({"objects": []})", {{"objects.2.radius", "1"}}),
            "--set: objects.2" + unknown + "0 for a new entry given whole");
  EXPECT_EQ(refusal(one, {{"objects.0.size.3", "1"}}), "--set: objects.0.size.3" + unknown + "0 to 2");
  const std::string none = ": unknown index, there is no list yet: give ";
  EXPECT_EQ(refusal(one, {{"impactors.0.mass", "5"}}),
            "--set: impactors.0" + none + "impactors whole, [...]");
  EXPECT_EQ(refusal("{}", {{"gravity.1", "-3"}}), "--set: gravity.1" + none + "gravity whole, [...]");
}

// Two values that do not fit: the option is named beside the file that gave the other.
TEST_F(SceneFile, AnOptionAtFaultIsNamedBesideTheFile) {
  const std::string cube = R"({"objects": [{"size": [1, 1, 1], "radius": 0.3,
      "material": {"compressive_strength": 3e6}}], "camera": {"target": [1, 2, 3]},
      "gravity": [0, 0, -9], "dust": {"max": [1, 1, 1]}, "fps": 60})";
  const auto with = [&](const std::string& path, const std::string& value) {
    return refusal(cube, {{"dust", "null"}, {path, value}, {"frames", "9", "--frames"}});
  };
  EXPECT_EQ(with("bullet_rate", "30"),
            "scene.json with --set bullet_rate: fps: is 60, must be at most bullet_rate, 30");
  EXPECT_EQ(with("objects.0.size", "[1, 1, 0.1]"),
            "scene.json with --set objects.0.size: objects.0.radius: is 0.3, must be at most 0.05, half the "
            "smallest edge of the box");
  EXPECT_EQ(with("objects.0.size.2", "0.1").find("scene.json with --set objects.0.size.2: objects.0.radius"),
            0u);
  EXPECT_EQ(with("objects.0.material.tensile_strength", "5e6")
                .find("scene.json with --set objects.0.material.tensile_strength: objects.0.material.comp"),
            0u);
  EXPECT_EQ(with("camera.eye", "[1, 2, 3]"),
            "scene.json with --set camera.eye: camera.target: is [1, 2, 3], must differ from camera.eye");
  EXPECT_EQ(with("dust", "{}").find("scene.json with --set dust: gravity: is [0, 0, -9]"), 0u);
  EXPECT_EQ(
      with("objects.0.mesh", "ball.obj")
          .find("scene.json with --set objects.0.mesh: objects.0.size: unknown key, allowed here: mesh"),
      0u);
  // It has no part in these.
  EXPECT_EQ(with("sleep", "false"), "accepted");
  EXPECT_EQ(refusal(R"({"precise": 1})", {{"precision", "double"}}).find("scene.json: precise: unknown"), 0u);
  EXPECT_EQ(refusal(R"({"dust": {"drag": -1}})", {{"dust", R"({"opacity": 2})"}}),
            "scene.json: dust.drag: is -1, must be 0 to 1000");
}

// Where a setting made the whole object, the setting is at fault and not the file.
TEST_F(SceneFile, WhatASettingMakesIsTheSettings) {
  const std::string scene = R"({"objects": []})";
  EXPECT_EQ(refusal(scene, {{"debris.budgets.first", "1"}}).find("--set: debris.budgets: unknown key"), 0u);
  EXPECT_EQ(refusal(scene, {{"impactor.0.velocity", "[0,0,1]"}}).find("--set: impactor: unknown key"), 0u);
  EXPECT_EQ(refusal(scene, {{"objects.0", R"({"elements": 5})"}}).find("--set: objects.0.size: "), 0u);
  EXPECT_EQ(refusal(scene, {{"frames..first", "5"}}),
            "--set: frames..first: has an empty name in it, must be names joined by single dots");
  EXPECT_EQ(refusal(scene, {{".", "5"}}),
            "--set: .: has an empty name in it, must be names joined by single dots");
}

TEST_F(SceneFile, DeepNestingIsRefused) {
  const std::string deep(100000, '[');
  EXPECT_EQ(refusal("{\"objects\": " + deep), "scene.json: nested too deeply, must be at most 32 levels");
}

TEST_F(SceneFile, EveryRefusalIsOneLine) {
  EXPECT_EQ(refusal("{\"debris\": {\"a\\nb\": 1}}"),
            "scene.json: debris.a b: unknown key, allowed here: budget");
}

TEST(BundledScenes, AreAllAcceptedAndListedInTheirReadme) {
  std::ifstream file(demo::sceneFolder() / "README.md");
  std::ostringstream readme;
  readme << file.rdbuf();
  std::istringstream names(demo::sceneNames());
  int count = 0;
  for (std::string name; std::getline(names >> std::ws, name, ','); ++count) {
    EXPECT_NO_THROW(demo::loadScene(name)) << name;
    EXPECT_NE(readme.str().find("| `" + name + "` |"), std::string::npos) << name;
  }
  EXPECT_GE(count, 2);
}

// They are the paper's, or measured against a reference: as elements from the start.
TEST(BundledScenes, NameTheirRegimeExceptTheStack) {
  std::istringstream names(demo::sceneNames());
  for (std::string name; std::getline(names >> std::ws, name, ',');)
    for (const demo::SceneObject& object : demo::loadScene(name).objects)
      EXPECT_EQ(object.regime, name == "stack" ? Regime::RigidUntilStruck : Regime::Elements) << name;
}

TEST(BundledScenes, ReadmeDocumentsEveryKey) {
  std::ifstream file(demo::sceneFolder() / "README.md");
  std::ostringstream readme;
  readme << file.rdbuf();
  EXPECT_NE(readme.str().find(demo::describeKeys()), std::string::npos)
      << "demo/scenes/README.md must hold this table:\n\n"
      << demo::describeKeys();
}

}  // namespace
}  // namespace rubble::test
