// What a scene may hold but hardly means is said in words, and a run that must stop says whose numbers ran
// away.
#include <gtest/gtest.h>
#include <limits>

#include <sstream>

#include "demo/input_error.h"
#include "demo/run.h"
#include "demo/world.h"
#include "scenes/scene_file.h"

namespace rubble::test {
namespace {

using demo::InputError;
using demo::Scene;

class Advice : public testing::Test {
 protected:
  Scene load(const std::string& text) { return demo::loadScene(m_folder.write("scene.json", text)); }
  LogFunction log() {
    return [this](LogLevel level, const std::string& line) {
      if (level == LogLevel::Warning) m_warnings += line + "\n";
    };
  }
  // What making the world warns of.
  std::string warnings(const std::string& text) {
    m_warnings.clear();
    const Scene scene = load(text);
    const demo::World world(scene, demo::cookObjects(scene), log());
    const std::string folder = m_folder.path().string() + "/";
    for (auto at = m_warnings.find(folder); at != m_warnings.npos; at = m_warnings.find(folder))
      m_warnings.erase(at, folder.size());
    return m_warnings;
  }
  // An object of 8 elements and the keys that are given.
  static std::string object(const std::string& keys) {
    return R"({"objects": [{"elements": 8, )" + keys + "}]";
  }

  TestFolder m_folder;
  std::string m_warnings;
};

TEST_F(Advice, ObjectsOutsideOfTheDustBoxAreNamed) {
  const std::string dust = R"(, "dust": {"resolution": 8, "min": [-1, 0, -1], "max": [1, 2, 1]}})";
  EXPECT_EQ(warnings(object(R"("size": [1, 1, 1], "position": [0, 0.5, 0])") + dust), "");
  EXPECT_EQ(
      warnings(object(R"("size": [1, 1, 1], "position": [5, 0.5, 0])") + dust),
      "scene.json: objects.0: [4.5, 0, -0.5] to [5.5, 1, 0.5] m is outside of the dust's box, [-1, 0, -1] to "
      "[1, 2, 1] m: dust from there is lost at once; change dust.min and dust.max, or move the object\n");
  EXPECT_EQ(
      warnings(object(R"("size": [1, 3, 1], "position": [0, 1.5, 0])") + dust),
      "scene.json: objects.0: [-0.5, 0, -0.5] to [0.5, 3, 0.5] m reaches out of the dust's box, [-1, 0, -1] "
      "to [1, 2, 1] m: dust from there is lost at once; change dust.min and dust.max, or move the object\n");
  // Turned by 45 degrees a plate of 2.4 m spans 1.7 m and fits.
  EXPECT_NE(warnings(object(R"("size": [2.4, 1, 0.1], "position": [0, 0.5, 0])") + dust), "");
  EXPECT_EQ(
      warnings(object(R"("size": [2.4, 1, 0.1], "position": [0, 0.5, 0], "rotation_degrees": [0, 45, 0])") +
               dust),
      "");
}

TEST_F(Advice, FloorOfTheDustOffTheGroundIsNamed) {
  const std::string scene = object(R"("size": [1, 1, 1], "position": [0, 0.5, 0])") +
                            R"(, "statics": [{"shape": "plane", "offset": HEIGHT}],
                               "dust": {"resolution": 8, "min": [-1, -1, -1], "max": [1, 3, 1]}})";
  const auto at = [&](const std::string& height) {
    std::string text = scene;
    return warnings(text.replace(text.find("HEIGHT"), 6, height));
  };
  EXPECT_EQ(at("-1"), "");
  EXPECT_EQ(at("0"),
            "scene.json: dust.min: its y is -1 m and is ground to the dust, but the ground is at 0 m: dust "
            "will lie "
            "at the wrong height\n");
}

