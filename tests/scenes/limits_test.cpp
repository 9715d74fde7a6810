// What a scene may say is what the library takes: each number at both ends of its documented limits, and just
// beyond them, where scene and library must both refuse.
#include "rubble/limits.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "demo/dust_setup.h"
#include "demo/input_error.h"
#include "demo/world.h"
#include "scenes/scene_file.h"

namespace rubble::test {
namespace {

using demo::InputError;
using demo::Override;
using demo::Scene;

// Soft enough for any number of substeps, and without strength where a row does not say so.
constexpr const char* kCube = R"({
  "objects": [{"size": [1, 1, 1], "elements": 8, "material": {"tensile_strength": 0}}],
  "max_substeps_per_frame": 10000000,
  "dust": {"resolution": 8}, "debris": {}
})";

// Which part of the library reads the number.
enum class Reader { Cook, World, Dust };

struct Row {
  std::string key;
  Limits limits;
  Reader reader;
  std::function<void(Scene&, double)> set;  // past the scene's own check
  bool whole = false;
  std::vector<Override> with = {};  // other keys that the ends need
  bool vector = false;              // the number is each part of a list
};

template <class M>
Row ofMaterial(const char* key, Limits limits, M member, std::vector<Override> with = {}) {
  return {std::string("objects.0.material.") + key,
          limits,
          Reader::World,
          [=](Scene& s, double v) { s.objects[0].material.*member = v; },
          false,
          std::move(with)};
}

std::vector<Row> rows() {
  const auto first = [](Eigen::Vector3d demo::SceneObject::*member) {
    return [=](Scene& s, double v) { (s.objects[0].*member).x() = v; };
  };
  const std::vector<Override> soft = {{"objects.0.material.youngs_modulus", "1"}};
  const std::vector<Override> strong = {{"objects.0.material.compressive_strength", "1e13"}};
  using M = Material;
  using O = demo::SceneObject;
  return {
      {"objects.N.size",
       limits::kLength,
       Reader::Cook,
       [](Scene& s, double v) { s.objects[0].size.setConstant(v); },
       false,
       {},
       true},
      {"objects.N.fill", limits::kFill, Reader::Cook, [](Scene& s, double v) { s.objects[0].fill = v; }},
      ofMaterial("density", limits::kDensity, &M::density),
      ofMaterial("youngs_modulus", limits::kYoungsModulus, &M::youngsModulus),
      ofMaterial("tensile_strength", limits::kStrength, &M::tensileStrength, strong),
      ofMaterial("compressive_strength", limits::kStrength, &M::compressiveStrength),
      ofMaterial("breaking_angle", limits::kBreakingAngle, &M::breakingAngle),
      ofMaterial("stretch_threshold", limits::kStretchThreshold, &M::stretchThreshold),
      ofMaterial("spring_damping", limits::kSpringDamping, &M::springDamping),
      ofMaterial("contact_stiffness", limits::kContactStiffness, &M::contactStiffness),
      ofMaterial("contact_damping", limits::kContactDamping, &M::contactDamping),
      ofMaterial("friction", limits::kFriction, &M::friction),
      ofMaterial("restitution", limits::kRestitution, &M::restitution),
      ofMaterial("rolling_friction", limits::kRollingFriction, &M::rollingFriction),
      ofMaterial("bond_work_index", limits::kBondWorkIndex, &M::bondWorkIndex),
      ofMaterial("crush_efficiency", limits::kCrushEfficiency, &M::crushEfficiency),
      ofMaterial("size_modulus", limits::kSizeModulus, &M::sizeModulus),
      ofMaterial("dust_radius", limits::kDustRadius, &M::dustRadius),
      ofMaterial("debris_speed", limits::kDebrisSpeed, &M::debrisSpeed),
      {"objects.N.mass_damping", limits::kMassDamping, Reader::World,
       [](Scene& s, double v) { s.objects[0].massDamping = v; }},
      {"objects.N.position", limits::kPosition, Reader::World, first(&O::position), false, {}, true},
      {"objects.N.velocity", limits::kSpeed, Reader::World, first(&O::velocity), false, {}, true},
      {"objects.N.spin", limits::kSpin, Reader::World, first(&O::spin), false, {}, true},
      {"max_substeps_per_frame", limits::kMaxSubstepsPerFrame, Reader::World,
       [](Scene& s, double v) { s.maxSubstepsPerFrame = int(v); }, true, soft},
      {"substep_safety", limits::kSubstepSafety, Reader::World,
       [](Scene& s, double v) { s.substepSafety = v; }},
      {"max_events", limits::kMaxEvents, Reader::World,
       [](Scene& s, double v) { s.maxEvents = std::uint32_t(v); }, true},
      {"debris.budget", limits::kMaxDebris, Reader::World,
       [](Scene& s, double v) { s.debris->budget = std::uint32_t(v); }, true},
      {"dust.resolution", limits::kDustResolution, Reader::Dust,
       [](Scene& s, double v) { s.dust->resolution = int(v); }, true},
      {"dust.vorticity", limits::kVorticity, Reader::Dust, [](Scene& s, double v) { s.dust->vorticity = v; }},
      {"dust.drag", limits::kDustDrag, Reader::Dust, [](Scene& s, double v) { s.dust->drag = v; }},
      {"dust.pressure_cycles", limits::kPressureCycles, Reader::Dust,
       [](Scene& s, double v) { s.dust->pressureCycles = int(v); }, true},
  };
}

