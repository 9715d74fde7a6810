// Cooked assets from run to run: the same bytes as cooked anew, whatever has become of the folder.
#include "demo/asset_cache.h"

#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <cstdlib>
#include <functional>
#include <set>

#include "demo/cooked_objects.h"
#include "rubble/asset.h"
#include "scenes/scene_file.h"
#include "support/strict_log.h"
#include "unit/cook/shapes.h"

namespace rubble::test {
namespace {

namespace fs = std::filesystem;

constexpr const char* kTwoEqual = R"({"objects": [
    {"size": [1, 1, 0.5], "elements": 60, "anchor": [0, -1, 0]},
    {"size": [1, 1, 0.5], "elements": 60, "anchor": [0, -1, 0], "position": [3, 0, 0],
     "material": {"preset": "brick_soft"}},
    {"size": [1, 1, 0.5], "elements": 61, "position": [6, 0, 0]}]})";

class CookedObjects : public testing::Test {
 protected:
  demo::Assets cooked(const std::string& scene, const LogFunction& log = strictLog(), bool isAsked = false) {
    m_steps.clear();
    return demo::cookObjects(demo::loadScene(m_folder.write("scene.json", scene)),
                             [this](double, const char* what) { m_steps.insert(what); }, log,
                             {.folder = m_cache, .isAsked = isAsked});
  }
  std::string bytesOf(const Asset& asset) const {
    save(asset, m_folder.path() / "bytes");
    return fileBytes(m_folder.path() / "bytes");
  }
  std::vector<fs::path> kept(const std::string& ending) const {
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(m_cache))
      if (entry.path().extension() == ending) files.push_back(entry.path());
    return files;
  }

  TestFolder m_folder;
  fs::path m_cache = m_folder.path() / "new" / "cache";
  std::set<std::string> m_steps;  // that the progress named
};

TEST_F(CookedObjects, AreTakenFromTheCacheTheNextTime) {
  const demo::Assets first = cooked(kTwoEqual);
  EXPECT_TRUE(m_steps.contains("cooking, packing"));
  EXPECT_EQ(kept(".rubble-asset").size(), 2u);
  const demo::Assets again = cooked(kTwoEqual);
  std::set<std::string> wanted;
  for (const fs::path& file : kept(".rubble-asset")) wanted.insert("taken from " + file.string());
  EXPECT_EQ(m_steps, wanted);
  ASSERT_EQ(again.size(), first.size());
  for (std::size_t i = 0; i < first.size(); ++i) EXPECT_EQ(bytesOf(*again[i]), bytesOf(*first[i])) << i;
}

// Whatever they are made of: the cook knows no materials.
TEST_F(CookedObjects, EqualOnesAreOne) {
  m_cache.clear();
  const demo::Assets assets = cooked(kTwoEqual);
  EXPECT_EQ(assets[0], assets[1]);
  EXPECT_EQ(assets[2]->elementCount(), 61u);
}

double tiedArea(const Asset& asset) {
  double area = 0;
  for (const AssetAnchor& anchor : asset.anchors) area += anchor.area;
  return area;
}

// Lying on its side, its own -x is the world's -y: the side of 1 x 0.5 m there, and not the bottom of its
// mesh.
TEST_F(CookedObjects, AnAnchorsDirectionIsTheWorlds) {
  m_cache.clear();
  const demo::Assets assets = cooked(R"({"objects": [{"size": [2, 1, 0.5], "elements": 60,
      "anchor": [0, -1, 0], "rotation_degrees": [0, 0, 90]}]})");
  ASSERT_FALSE(assets[0]->anchors.empty());
  for (const AssetAnchor& anchor : assets[0]->anchors) EXPECT_NEAR(anchor.point.x(), -1, 1e-9);
  EXPECT_NEAR(tiedArea(*assets[0]), 0.5, 1e-9);
}

