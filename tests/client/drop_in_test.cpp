// Bullet's hello world with Rubble in it: it links nothing of GL or CGAL, and the ball breaks what it falls
// on.
#include <gtest/gtest.h>

#include "rubble/asset.h"
#include "rubble/cook.h"
#include "scenes/child.h"
#include "scenes/scene_file.h"
#include "support/folders.h"
#include "support/strict_cook.h"
#include "unit/base/asset_bytes.h"
#include "unit/cook/shapes.h"

namespace rubble::test {
namespace {

std::string cookedBlock(const TestFolder& folder) {
  CookOptions options;
  options.elements = 128;
  const std::filesystem::path file = folder.path() / "block.rubble-asset";
  save(cookStrictly(boxMesh({0.4, 0.4, 0.4}), options), file);
  return file.string();
}

void expectABreak(const std::string& program) {
  const TestFolder folder;
  const ChildResult result = runChild(program + " " + cookedBlock(folder), folder.path());
  EXPECT_EQ(result.exitCode, 0) << result.error;
  EXPECT_NE(result.out.find("broke"), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("frame 59: ball at"), std::string::npos) << result.out;
  EXPECT_EQ(result.out.find("nan"), std::string::npos);
}

TEST(DropIn, BreaksWhatItLoads) {
  expectABreak(RUBBLE_DROP_IN);
}

// Builds the plugin anew without sanitizers: once is enough.
#ifndef RUBBLE_SANITIZED
TEST(ClientProject, BuildsWithTheRuntimeAloneAndBreaksWhatItLoads) {
  const TestFolder folder;
  const std::string configure =
      RUBBLE_CMAKE " -G Ninja -S " + sourceFolder() +
      "/tests/client/project -B " RUBBLE_CLIENT_BUILD " -DRUBBLE_FOLDER=" + sourceFolder() +
      " -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_FLAGS_RELEASE=-O1 -DCMAKE_UNITY_BUILD=ON";  // compiled sooner
  const std::string make = RUBBLE_CMAKE " --build " RUBBLE_CLIENT_BUILD " --target client";
  const ChildResult build = runChild(configure + " && " + make, folder.path());
  ASSERT_EQ(build.exitCode, 0) << build.out << build.error;
  expectABreak(RUBBLE_CLIENT_BUILD "/client");
}
#endif

TEST(DropIn, LinksNeitherGlNorCgal) {
  const TestFolder folder;
  const ChildResult result = runChild("ldd " RUBBLE_DROP_IN, folder.path());
  ASSERT_EQ(result.exitCode, 0);
  EXPECT_NE(result.out.find("libBulletDynamics"), std::string::npos);
  for (const char* library : {"libGL", "libEGL", "libepoxy", "libglfw", "libgmp", "libmpfr"})
    EXPECT_EQ(result.out.find(library), std::string::npos) << library;
}

TEST(DropIn, AddsAtMostTenLinesToHelloWorld) {
  std::ifstream source(sourceFolder() + "/demo/drop_in.cpp");
  int ours = 0;
  for (std::string line; std::getline(source, line);) ours += line.find("// ours") != std::string::npos;
  EXPECT_GT(ours, 0);
  EXPECT_LE(ours, 10);
}

// A right checksum and a radius of 1e300 m: no ball at (nan, nan, nan).
TEST(DropIn, RefusesAnAbsurdAsset) {
  const TestFolder folder;
  const std::string file = cookedBlock(folder);
  std::string bytes = fileBytes(file);
  setNumber(bytes, kRadiusAt, 1e300);
  seal(bytes);
  writeBytes(file, bytes);
  const ChildResult result = runChild(RUBBLE_DROP_IN " " + file, folder.path());
  EXPECT_EQ(result.exitCode, 2);
  EXPECT_NE(result.error.find("radius is 1e+300 m"), std::string::npos) << result.error;
  EXPECT_EQ(result.out, "");
}

TEST(DropIn, RefusesWhatIsNoAsset) {
  const TestFolder folder;
  EXPECT_EQ(runChild(RUBBLE_DROP_IN " none", folder.path()).exitCode, 2);
  EXPECT_EQ(runChild(RUBBLE_DROP_IN " " + folder.write("bad", "not an asset"), folder.path()).exitCode, 2);
}

}  // namespace
}  // namespace rubble::test