class SceneLimits : public testing::Test {
 protected:
  static std::string path(const Row& row) {
    std::string key = row.key;
    if (const auto n = key.find(".N."); n != std::string::npos) key.replace(n, 3, ".0.");
    return key;
  }
  static std::string text(const Row& row, double value) {
    const std::string number = nlohmann::json(value).dump();
    if (!row.vector) return number;
    return row.reader == Reader::Cook ? "[" + number + "," + number + "," + number + "]"
                                      : "[" + number + ",0,0]";
  }
  Scene load(const Row& row, double value) {
    std::vector<Override> overrides = row.with;
    overrides.push_back({path(row), text(row, value)});
    return demo::loadScene(m_folder.write("cube.json", kCube), overrides);
  }
  // What the library says to a scene that nothing has checked; empty when it takes it.
  std::string libraryRefusal(const Row& row, const Scene& scene) {
    static const demo::Assets cube = demo::cookObjects(demo::loadScene(m_folder.write("cube.json", kCube)));
    try {
      if (row.reader == Reader::Cook) demo::cookObjects(scene);
      if (row.reader == Reader::World) demo::World(scene, cube);
      if (row.reader == Reader::Dust) demo::makeDust(scene, demo::Renderer3D::None, 1);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "";
  }
  TestFolder m_folder;
};

TEST_F(SceneLimits, BothEndsAreTakenBySceneAndLibrary) {
  for (const Row& row : rows())
    for (const double end : {row.limits.low, row.limits.high}) {
      try {
        EXPECT_EQ(libraryRefusal(row, load(row, end)), "") << row.key << " = " << end;
      } catch (const InputError& error) {
        ADD_FAILURE() << row.key << " = " << end << ": " << error.what();
      }
    }
}

TEST_F(SceneLimits, JustBeyondAnEndBothRefuse) {
  for (const Row& row : rows())
    for (const bool low : {true, false}) {
      const double end = low ? row.limits.low : row.limits.high;
      // A millionth is more than a float rounds away.
      const double apart = row.whole ? 1 : std::max(1e-6 * std::abs(end), 1e-12);
      const double beyond = low ? end - apart : end + apart;
      try {
        load(row, beyond);
        ADD_FAILURE() << row.key << " = " << beyond << " is taken by the scene";
      } catch (const InputError& error) {
        EXPECT_EQ(std::string(error.what()).find("--set: " + path(row)), 0u) << error.what();
      }
      Scene scene = load(row, end);
      row.set(scene, beyond);
      EXPECT_NE(libraryRefusal(row, scene), "") << row.key << " = " << beyond << " is taken by the library";
    }
}

// What the library does not read, or what has a test of its own below.
TEST_F(SceneLimits, EveryNumberOfASceneIsLookedAt) {
  std::set<std::string> seen = {
      // 10 million elements are not cooked here; the radius must fit the solid first
      "objects.N.elements", "objects.N.radius",
      // the size of the scaled mesh is what counts (cook_program_test.cpp)
      "objects.N.scale",
      // of named shapes (primitive_test.cpp)
      "objects.N.segments", "objects.N.shaft", "objects.N.plinth", "objects.N.bricks", "objects.N.joint",
      "objects.N.offset",
      // of Bullet's own bodies
      "objects.N.mesh_origin", "impactors.N.radius", "impactors.N.size", "impactors.N.mass",
      "impactors.N.position", "impactors.N.velocity", "impactors.N.spin", "impactors.N.friction",
      "impactors.N.restitution", "statics.N.size", "statics.N.offset", "statics.N.position",
      "statics.N.friction", "statics.N.restitution", "objects.N.rotation_degrees",
      "impactors.N.rotation_degrees", "statics.N.rotation_degrees", "gravity", "bullet_rate",
      // of the run and of the pictures (picture_test.cpp)
      "frames", "fps", "seed", "fragment_body_elements", "max_new_bodies", "camera.eye", "camera.target",
      "camera.field_of_view_degrees", "light.ambient", "dust.min", "dust.max", "dust.opacity"};
  for (Row row : rows()) {
    if (const auto n = row.key.find(".0."); n != std::string::npos) row.key.replace(n, 3, ".N.");
    seen.insert(row.key);
  }
  std::istringstream lines(demo::describeKeys());
  for (std::string line; std::getline(lines, line);) {
    const bool isNumber = line.find("| number, ") != line.npos || line.find("whole number, ") != line.npos ||
                          line.find(", each ") != line.npos;
    if (!isNumber) continue;
    const std::string key = line.substr(3, line.find('`', 3) - 3);
    EXPECT_TRUE(seen.contains(key)) << key << " has limits that no test compares with the library's";
  }
}

TEST_F(SceneLimits, ElementsAndRadiusAreTheCooks) {
  Scene scene = demo::loadScene(m_folder.write("cube.json", kCube));
  for (const std::uint32_t bad : {0u, 10000001u}) {
    scene.objects[0].elements = bad;
    EXPECT_THROW(demo::cookObjects(scene), InputError) << bad;
  }
  scene.objects[0].elements = 1;
  EXPECT_NO_THROW(demo::cookObjects(scene));
  for (const double bad : {-1e-12, 100001.0}) {
    scene.objects[0].radius = bad;
    EXPECT_THROW(demo::cookObjects(scene), InputError) << bad;
  }
}

// Sides of 1 mm to 100 km as floats have them.
TEST_F(SceneLimits, DustBoxIsTheGrids) {
  const std::string file = m_folder.write("cube.json", kCube);
  const auto takes = [&](const std::string& low, const std::string& high) {
    const std::vector<Override> box = {{"dust.min", low}, {"dust.max", high}};
    Scene scene = demo::loadScene(file);
    std::sscanf(low.c_str(), "[%lf,%lf,%lf]", &scene.dust->min.x(), &scene.dust->min.y(),
                &scene.dust->min.z());
    std::sscanf(high.c_str(), "[%lf,%lf,%lf]", &scene.dust->max.x(), &scene.dust->max.y(),
                &scene.dust->max.z());
    bool byScene = true, byGrid = true;
    try {
      demo::loadScene(file, box);
    } catch (const InputError& error) {
      byScene = false;
      EXPECT_EQ(std::string(error.what()).find("--set: dust.max: "), 0u) << error.what();
    }
    try {
      demo::makeDust(scene, demo::Renderer3D::None, 1);
    } catch (const InputError&) {
      byGrid = false;
    }
    EXPECT_EQ(byScene, byGrid) << low << " to " << high;
    return byScene;
  };
  EXPECT_TRUE(takes("[0,0,0]", "[0.001,1,1]"));
  EXPECT_FALSE(takes("[0,0,0]", "[0.000999,1,1]"));
  EXPECT_TRUE(takes("[-50000,0,0]", "[50000,1,1]"));
  EXPECT_FALSE(takes("[-100000,0,0]", "[100000,1,1]"));
  EXPECT_FALSE(takes("[99999.999,0,0]", "[100000,1,1]"));  // one place as floats
}

TEST_F(SceneLimits, DustSinksAlongMinusY) {
  const std::string file = m_folder.write("cube.json", kCube);
  const auto refusal = [&](const char* gravity, bool dust) -> std::string {
    std::vector<Override> changes = {{"gravity", gravity}};
    if (!dust) changes.push_back({"dust", "null"});
    try {
      const Scene scene = demo::loadScene(file, changes);
      demo::makeDust(scene, demo::Renderer3D::None, 1);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(refusal("[0,1,0]", true),
            "--set: gravity: is [0, 1, 0], must be [0, -g, 0] with g 0 to 1000 in a scene with dust");
  EXPECT_NE(refusal("[0.5,-9.81,0]", true), "");
  EXPECT_EQ(refusal("[0,0,0]", true), "");
  EXPECT_EQ(refusal("[0,-1000,0]", true), "");
  EXPECT_EQ(refusal("[0,1,0]", false), "");
  EXPECT_EQ(refusal("[0.5,-9.81,0]", false), "");
}

// 2^53 + 1 reads as 2^53 where numbers are doubles.
TEST_F(SceneLimits, SeedsThatDoublesRoundAreRefused) {
  const std::string file = m_folder.write("cube.json", kCube);
  EXPECT_NO_THROW(demo::loadScene(file, {{"seed", "9007199254740991"}}));
  EXPECT_THROW(demo::loadScene(file, {{"seed", "9007199254740992"}}), InputError);
  EXPECT_THROW(demo::loadScene(file, {{"seed", "9007199254740993"}}), InputError);
}

}  // namespace
}  // namespace rubble::test