// The box is the shape's own, whichever way it is turned; the direction's side is 1 x 0.5 m, the box's 2 x
// 0.5.
TEST_F(CookedObjects, ABoxOfAnchorsTurnsWithItsObject) {
  m_cache.clear();
  std::vector<std::string> told;
  const demo::Assets assets = cooked(R"({"objects": [{"size": [2, 1, 0.5], "elements": 60,
      "anchor": [0, -1, 0], "anchor_box": [[2, 0.51, 1], [-2, 0.49, -1]], "rotation_degrees": [0, 0, 90]}]})",
                                     [&](LogLevel, const std::string& line) { told.push_back(line); });
  EXPECT_NEAR(tiedArea(*assets[0]), 0.5 + 1, 1e-9);
  const std::string count = std::to_string(assets[0]->anchors.size()) + " anchors";
  EXPECT_TRUE(std::ranges::any_of(told, [&](const std::string& s) { return s.find(count) != s.npos; }));
}

TEST_F(CookedObjects, AnchorsThatAreNotFoundAreAnError) {
  m_cache.clear();
  const auto refusal = [&](const std::string& keys) -> std::string {
    try {
      cooked(R"({"objects": [{"size": [2, 1, 0.5], "elements": 60, )" + keys + "}]}");
    } catch (const std::exception& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(refusal(R"("anchor": [1, -1, 0])").find("no flat side faces its anchor"), std::string::npos);
  const std::string box = refusal(R"("anchor_box": [[3, 0, 0], [4, 1, 1]])");
  EXPECT_NE(box.find("in the anchor box (3, 0, 0) to (4, 1, 1) m; the mesh is from (-1, -0.5, -0.25) to "
                     "(1, 0.5, 0.25) m"),
            std::string::npos)
      << box;
}

TEST_F(CookedObjects, OfDamagedFilesAreCookedAnewWithAWarning) {
  const std::string one = R"({"objects": [{"size": [1, 1, 0.5], "elements": 60}]})";
  const std::string other = R"({"objects": [{"size": [1, 1, 0.5], "elements": 50}]})";
  const std::string bytes = bytesOf(*cooked(one).front());
  const fs::path file = kept(".rubble-asset").front(), log = kept(".log").front();
  const auto write = [](const fs::path& at, const std::string& text) {
    std::ofstream(at, std::ios::binary) << text;
  };
  std::string flipped = bytes;
  flipped[bytes.size() / 2] = char(flipped[bytes.size() / 2] ^ 4);
  const std::pair<const char*, std::function<void()>> damages[] = {
      {"cut", [&] { fs::resize_file(file, bytes.size() / 2); }},
      {"empty", [&] { write(file, ""); }},
      {"a flipped bit", [&] { write(file, flipped); }},
      {"another asset",
       [&] {
         m_cache = m_folder.path() / "other";
         write(file, bytesOf(*cooked(other).front()));
         m_cache = file.parent_path();
       }},
      {"no log", [&] { fs::remove(log); }},
      {"half a log", [&] { write(log, "warning: thi"); }},
      {"no log of ours", [&] { write(log, "hello\nend\n"); }},
  };
  for (const auto& [name, damage] : damages) {
    SCOPED_TRACE(name);
    damage();
    ExpectedWarnings warnings;
    EXPECT_EQ(bytesOf(*cooked(one, warnings.log()).front()), bytes);
    EXPECT_EQ(warnings.take("; cooked anew"), 1);
    EXPECT_TRUE(m_steps.contains("cooking, packing"));
    EXPECT_EQ(fileBytes(file), bytes);  // whole again
    EXPECT_EQ(bytesOf(*cooked(one).front()), bytes);
    EXPECT_EQ(m_steps.size(), 1u);
  }
}

// A folder below a file cannot be made by anyone, root included.
TEST_F(CookedObjects, NeedNoFolder) {
  m_cache = m_folder.write("file", "") + "/cache";
  EXPECT_EQ(cooked(kTwoEqual).size(), 3u);
  ExpectedWarnings warnings;
  EXPECT_EQ(cooked(kTwoEqual, warnings.log(), true).size(), 3u);
  EXPECT_EQ(warnings.take(m_cache.string() + ": cannot be written; the cooked asset is not kept"), 2);
}

TEST(AssetCache, TellsAgainWhatTheCookTold) {
  const TestFolder folder;
  const std::string name(32, 'a');
  const Asset asset = cook(boxMesh({1, 1, 1}), optionsFor(8));
  std::vector<std::pair<LogLevel, std::string>> told;
  demo::AssetCache cache({.folder = folder.path()}, [&told](LogLevel level, const std::string& line) {
    told.emplace_back(level, line);
  });
  cache.keep(name, asset, {{LogLevel::Warning, "thin: 1\n2"}, {LogLevel::Info, "so"}});
  EXPECT_TRUE(told.empty());
  ASSERT_TRUE(cache.take(name, 8));
  EXPECT_EQ(told, (std::vector<std::pair<LogLevel, std::string>>{{LogLevel::Warning, "thin: 1 2"},
                                                                 {LogLevel::Info, "so"}}));
}

TEST(AssetCache, RemovesWhatWasNotUsedForLongest) {
  using namespace std::chrono_literals;
  const TestFolder folder;
  const Asset asset = cook(boxMesh({1, 1, 1}), optionsFor(8));
  const auto name = [](char letter) { return std::string(32, letter); };
  demo::AssetCache all({.folder = folder.path()}, strictLog());
  const auto age = [&](const fs::path& file, std::chrono::seconds by) {
    fs::last_write_time(file, fs::file_time_type::clock::now() - by);
  };
  const auto keepOld = [&](char letter, std::chrono::seconds by) {
    all.keep(name(letter), asset, {});
    for (const char* ending : {".rubble-asset", ".log"}) age(folder.path() / (name(letter) + ending), by);
  };
  keepOld('a', 3h);
  keepOld('b', 2h);
  keepOld('c', 1h);
  ASSERT_TRUE(all.take(name('a'), 8));  // used now
  folder.write("notes.txt", std::string(100'000, ' '));
  const std::string left = folder.write(name('d') + ".rubble-asset.partial7", "");
  const std::string written = folder.write(name('e') + ".rubble-asset.partial7", "");
  age(left, 2h);

  const std::uintmax_t bytes = fs::file_size(all.file(name('a')));
  demo::AssetCache few({.folder = folder.path(), .mostBytes = 2 * bytes + bytes / 2}, strictLog());
  few.keep(name('f'), asset, {});
  EXPECT_TRUE(fs::exists(few.file(name('a'))));
  EXPECT_TRUE(fs::exists(few.file(name('f'))));
  EXPECT_FALSE(few.take(name('b'), 8));
  EXPECT_FALSE(few.take(name('c'), 8));
  EXPECT_FALSE(fs::exists(folder.path() / (name('b') + ".log")));
  EXPECT_FALSE(fs::exists(left));
  EXPECT_TRUE(fs::exists(written));
  EXPECT_TRUE(fs::exists(folder.path() / "notes.txt"));

  // What is too large by itself is not written.
  demo::AssetCache none({.folder = folder.path(), .mostBytes = 100}, strictLog());
  none.keep(name('9'), asset, {});
  EXPECT_FALSE(fs::exists(none.file(name('9'))));
  EXPECT_TRUE(fs::exists(none.file(name('a'))));
}

SurfaceMesh lookedAtBox() {
  SurfaceMesh mesh = boxMesh({1, 2, 3});
  std::array<Eigen::Vector3f, 3> normals;
  normals.fill(Eigen::Vector3f::UnitX());
  std::array<Eigen::Vector2f, 3> uvs;
  uvs.fill(Eigen::Vector2f::Zero());
  mesh.normals.assign(mesh.triangles.size(), normals);
  mesh.uvs.assign(mesh.triangles.size(), uvs);
  mesh.materials.assign(mesh.triangles.size(), 0);
  mesh.materialNames = {"ab", "c"};
  return mesh;
}

TEST(CookName, IsAnotherForEveryChange) {
  const SurfaceMesh mesh = lookedAtBox();
  const CookOptions options;
  const std::string name = demo::cookName(mesh, options);
  EXPECT_EQ(name.size(), 32u);
  EXPECT_EQ(name, demo::cookName(lookedAtBox(), CookOptions()));
  using ChangeMesh = void (*)(SurfaceMesh&);
  using ChangeOptions = void (*)(CookOptions&);
  const ChangeMesh meshes[] = {
      [](SurfaceMesh& m) { m.vertices[7].z() = std::nextafter(m.vertices[7].z(), 9); },
      [](SurfaceMesh& m) { std::swap(m.vertices[0], m.vertices[1]); },
      [](SurfaceMesh& m) { std::swap(m.triangles[3][0], m.triangles[3][1]); },
      [](SurfaceMesh& m) { m.triangles.pop_back(); },
      [](SurfaceMesh& m) { m.normals[5][2].y() = 1; },
      [](SurfaceMesh& m) { m.normals.clear(); },
      [](SurfaceMesh& m) { m.uvs[5][2].y() = 1; },
      [](SurfaceMesh& m) { m.uvs.clear(); },
      [](SurfaceMesh& m) { m.materials[11] = 1; },
      [](SurfaceMesh& m) { m.materials.clear(); },
      [](SurfaceMesh& m) {
        m.materialNames = {"a", "bc"};
      },
  };
  const ChangeOptions choices[] = {
      [](CookOptions& o) { ++o.elements; },
      [](CookOptions& o) { o.radius = 0.01; },
      [](CookOptions& o) { o.fill = 0.49; },
      [](CookOptions& o) { ++o.seed; },
      [](CookOptions& o) { o.maxOverlap *= 2; },
      [](CookOptions& o) { ++o.maxIterations; },
      [](CookOptions& o) { o.minFaceArea *= 2; },
      [](CookOptions& o) { o.anchorDirection = Eigen::Vector3d::Zero(); },
      [](CookOptions& o) { o.anchorDirection = Eigen::Vector3d::UnitZ(); },
      [](CookOptions& o) { o.anchorBand *= 2; },
      [](CookOptions& o) {
        o.anchorRegions = {{Eigen::Vector3d::Zero(), Eigen::Vector3d::Ones()}};
      },
      [](CookOptions& o) {
        o.anchorRegions = {{Eigen::Vector3d::Zero(), Eigen::Vector3d(1, 1, 2)}};
      },
  };
  std::set<std::string> names = {name};
  for (const ChangeMesh change : meshes) {
    SurfaceMesh other = mesh;
    change(other);
    names.insert(demo::cookName(other, options));
  }
  for (const ChangeOptions change : choices) {
    CookOptions other = options;
    change(other);
    names.insert(demo::cookName(mesh, other));
  }
  EXPECT_EQ(names.size(), 1 + std::size(meshes) + std::size(choices));
}

// As https://specifications.freedesktop.org/basedir-spec says, which takes no relative paths.
TEST(UsualCacheFolder, IsThatOfTheDesktop) {
  const auto with = [](const char* cache, const char* home) {
    const auto set = [](const char* name, const char* value) {
      value ? setenv(name, value, 1) : unsetenv(name);
    };
    const auto valueOf = [](const char* name) {
      const char* value = std::getenv(name);
      return value ? std::optional<std::string>(value) : std::nullopt;
    };
    const auto oldCache = valueOf("XDG_CACHE_HOME"), oldHome = valueOf("HOME");
    set("XDG_CACHE_HOME", cache);
    set("HOME", home);
    const fs::path folder = demo::usualCacheFolder();
    set("XDG_CACHE_HOME", oldCache ? oldCache->c_str() : nullptr);
    set("HOME", oldHome ? oldHome->c_str() : nullptr);
    return folder;
  };
  EXPECT_EQ(with("/cache", "/home/me"), "/cache/rubble");
  EXPECT_EQ(with(nullptr, "/home/me"), "/home/me/.cache/rubble");
  EXPECT_EQ(with("cache", "/home/me"), "/home/me/.cache/rubble");
  EXPECT_EQ(with("", ""), "");
  EXPECT_EQ(with(nullptr, nullptr), "");
}

}  // namespace
}  // namespace rubble::test
