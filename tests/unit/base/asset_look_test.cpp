// Texture coordinates and materials in an asset's file: optional, and believed no more than the rest.
#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "support/strict_cook.h"
#include "unit/base/asset_bytes.h"
#include "unit/cook/shapes.h"

namespace rubble::test {
namespace {

constexpr std::size_t kBallElements = 12;
// Which of the header's counts.
constexpr std::size_t kUvs = 8, kMaterials = 9, kNameBytes = 10, kRest = 11;
constexpr std::size_t kNames = 8;  // bytes of "one" and "two", each with its end

class LookSection : public testing::Test {
 protected:
  LookSection() {
    const std::string name = testing::UnitTest::GetInstance()->current_test_info()->name();
    m_folder = std::filesystem::path(testing::TempDir()) / ("rubble_asset_look_" + name);
    std::filesystem::create_directories(m_folder);
    m_file = m_folder / "box.asset";
    SurfaceMesh mesh = boxMesh({1, 1, 1});
    mesh.materialNames = {"one", "two"};
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      mesh.materials.push_back(std::uint16_t(t / 2 % 2));  // of both triangles of a side
      mesh.uvs.push_back({Eigen::Vector2f(0, 0), Eigen::Vector2f(1, float(t)), Eigen::Vector2f(0.1f, -3e9f)});
    }
    m_asset = cookStrictly(mesh, optionsFor(kBallElements));
    save(m_asset, m_file);
    m_bytes = fileBytes(m_file);
    m_uvsAt = m_bytes.size() - kNames - materialBytes() - 8 * m_asset.uvs.size();
  }
  ~LookSection() override { std::filesystem::remove_all(m_folder); }

  // With the gap behind them.
  std::size_t materialBytes() const { return (m_asset.materials.size() + 3) / 4 * 8; }

  template <class T>
  std::string refusalWith(std::size_t at, T value) const {
    std::string bytes = m_bytes;
    setNumber(bytes, at, value);
    return refusalOf(m_file, bytes);
  }