// A tetrahedron with edges of 800 and 50 units along the axes.
TEST_F(Advice, MeshesWhoseUnitLooksLikeMillimetresAreNamed) {
  const auto tetrahedron = [](const std::string& longest) {
    return "v 0 0 0\nv " + longest + " 0 0\nv 0 50 0\nv 0 0 50\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";
  };
  const auto told = [&](const std::string& longest, const std::string& keys) {
    const std::string mesh = m_folder.write("a.obj", tetrahedron(longest));
    const Scene scene = load(R"({"objects": [{"mesh": "a.obj", "elements": 8)" + keys + "}]}");
    m_warnings.clear();
    demo::cookObjects(scene, {}, log());
    const auto at = m_warnings.find(mesh + ": is ");
    return at == m_warnings.npos
               ? ""
               : m_warnings.substr(at + mesh.size() + 2, m_warnings.find('\n', at) - at - mesh.size() - 2);
  };
  EXPECT_EQ(told("800", ""), "is 800 m long; if its units are millimetres, give it the key \"scale\": 0.001");
  EXPECT_EQ(told("800", R"(, "scale": 1)"), "");  // metres are meant
  EXPECT_EQ(told("800", R"(, "scale": 0.001)"), "");
  EXPECT_EQ(told("100", ""), "");
}

// rho g H of concrete_soft: 2400 kg/m^3 x 9.81 m/s^2 x 300 m = 7.06 MPa against f_c = 2 MPa.
TEST_F(Advice, AWallThatItsWeightCrushesIsTold) {
  EXPECT_EQ(
      warnings(object(R"("size": [300, 300, 30], "position": [0, 150, 0], "anchor": [0, -1, 0])") + "}"),
      "object 0 (concrete_soft, 300 m tall): its own weight presses its foot with 7.06 MPa, more than its "
      "compressive strength of 2 MPa; are these millimetres?\n");
  // 30 m: 0.71 MPa
  EXPECT_EQ(warnings(object(R"("size": [30, 30, 9], "position": [0, 15, 0], "anchor": [0, -1, 0])") + "}"),
            "");
  // Lying on its side it is 30 m tall.
  EXPECT_EQ(warnings(object(R"("size": [300, 300, 30], "rotation_degrees": [90, 0, 0])") + "}"), "");
}

// Hanging, f_t = 200 kPa counts: 20 m give 471 kPa, 8 m 188 kPa.
TEST_F(Advice, AnObjectThatTearsOffItsCeilingIsTold) {
  EXPECT_EQ(warnings(object(R"("size": [5, 20, 5], "anchor": [0, 1, 0])") + "}"),
            "object 0 (concrete_soft, 20 m tall): its own weight pulls at its top with 471 kPa, more than "
            "its tensile "
            "strength of 200 kPa\n");
  EXPECT_EQ(warnings(object(R"("size": [5, 8, 5], "anchor": [0, 1, 0])") + "}"), "");
}

TEST_F(Advice, SizesThatAreHardlyMetresAreAskedAbout) {
  EXPECT_EQ(warnings(object(R"("size": [1000, 20, 20])") + "}"),
            "object 0 (concrete_soft, 20 m tall): it is 1 km long: are these millimetres?\n");
  EXPECT_EQ(
      warnings(object(R"("size": [0.0005, 0.0005, 0.0005])") + R"(, "max_substeps_per_frame": 1000000})"),
      "object 0 (concrete_soft, 0.5 mm tall): it is 0.5 mm long: lengths are metres\n");
  EXPECT_EQ(warnings(object(R"("size": [0.001, 0.001, 0.001])") + R"(, "max_substeps_per_frame": 1000000})"),
            "");
}

// A standing wall of 1000 x 1000 x 80 m, and a slab of 300 x 300 x 30 m: nothing holds them. Whether they
// fall or the run is stopped, no number is absurd: no more energy than the weight had to give.
TEST_F(Advice, WhatCannotStandFallsOrStopsWithItsNameAndCause) {
  for (const char* text :
       {R"({"frames": 6, "objects": [{"size": [1000, 1000, 80], "position": [0, 500, 0], "elements": 300,
             "anchor": [0, -1, 0], "regime": "elements"}], "statics": [{"shape": "plane"}], "debris": {}})",
        R"({"frames": 6, "objects": [{"size": [300, 300, 30], "position": [0, 150, 0], "elements": 300,
             "anchor": [0, -1, 0], "regime": "elements"}], "statics": [{"shape": "plane"}], "debris": {}})"}) {
    const Scene scene = load(text);
    demo::World world(scene, demo::cookObjects(scene), log());
    const Eigen::Vector3d size = scene.objects[0].size;
    const double weight = 2400 * size.prod() * 9.81;
    try {
      for (int frame = 0; frame < scene.frames; ++frame) {
        world.step();
        const Ledger& ledger = world.destruction().ledger();
        EXPECT_LT(ledger.kinetic + ledger.elastic + ledger.fracture, weight * size.y() / 2)
            << "frame " << frame;
      }
    } catch (const demo::RunStopped& stop) {
      const std::string said = stop.what();
      EXPECT_EQ(said.find("object 0 (concrete_soft, "), 0u) << said;
      EXPECT_NE(said.find("its own weight presses its foot"), std::string::npos) << said;
    }
  }
}

