// Things that start inside one another are refused or told before the run; those that touch are not.
#include <gtest/gtest.h>

#include "demo/input_error.h"
#include "demo/world.h"
#include "scenes/scene_file.h"

namespace rubble::test {
namespace {

class Overlaps : public testing::Test {
 protected:
  // What making the world refuses or warns of, without the folder's name; empty when it takes the scene.
  std::string said(const std::string& text) {
    const demo::Scene scene = demo::loadScene(m_folder.write("scene.json", text));
    std::string words;
    try {
      demo::World(scene, demo::cookObjects(scene), [&](LogLevel level, const std::string& line) {
        if (level == LogLevel::Warning) words += "warning: " + line;
      });
    } catch (const demo::InputError& error) {
      words = error.what();
    }
    const std::string folder = m_folder.path().string() + "/";
    if (const auto at = words.find(folder); at != words.npos) words.erase(at, folder.size());
    return words;
  }
  // Cubes of 1 m at heights, of elements whose radius is 0.05 m, and more keys of the scene.
  std::string cubes(const std::vector<std::string>& heights, const std::string& more = "") {
    std::string objects;
    for (const std::string& height : heights)
      objects += (objects.empty() ? "" : ", ") + std::string(R"({"size": [1, 1, 1], "elements": 900, )") +
                 R"("radius": 0.05, "position": [0, )" + height + ", 0]}";
    return R"({"objects": [)" + objects + "]" + more + "}";
  }
  static std::string ball(const std::string& radius, const std::string& position) {
    return R"(, "impactors": [{"shape": "sphere", "mass": 1, "radius": )" + radius + R"(, "position": )" +
           position + "}]";
  }
  static inline const std::string kGround = R"(, "statics": [{"shape": "plane"}])";

  TestFolder m_folder;
};

TEST_F(Overlaps, WhatTouchesIsTaken) {
  EXPECT_EQ(said(cubes({"0.5", "1.5"}, kGround)), "");                 // stacked on the ground
  EXPECT_EQ(said(cubes({"0.5"}, ball("0.2", "[0, 0.5, -0.7]"))), "");  // at the face
  EXPECT_EQ(said(cubes({"0.5", "1.495"}, kGround)), "");               // by a tenth of a radius
  EXPECT_EQ(said(cubes({"0.46"}, kGround)), "");                       // less than a radius in the ground
  EXPECT_EQ(said(cubes({"0.5"}, R"(, "impactors": [{"shape": "box", "size": [1, 1, 1], "mass": 1,
      "position": [0, 1.5, 0]}])")),
            "");
}

TEST_F(Overlaps, AnImpactorInsideOfAnObjectIsRefused) {
  // Its far side is 0.2 m in; a sphere of an element ends there at most.
  const std::string words = said(cubes({"0.5"}, ball("0.2", "[0, 0.5, -0.5]")));
  EXPECT_EQ(words.find("scene.json: impactors.0: starts 0."), 0u) << words;
  EXPECT_NE(
      words.find(" m inside of objects.0, must be at most 0.0125 m (a quarter of the elements' radius)"),
      words.npos)
      << words;
  // Wholly inside, and smaller than an element; as large as the object; a box; a hull.
  for (
      const char* impactor :
      {R"({"shape": "sphere", "radius": 0.03, "position": [0, 0.5, 0])",
       R"({"shape": "sphere", "radius": 3, "position": [0, 0.5, 0])",
       R"({"shape": "box", "size": [3, 0.2, 0.2], "position": [0, 0.5, 0], "rotation_degrees": [0, 0, 30])",
       R"({"shape": "hull", "points": [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], "position": [0.4, 0.4, 0.4])"})
    EXPECT_NE(said(cubes({"0.5"}, std::string(R"(, "impactors": [)") + impactor + R"(, "mass": 1}])"))
                  .find("impactors.0: starts "),
              std::string::npos)
        << impactor;
}

TEST_F(Overlaps, TwoObjectsAtOnePlaceAreRefused) {
  // Cooked alike: each element in one of the other, two radii deep.
  EXPECT_EQ(said(cubes({"0.5", "0.5"})),
            "scene.json: objects.1: starts 0.1 m inside of objects.0, must be at most 0.0125 m (a quarter of "
            "the elements' radius)");
  EXPECT_NE(said(cubes({"0.5", "1.42"})), "");  // 0.08 m
  // Of elements of different size, at places of their own.
  EXPECT_NE(said(R"({"objects": [{"size": [1, 1, 1], "elements": 100},
                                 {"size": [0.2, 0.2, 0.2], "elements": 30, "position": [0.1, 0.2, 0.3]}]})")
                .find("objects.1: starts "),
            std::string::npos);
}

TEST_F(Overlaps, AnObjectDeepInTheGroundIsTold) {
  EXPECT_EQ(said(cubes({"0.2"}, kGround)),
            "warning: scene.json: objects.0: starts 0.3 m inside of statics.0: its elements in there may be "
            "thrown out; lift it by as much, unless it is a foundation");
  // Turned by 45 degrees, an edge is half a diagonal below the centre: 0.707 m.
  EXPECT_NE(said(R"({"objects": [{"size": [1, 1, 1], "elements": 900, "position": [0, 0.5, 0],
                      "rotation_degrees": [45, 0, 0]}], "statics": [{"shape": "plane"}]})")
                .find("objects.0: starts 0.207 m inside of statics.0"),
            std::string::npos);
  EXPECT_NE(said(cubes({"0.5"}, R"(, "statics": [{"shape": "box", "size": [9, 1, 9]}])")), "");
}