  std::filesystem::path m_folder, m_file;
  Asset m_asset;
  std::string m_bytes;
  std::size_t m_uvsAt;
};

TEST_F(LookSection, ComesBackBitByBit) {
  ASSERT_FALSE(m_asset.uvs.empty());
  ASSERT_FALSE(m_asset.materials.empty());
  const Asset read = load(m_file);
  EXPECT_EQ(read.uvs, m_asset.uvs);
  EXPECT_EQ(read.materials, m_asset.materials);
  EXPECT_EQ(read.materialNames, m_asset.materialNames);
  EXPECT_FALSE(read.rest);
  save(read, m_file);
  EXPECT_EQ(fileBytes(m_file), m_bytes);
}

TEST_F(LookSection, ComesBackWithAStaticStateAndInEveryPart) {
  AssetRest rest;
  rest.key = 7;
  rest.displacements.assign(kBallElements, Eigen::Vector3d(0, 1e-4, 0));
  rest.rotations.assign(kBallElements, Eigen::Quaterniond::Identity());
  constexpr unsigned kHasUvs = 1, kHasNames = 2, kHasMaterials = 4;
  for (const unsigned parts : {0u, kHasUvs, kHasNames, kHasUvs | kHasNames, kHasNames | kHasMaterials}) {
    Asset asset = m_asset;
    if ((parts & kHasUvs) == 0) asset.uvs.clear();
    if ((parts & kHasNames) == 0) asset.materialNames.clear();
    if ((parts & kHasMaterials) == 0) asset.materials.clear();
    asset.rest = rest;
    save(asset, m_file);
    const Asset read = load(m_file);
    EXPECT_EQ(read.uvs, asset.uvs);
    EXPECT_EQ(read.materials, asset.materials);
    EXPECT_EQ(read.materialNames, asset.materialNames);
    ASSERT_TRUE(read.rest);
    EXPECT_EQ(read.rest->displacements, rest.displacements);
  }
}

// With it, the file has just these arrays more.
TEST_F(LookSection, IsOptional) {
  Asset bare = m_asset;
  bare.uvs.clear(), bare.materials.clear(), bare.materialNames.clear();
  save(bare, m_file);
  const std::string bareBytes = fileBytes(m_file);
  ASSERT_EQ(m_bytes.size(), bareBytes.size() + 8 * m_asset.uvs.size() + materialBytes() + kNames);
  EXPECT_TRUE(m_bytes.substr(kHeaderBytes, m_uvsAt - kHeaderBytes) == bareBytes.substr(kHeaderBytes));
  EXPECT_EQ(m_bytes.substr(m_bytes.size() - kNames), std::string("one\0two\0", kNames));
  EXPECT_EQ(m_bytes.substr(m_uvsAt, 4), std::string(reinterpret_cast<const char*>(m_asset.uvs.data()), 4));
}

TEST_F(LookSection, IsRefusedCutOffAnywhere) {
  for (std::size_t size = 0; size < m_bytes.size(); size += size < 2 * kHeaderBytes ? 1 : 997)
    EXPECT_FALSE(
        refusalOf(m_file, m_bytes.substr(0, size).append(size < kBodyAt ? kBodyAt - size : 0, ' ')).empty())
        << size;
  EXPECT_FALSE(refusalOf(m_file, m_bytes.substr(0, m_bytes.size() - 1)).empty());
  expectHas(refusalOf(m_file, m_bytes + "x"), "1 bytes too many at its end");
}

TEST_F(LookSection, WithAbsurdCountsIsRefusedBeforeAllocating) {
  for (const std::size_t count : {kUvs, kMaterials, kNameBytes})
    for (const std::uint64_t value : {std::uint64_t(1) << 60, ~std::uint64_t(0), std::uint64_t(1) << 33})
      expectHas(refusalWith(kCountsAt + 8 * count, value), "do not fit into the file's");
  expectHas(refusalWith(kCountsAt + 8 * kRest, ~std::uint64_t(0)), "static states of 18446744073709551615");
  expectHas(refusalWith(kCountsAt + 8 * kRest, std::uint64_t(kBallElements)),
            "0 bytes are left for the 680 of its static");
  // A file of nothing but names.
  std::string bytes = m_bytes + std::string(std::size_t(17) << 20, '\0');
  setNumber(bytes, kCountsAt + 8 * kNameBytes, std::uint64_t(kNames + (std::size_t(17) << 20)));
  expectHas(refusalOf(m_file, bytes), "bytes of names of materials; allowed: up to 16776704");
}

TEST_F(LookSection, WithAbsurdContentsIsRefused) {
  for (const float value : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()})
    expectHas(refusalWith(m_uvsAt, value), "uvs[0] is (");
  const std::size_t materialsAt = m_uvsAt + 8 * m_asset.uvs.size();
  const Cell& cell = m_asset.cells[0];
  ASSERT_GT(cell.outerTriangles, 0u);
  ASSERT_GT(cell.innerTriangles, 0u);
  for (const std::uint16_t value : {std::uint16_t(2), std::uint16_t(0xffff)})
    expectHas(refusalWith(materialsAt, value), "on an outer face; allowed: 0 to 1");
  expectHas(refusalWith(materialsAt + 2 * cell.outerTriangles, std::uint16_t(1)),
            "on an inner face; allowed: 2");
  const std::size_t namesAt = m_bytes.size() - kNames;
  expectHas(refusalWith(namesAt, '\n'), "materialNames[0] is no name; allowed: up to 255 bytes");
  expectHas(refusalWith(m_bytes.size() - 1, 'x'), "the last name of a material has no end");
  // An end in the middle of a name makes three of two, and inner faces have the wrong number.
  expectHas(refusalWith(namesAt + 1, '\0'), "on an inner face; allowed: 3");
}

TEST_F(LookSection, WithTheWrongNumberOfEntriesIsNeverWritten) {
  const std::vector<std::pair<std::function<void(Asset&)>, std::string>> cases = {
      {[](Asset& a) { a.uvs.pop_back(); }, "allowed: none or one a corner"},
      {[](Asset& a) { a.materials.pop_back(); }, "allowed: none or one a triangle"},
      {[](Asset& a) { a.materialNames.resize(65535); }, "materialNames has 65535 entries"},
      {[](Asset& a) { a.materialNames[1] = std::string(256, 'x'); }, "materialNames[1] is no name"},
  };
  for (const auto& [change, words] : cases) {
    Asset asset = m_asset;
    change(asset);
    try {
      save(asset, m_file);
      FAIL() << "no error; expected: " << words;
    } catch (const Error& error) {
      expectHas(error.what(), words);
    }
    EXPECT_EQ(fileBytes(m_file), m_bytes);
  }
}

}  // namespace
}  // namespace rubble::test