// Past every check: an element as fast as 1e13 m/s is beyond what debris are computed with.
TEST_F(Advice, NumbersThatRunAwayStopTheRunWithTheObject) {
  const Scene scene =
      load(object(R"("size": [1, 1, 1], "position": [0, 5, 0], "material": {"tensile_strength": 0,
      "compressive_strength": 1, "crush_efficiency": 1e-9}, "regime": "elements")") +
           R"(, "frames": 1, "debris": {}, "gravity": [0, 0, 0],
      "impactors": [{"shape": "sphere", "radius": 0.4, "mass": 100, "position": [0, 5, 0.92], "velocity": [0, 0, -9]}]})");
  demo::World world(scene, demo::cookObjects(scene), log());
  world.bullet().setGravity(btVector3(0, -std::numeric_limits<btScalar>::infinity(), 0));
  try {
    world.step();
    FAIL() << "ran on";
  } catch (const demo::RunStopped& stop) {
    EXPECT_EQ(std::string(stop.what()).find("object 0 (concrete_soft, 1 m tall): "), 0u) << stop.what();
  }
  EXPECT_FALSE(world.destruction().failure().empty());
}

class Hulls : public Advice {
 protected:
  std::string refusal(const std::string& points) {
    try {
      load(R"({"impactors": [{"shape": "hull", "mass": 1, "points": )" + points + "}]}");
    } catch (const InputError& error) {
      const std::string text = error.what();
      return text.substr(text.rfind('/') + 1);
    }
    return "";
  }
};

TEST_F(Hulls, WithoutVolumeAreRefused) {
  const std::string allowed =
      ", must be a body at least 0.001 of its length thick (a plate: give both of its faces)";
  const std::string key = "scene.json: impactors.0.points: ";
  EXPECT_EQ(refusal("[[1,1,1],[1,1,1],[1,1,1],[1,1,1]]"), key + "is one place" + allowed);
  EXPECT_EQ(refusal("[[0,0,0],[1,1,1],[2,2,2],[3,3,3]]"), key + "is a line" + allowed);
  EXPECT_EQ(refusal("[[0,0,0],[1,0,0],[1,1,0],[0,1,0]]"),
            key + "is flat: all points lie in one plane" + allowed);
  // Tilted, and off by rounding only.
  EXPECT_EQ(refusal("[[0,0,0],[1,0.1,0.3],[1,1.1,0.5],[0,1,0.2],[0.5,0.55,0.25]]"),
            key + "is flat: all points lie in one plane" + allowed);
  EXPECT_EQ(refusal("[[0,0,0],[1,0,0],[0,1,0],[0,0,1]]"), "");
  // 1.4 m long: 1.4 mm are asked for.
  EXPECT_NE(refusal("[[0,0,0],[1,0,0],[1,1,0],[0,1,0.0013]]"), "");
  EXPECT_EQ(refusal("[[0,0,0],[1,0,0],[1,1,0],[0,1,0],[0,0,0.0015]]"), "");
}

// As an application may make it.
TEST_F(Hulls, TheLibrarySaysWhatIsWrongWithAFlatOne) {
  Scene scene = load(
      R"({"objects": [{"elements": 8, "size": [1, 1, 1], "regime": "elements"}], "gravity": [0, 0, 0]})");
  demo::SceneBody plate;
  plate.shape = demo::SceneBody::Shape::Hull;
  plate.points = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
  plate.mass = 1;
  plate.position = {0, 0, 0.55};
  scene.impactors.push_back(plate);
  demo::World world(scene, demo::cookObjects(scene), log());
  world.step();
  EXPECT_EQ(m_warnings,
            "shape Convex does not touch the elements of destructible bodies: it has no volume (its points "
            "lie in a plane, "
            "on a line "
            "or on one place); give it thickness\n");
}

}  // namespace
}  // namespace rubble::test
