// The key anchor_body: what it names, what it refuses, and that what is tied goes with its body.
#include <gtest/gtest.h>

#include <algorithm>

#include "demo/input_error.h"
#include "demo/world.h"
#include "rubble/cook.h"
#include "scenes/scene_file.h"
#include "support/strict_log.h"

namespace rubble::test {
namespace {

class AnchorBodyKey : public testing::Test {
 protected:
  // A block of 154 kg on a cart of 500 kg that rolls at 2 m/s, without gravity, and a slab below.
  demo::Scene load(const std::vector<demo::Override>& overrides = {}) {
    return demo::loadScene(m_folder.write("scene.json", R"({
      "gravity": [0, 0, 0],
      "objects": [{"size": [0.4, 0.4, 0.4], "position": [0, 0.2, 0], "elements": 64, "anchor": [0, -1, 0],
                   "anchor_body": "impactors.0"}],
      "impactors": [{"shape": "box", "size": [1, 0.2, 1], "mass": 500, "position": [0, -0.1, 0],
                     "velocity": [2, 0, 0]}],
      "statics": [{"shape": "box", "size": [4, 1, 4], "position": [0, -1, 0]}, {"shape": "plane", "offset": -2}]})"),
                           overrides);
  }
  // What the file or the world is refused with, without the folder's name.
  std::string refusal(const std::vector<demo::Override>& overrides) {
    try {
      const demo::Scene scene = load(overrides);
      demo::World(scene, demo::cookObjects(scene));
    } catch (const demo::InputError& error) {
      std::string text = error.what();
      const std::string folder = m_folder.path().string() + "/";
      for (auto at = text.find(folder); at != text.npos; at = text.find(folder))
        text.erase(at, folder.size());
      return text;
    }
    return "accepted";
  }
  // How far the block and the cart have come in ten frames [m]; no spring has broken.
  std::pair<Eigen::Vector3d, Eigen::Vector3d> ways(const std::vector<demo::Override>& overrides) {
    const demo::Scene scene = load(overrides);
    demo::World world(scene, demo::cookObjects(scene, {}, strictLog()), strictLog());
    const btRigidBody &block = *world.destruction().bodies()[0], &cart = *world.impactors()[0];
    const btVector3 blockAt = block.getWorldTransform().getOrigin(),
                    cartAt = cart.getWorldTransform().getOrigin();
    for (int frame = 0; frame < 10; ++frame) world.step();
    EXPECT_EQ(world.destruction().counts().springsBroken, 0u);
    const auto way = [](const btVector3& from, const btRigidBody& body) {
      const btVector3 w = body.getWorldTransform().getOrigin() - from;
      return Eigen::Vector3d(double(w.x()), double(w.y()), double(w.z()));
    };
    return {way(blockAt, block), way(cartAt, cart)};
  }

  TestFolder m_folder;
};

// No force acts on the two together, and both begin at 2 m/s: after 10/60 s each is 1/3 m on.
TEST_F(AnchorBodyKey, WhatIsTiedGoesWithTheCart) {
  const auto [block, cart] = ways({});
  EXPECT_NEAR((block - Eigen::Vector3d(1.0 / 3, 0, 0)).norm(), 0, 1e-5);
  EXPECT_NEAR((cart - Eigen::Vector3d(1.0 / 3, 0, 0)).norm(), 0, 1e-5);
}

TEST_F(AnchorBodyKey, TiedToAStaticBodyItStands) {
  const auto [block, cart] =
      ways({{"objects.0.anchor_body", "statics.0"}, {"impactors.0.position", "[0, 1, 9]"}});
  EXPECT_NEAR(block.norm(), 0, 1e-6);
  EXPECT_NEAR((cart - Eigen::Vector3d(1.0 / 3, 0, 0)).norm(), 0, 1e-5);
}

TEST_F(AnchorBodyKey, OthersAreRefusedByName) {
  const std::string place = "--set: objects.0.anchor_body: is ";
  const std::string those = ", must be one of: impactors.0, statics.0 to statics.1";
  for (const char* none : {"impactors.1", "statics.2", "impactors", "objects.0", "statics.01", "cart"})
    EXPECT_EQ(refusal({{"objects.0.anchor_body", none}}), place + none + those);
  EXPECT_EQ(refusal({{"objects.0.anchor_body", "3"}}), place + "3, must be impactors.N or statics.N");
  EXPECT_EQ(refusal({{"objects.0.anchor_body", "\"\""}}), place + "\"\", must be impactors.N or statics.N");
  EXPECT_EQ(
      refusal({{"impactors", "[]"}, {"statics", "[]"}}),
      "scene.json with --set impactors, --set statics: objects.0.anchor_body: is impactors.0, there are no "
      "impactors and no statics to hold to");
}

TEST_F(AnchorBodyKey, WithoutAnchorsItIsRefused) {
  EXPECT_EQ(refusal({{"objects.0.anchor", "null"}}),
            "scene.json with --set objects.0.anchor: objects.0.anchor_body: is impactors.0, must come with "
            "anchors: give anchor or anchor_box");
  CookOptions options;
  options.elements = 64;
  save(cook(boxMesh({0.4, 0.4, 0.4}), options), m_folder.path() / "free.rubble-asset");
  const std::string file = (m_folder.path() / "free.rubble-asset").string();
  EXPECT_EQ(refusal({{"objects.0", "{\"size\": null, \"elements\": null, \"anchor\": null, \"asset\": \"" +
                                       file + "\"}"}}),
            "scene.json with --set objects.0.anchor, --set objects.0.asset, --set objects.0.elements, --set "
            "objects.0.size: objects.0: anchor_body: is impactors.0, but free.rubble-asset has no anchors: "
            "`rubble cook --anchor` makes them");
}

// 0.064 m^3 of 2400 kg/m^3 are 153.6 kg, a fiftieth of them 3.072.
TEST_F(AnchorBodyKey, ACartThatIsTooLightIsRefused) {
  const std::string words = refusal({{"impactors.0.mass", "2"}});
  EXPECT_EQ(words.find("scene.json with --set impactors.0.mass: objects.0: anchor_body: is of 2 kg"), 0u)
      << words;
  EXPECT_NE(words.find("for what it is to carry it needs 3.07"), words.npos) << words;
  EXPECT_EQ(refusal({{"impactors.0.mass", "3.2"}}), "accepted");
}

// Its motion is the cart's: its own would be looked at by nobody.
TEST_F(AnchorBodyKey, AMotionOfItsOwnIsRefused) {
  for (const char* key : {"velocity", "spin"}) {
    const std::string path = std::string("objects.0.") + key;
    const std::string words = refusal({{path, "[1, 0, 0]"}});
    EXPECT_EQ(words.find("--set: " + path + ": unknown key, allowed here: "), 0u) << words;
    EXPECT_EQ(refusal({{path, "[1, 0, 0]"}, {"objects.0.anchor_body", "null"}, {"objects.0.anchor", "null"}}),
              "accepted");
  }
}

// So figures that are kept of scenes without the key stay theirs (demo/settings_hash.h).
TEST_F(AnchorBodyKey, IsListedWhereItIs) {
  const auto lists = [](const demo::Scene& scene) {
    const std::vector<std::string> lines = demo::listScene(scene);
    return std::find_if(lines.begin(), lines.end(), [](const std::string& line) {
             return line.find("anchor_body") != line.npos;
           }) != lines.end();
  };
  EXPECT_TRUE(lists(load()));
  EXPECT_FALSE(lists(load({{"objects.0.anchor_body", "null"}})));
}

}  // namespace
}  // namespace rubble::test
