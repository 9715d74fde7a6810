// The asset file can be used where it is mapped since version 4; earlier versions are still read.
#include <gtest/gtest.h>

#include "rubble/material.h"
#include "support/grid_asset.h"
#include "unit/base/asset_old_bytes.h"
#include "unit/cook/shapes.h"

namespace rubble::test {
namespace {

class AssetVersions : public testing::Test {
 protected:
  AssetVersions() {
    const std::string name = testing::UnitTest::GetInstance()->current_test_info()->name();
    m_folder = std::filesystem::path(testing::TempDir()) / ("rubble_asset_versions_" + name);
    std::filesystem::create_directories(m_folder);
    m_file = m_folder / "box.asset";
    // Odd numbers of springs, vertices, triangles and materials: gaps are needed.
    m_asset = gridAsset({{3, 1, 1}, 0.5, Eigen::Vector3d(1, 2, 3), true});
    save(m_asset, m_file);
    m_bytes = fileBytes(m_file);
  }

  ~AssetVersions() override { std::filesystem::remove_all(m_folder); }

  // With everything that a file can hold.
  Asset wholeAsset() const {
    Asset asset = m_asset;
    asset.uvs.assign(asset.corners.size(), Eigen::Vector2f(0.25f, -3));
    asset.materialNames = {"stone", ""};
    for (const Cell& cell : asset.cells) {
      asset.materials.insert(asset.materials.end(), cell.outerTriangles, 1);
      asset.materials.insert(asset.materials.end(), cell.innerTriangles, 2);
    }
    addRest(asset);
    return asset;
  }
  static void addRest(Asset& asset) {
    asset.rest.emplace();
    asset.rest->key = 0x0123456789abcdefu;
    asset.rest->displacements.assign(asset.elementCount(), Eigen::Vector3d(0, -1e-4, -0.0));
    asset.rest->rotations.assign(asset.elementCount(), Eigen::Quaterniond(0.8, 0, 0.6, 0));
  }
  void expectRead(const Asset& asset, std::uint32_t version) {
    save(asset, m_file);
    const std::string old = version == 5   ? bytesWithoutPreset(fileBytes(m_file))
                            : version == 4 ? bytesWithoutOrigin(fileBytes(m_file))
                                           : oldBytesOf(asset);
    ASSERT_EQ(numberAt<std::uint32_t>(old, kVersionAt), version);
    const std::string present = fileBytes(m_file);
    writeBytes(m_file, old);
    save(load(m_file), m_file);
    EXPECT_TRUE(fileBytes(m_file) == present);
    for (const std::size_t at : {kRadiusAt, kOldHeaderBytes + 3, old.size() - 1}) {
      std::string flipped = old;
      flipped[at] = char(flipped[at] ^ 1);
      writeBytes(m_file, flipped);
      EXPECT_NE(refusal(m_file), "") << at;
    }
  }