// Lifting helps over a floor alone: not in a wall, not in a body that reaches higher.
TEST_F(Overlaps, WhatHelpsAnObjectInAStaticBodyDependsOnWhereThatIs) {
  const auto ends = [&](const std::string& text, const std::string& end) {
    const std::string words = said(text);
    return words.ends_with("; " + end + ", unless it is a foundation") ? "" : words;
  };
  EXPECT_EQ(ends(cubes({"0.2"}, kGround), "lift it by as much"), "");
  EXPECT_EQ(
      ends(cubes({"0.2"}, R"(, "statics": [{"shape": "box", "size": [9, 2, 9], "position": [0, -1, 0]}])"),
           "lift it by as much"),
      "");
  EXPECT_EQ(
      ends(cubes({"0.5"}, R"(, "statics": [{"shape": "plane", "normal": [1, 0, 0]}])"), "move one of them"),
      "");
  EXPECT_EQ(ends(cubes({"0.5"}, R"(, "statics": [{"shape": "plane", "normal": [0, -1, 0], "offset": -0.7}])"),
                 "move one of them"),
            "");
  EXPECT_EQ(ends(cubes({"0.5"}, R"(, "statics": [{"shape": "box", "size": [1, 9, 1],
                                                   "position": [0.9, 0, 0]}])"),
                 "move one of them"),
            "");
}

// Depths in closed form; a ball of 0.2 m, and what Bullet measures is as exact as floats.
TEST_F(Overlaps, AnImpactorInAStaticBodyIsTold) {
  const auto with = [&](const std::string& statics, const std::string& impactor) {
    return said(R"({"impactors": [)" + impactor + R"(], "statics": [)" + statics + "]}");
  };
  const auto ballAt = [](const std::string& position) {
    return R"({"shape": "sphere", "mass": 1, "radius": 0.2, "position": )" + position + "}";
  };
  const std::string plane = R"({"shape": "plane"})";
  const std::string starts = "warning: scene.json: impactors.0: starts ";
  const std::string lift = " m inside of statics.0: Bullet pushes it out; lift it by as much";
  const std::string move = " m inside of statics.0: Bullet pushes it out; move one of them";
  EXPECT_EQ(with(plane, ballAt("[0, 0.2, 0]")), "");
  EXPECT_EQ(with(plane, ballAt("[0, 0.185, 0]")), "");  // less than a tenth of its radius
  EXPECT_EQ(with(plane, ballAt("[0, 0.15, 0]")), starts + "0.05" + lift);
  EXPECT_EQ(with(plane, ballAt("[0, -1, 0]")), starts + "1.2" + lift);
  const std::string wall = R"({"shape": "box", "size": [0.5, 4, 4], "position": [0, 2, 0]})";
  EXPECT_EQ(with(wall, ballAt("[0.45, 1, 0]")), "");
  EXPECT_EQ(with(wall, ballAt("[0.3, 1, 0]")), starts + "0.15" + move);
  EXPECT_EQ(with(R"({"shape": "box", "size": [4, 1, 4], "position": [0, -0.5, 0]})", ballAt("[0, 0.1, 0]")),
            starts + "0.1" + lift);
  // Hulls end at their corners, whatever Bullet puts around them.
  const std::string hull = R"({"shape": "hull", "mass": 1, "points": [[-1, -1, -1], [1, -1, -1], [-1, 1, -1],
      [1, 1, -1], [-1, -1, 1], [1, -1, 1], [-1, 1, 1], [1, 1, 1]], "position": )";
  EXPECT_EQ(with(plane, hull + "[0, 1, 0]}"), "");
  EXPECT_EQ(with(plane, hull + "[0, 0.7, 0]}"), starts + "0.3" + lift);
}

TEST_F(Overlaps, TwoImpactorsInOneAnotherAreTold) {
  const auto two = [&](const std::string& position) {
    return said(R"({"impactors": [{"shape": "sphere", "mass": 1, "radius": 0.2, "position": [0, 1, 0]},
        {"shape": "sphere", "mass": 1, "radius": 0.1, "position": )" +
                position + "}]}");
  };
  EXPECT_EQ(two("[0.3, 1, 0]"), "");
  EXPECT_EQ(
      two("[0.25, 1, 0]"),
      "warning: scene.json: impactors.1: starts 0.05 m inside of impactors.0: Bullet pushes them apart; "
      "move one of them");
  EXPECT_EQ(two("[0, 1, 0]").find("warning: scene.json: impactors.1: starts 0.3 m inside of impactors.0"),
            0u);
}

// As the warnings say: they start elsewhere than the scene says. To 2 % of a radius in a second.
TEST_F(Overlaps, BulletPushesApartWhatIsInOneAnother) {
  const demo::Scene scene = demo::loadScene(m_folder.write("scene.json", R"({"gravity": [0, 0, 0],
      "impactors": [{"shape": "sphere", "mass": 1, "radius": 0.2, "position": [0, -0.1, 0]},
                    {"shape": "sphere", "mass": 1, "radius": 0.2, "position": [5, 2, 0]},
                    {"shape": "sphere", "mass": 1, "radius": 0.2, "position": [5.1, 2, 0]}],
      "statics": [{"shape": "plane"}]})"));
  demo::World world(scene, demo::Assets());
  for (int frame = 0; frame < 60; ++frame) world.step();
  const auto place = [&](std::size_t i) { return world.impactors()[i]->getWorldTransform().getOrigin(); };
  EXPECT_GT(place(0).y(), 0.2 * 0.98);
  EXPECT_GT(place(1).distance(place(2)), 0.4 * 0.98);
}

}  // namespace
}  // namespace rubble::test
