// Bullet's own profiler sees the stages of a tick.
#include <LinearMath/btQuickprof.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "bullet/bullet_world.h"

namespace rubble::test {
namespace {

std::vector<std::string>& zones() {
  static std::vector<std::string> names;
  return names;
}

class Profile : public testing::Test {
 protected:
  void SetUp() override {
    zones().clear();
    m_enter = btGetCurrentEnterProfileZoneFunc();
    m_leave = btGetCurrentLeaveProfileZoneFunc();
    btSetCustomEnterProfileZoneFunc([](const char* name) { zones().emplace_back(name); });
    btSetCustomLeaveProfileZoneFunc([] {});
  }
  void TearDown() override {
    btSetCustomEnterProfileZoneFunc(m_enter);
    btSetCustomLeaveProfileZoneFunc(m_leave);
  }

 private:
  btEnterProfileZoneFunc* m_enter = nullptr;
  btLeaveProfileZoneFunc* m_leave = nullptr;
};

TEST_F(Profile, NamesEveryStageInItsOrder) {
  {
    BulletWorld w;
    w.addWall(material("concrete_soft"));
    w.world.stepSimulation(btScalar(1) / 60, 1, btScalar(1) / 60);
  }
  std::vector<std::string> ours;
  for (const std::string& name : zones())
    if (name.starts_with("Rubble ")) ours.push_back(name.substr(7));
  // The order of plugin/bullet/README.md. No debris: nothing has crushed.
  const std::vector<std::string> expected = {
      "advance",     "take host moves", "follow sleep",   "gather proxies", "substeps",
      "finish",      "late impulses",   "note reactions", "fix positions",  "write applied impulses",
      "book events", "break elements",  "freeze calm",    "update sleep"};
  EXPECT_EQ(ours, expected);
}

}  // namespace
}  // namespace rubble::test