  std::filesystem::path m_folder, m_file;
  Asset m_asset;
  std::string m_bytes;
};

TEST_F(AssetVersions, EarlierOnesHoldWhatTheyDid) {
  expectRead(m_asset, 1);
  const Asset whole = wholeAsset();
  expectRead(whole, 3);
  expectRead(whole, 4);
  expectRead(whole, 5);
  addRest(m_asset);
  expectRead(m_asset, 2);
}

TEST_F(AssetVersions, OneDoesNotPassForAnother) {
  const Asset whole = wholeAsset();
  save(whole, m_file);
  std::string bytes = fileBytes(m_file);
  setNumber(bytes, kVersionAt, std::uint32_t(3));
  expectHas(refusalOf(m_file, bytes), "is damaged: ");
  bytes = oldBytesOf(whole);
  setNumber(bytes, kVersionAt, std::uint32_t(4));
  expectHas(refusalOf(m_file, bytes), "is cut off or damaged: ");
  setNumber(bytes, kVersionAt, std::uint32_t(5));
  expectHas(refusalOf(m_file, bytes), "is damaged: its header has 128 bytes; allowed: 152");
  setNumber(bytes, kVersionAt, std::uint32_t(6));
  expectHas(refusalOf(m_file, bytes), "is damaged: its header has 128 bytes; allowed: 216");
}

// Whoever maps the file finds the arrays as they are in memory, at addresses that suit their numbers.
TEST_F(AssetVersions, ArraysCanBeUsedWhereTheyAre) {
  const Asset asset = wholeAsset();
  save(asset, m_file);
  const std::string bytes = fileBytes(m_file);
  EXPECT_EQ(numberAt<std::uint32_t>(bytes, kVersionAt), 6u);
  std::size_t at = kHeaderBytes;
  const auto expectArray = [&](const auto& records) {
    const std::size_t size = records.size() * sizeof(records[0]);
    ASSERT_LE(at + size, bytes.size());
    EXPECT_EQ(bytes.compare(at, size, reinterpret_cast<const char*>(records.data()), size), 0) << at;
    at = (at + size + 7) / 8 * 8;
  };
  expectArray(asset.positions), expectArray(asset.volumes), expectArray(asset.gyrations);
  expectArray(asset.springs);
  for (const AssetAnchor& anchor : asset.anchors) {
    EXPECT_EQ(numberAt<std::uint32_t>(bytes, at), anchor.element);
    EXPECT_EQ(numberAt<double>(bytes, at + offsetof(AssetAnchor, area)), anchor.area);
    EXPECT_EQ(numberAt<double>(bytes, at + offsetof(AssetAnchor, point) + 16), anchor.point.z());
    at += sizeof(AssetAnchor);
  }
  expectArray(asset.vertices), expectArray(asset.corners), expectArray(asset.triangles);
  expectArray(asset.faces), expectArray(asset.cells), expectArray(asset.uvs), expectArray(asset.materials);
  expectArray(std::string("stone\0\0", 7));
  EXPECT_EQ(numberAt<std::uint64_t>(bytes, at), asset.rest->key);
  at += 8;
  expectArray(asset.rest->displacements), expectArray(asset.rest->rotations);
  EXPECT_EQ(at, bytes.size());
}

TEST_F(AssetVersions, OriginIsKept) {
  m_asset.origin = Eigen::Vector3d(500'000.25, -0.0, 1e9);
  save(m_asset, m_file);
  EXPECT_EQ(load(m_file).origin, m_asset.origin);
  EXPECT_EQ(numberAt<double>(fileBytes(m_file), kOriginAt + 16), 1e9);
  m_asset.origin.y() = -1.1e9;
  try {
    m_asset.validate();
    ADD_FAILURE();
  } catch (const Error& error) {
    expectHas(error.what(), "origin.y is -1.1e+09 m; allowed: -1e+09 to 1e+09");
  }
}

TEST_F(AssetVersions, PresetIsKept) {
  EXPECT_EQ(m_asset.material().name, Material().name);
  m_asset.preset = "glass_soft";
  save(m_asset, m_file);
  const std::string bytes = fileBytes(m_file);
  EXPECT_EQ(bytes.compare(kPresetAt, 11, std::string("glass_soft\0", 11)), 0);
  EXPECT_EQ(load(m_file).preset, "glass_soft");
  EXPECT_EQ(load(m_file).material().bondWorkIndex, material("glass_soft").bondWorkIndex);
  const std::string noEnd = "is damaged: the name of its material preset has no end";
  for (const std::size_t at : {kPresetAt + 12, kCountsAt - 1}) {  // behind the name's end
    std::string bad = bytes;
    bad[at] = 'x';
    expectHas(refusalOf(m_file, bad), noEnd);
  }
  std::string endless = bytes;
  std::fill_n(endless.begin() + kPresetAt, kCountsAt - kPresetAt, 'x');
  expectHas(refusalOf(m_file, endless), noEnd);
  endless = bytes;
  endless[kPresetAt] = '\n';
  expectHas(refusalOf(m_file, endless), "preset is no name; allowed: up to 63 bytes");
}

// One of a library with more presets loads, and says so when it is asked for.
TEST_F(AssetVersions, UnknownPresetIsNamedWhereItIsUsed) {
  m_asset.preset = std::string(63, 'p');
  save(m_asset, m_file);
  const Asset asset = load(m_file);
  EXPECT_EQ(asset.preset, m_asset.preset);
  try {
    asset.material();
    ADD_FAILURE();
  } catch (const Error& error) {
    expectHas(error.what(), "must be one of concrete_soft");
  }
  m_asset.preset += 'p';
  EXPECT_THROW(save(m_asset, m_file), Error);
}

// What version 4 held of a cube at geo-coordinates: corners on planes half a metre apart. A cube of 1 m about
// (5e5, 0, 6e6) m of 8 elements is whole there, for its corners are multiples of half a metre.
TEST_F(AssetVersions, PlacesThatFloatsDoNotHoldAreRefused) {
  const Asset far = gridAsset({{2, 2, 2}, 0.5, Eigen::Vector3d(499'999.5, -0.5, 5'999'999.5)});
  const std::string refused =
      "the vertices lie up to 6e+06 m from the frame's origin, where floats hold them to";
  try {
    far.validate();
    ADD_FAILURE();
  } catch (const Error& error) {
    expectHas(error.what(), refused);
  }
  writeBytes(m_file, oldBytesOf(far));
  expectHas(refusal(m_file), refused);
  expectHas(refusal(m_file), "cook it again");
  // The same about its own middle; and one as far out as it is large.
  EXPECT_NO_THROW(gridAsset({{2, 2, 2}, 0.5, Eigen::Vector3d(-0.5, -0.5, -0.5)}).validate());
  EXPECT_NO_THROW(gridAsset({{2, 2, 2}, 500, Eigen::Vector3d(1000, 0, 0)}).validate());
}

TEST_F(AssetVersions, GapsHoldNothing) {
  const Asset asset = wholeAsset();
  save(asset, m_file);
  const std::string bytes = fileBytes(m_file);
  const std::size_t anchorsAt = kHeaderBytes + 40 * asset.positions.size() + 16 * asset.springs.size();
  const std::size_t namesEnd = bytes.size() - 56 * asset.elementCount() - 8;  // seven bytes of names
  for (const std::size_t gap : {anchorsAt + 4, anchorsAt + 40 + 7, namesEnd - 1}) {
    ASSERT_EQ(bytes[gap], 0);
    std::string bad = bytes;
    bad[gap] = 1;
    expectHas(refusalOf(m_file, bad), "box.asset: is damaged: bytes between its arrays are not zero");
  }
  // A file that ends in the middle of a gap.
  Asset named = m_asset;
  named.materialNames = {"stone", ""};
  save(named, m_file);
  const std::string short1 = fileBytes(m_file).substr(0, fileBytes(m_file).size() - 1);
  expectHas(refusalOf(m_file, short1), "7 bytes of names do not fit into the file's");
}

// Counts whose bytes, gaps included, wrap round to few.
TEST_F(AssetVersions, CountsThatWrapRoundAreRefused) {
  for (std::size_t array = 0; array < 11; ++array)
    for (const std::uint64_t count :
         {~std::uint64_t(0), ~std::uint64_t(0) / 40, ~std::uint64_t(0) / 20 + 1, std::uint64_t(1) << 63,
          std::uint64_t(1) << 62, std::uint64_t(m_bytes.size())}) {
      std::string bytes = m_bytes;
      setNumber(bytes, kCountsAt + 8 * array, count);
      expectHas(refusalOf(m_file, bytes), "do not fit into the file");
    }
}

// The checksum of a whole file covers every byte behind it.
TEST_F(AssetVersions, AnyByteChangedIsRefused) {
  for (std::size_t at = 0; at < m_bytes.size(); ++at) {
    std::string bytes = m_bytes;
    bytes[at] = char(bytes[at] ^ 0x80);
    writeBytes(m_file, bytes);
    EXPECT_NE(refusal(m_file), "") << at;
  }
}

}  // namespace
}  // namespace rubble::test
