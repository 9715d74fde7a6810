// Asset files: what goes in comes out, and nothing damaged gets through.
#include <gtest/gtest.h>

#include <fstream>
#include <functional>
#include <random>

#include "support/strict_cook.h"
#include "unit/base/asset_bytes.h"
#include "unit/cook/shapes.h"

namespace rubble::test {
namespace {

class AssetFile : public testing::Test {
 protected:
  AssetFile() {
    const std::string name = testing::UnitTest::GetInstance()->current_test_info()->name();
    m_folder = std::filesystem::path(testing::TempDir()) / ("rubble_asset_file_" + name);
    std::filesystem::create_directories(m_folder);
    m_file = m_folder / "box.asset";
    CookOptions options = optionsFor(20);
    options.anchorDirection = -Eigen::Vector3d::UnitY();
    m_asset = cookStrictly(boxMesh({1, 1, 1}), options);
    save(m_asset, m_file);
    m_bytes = fileBytes(m_file);
  }
  ~AssetFile() override { std::filesystem::remove_all(m_folder); }

  void write(const std::string& bytes) const {
    std::ofstream(m_file, std::ios::binary | std::ios::trunc)
        .write(bytes.data(), std::streamsize(bytes.size()));
  }

  // Must be refused with one line that names the file and holds one of the words.
  void expectRefused(const std::string& bytes, const std::string& words) const {
    write(bytes);
    try {
      load(m_file);
      ADD_FAILURE() << "loaded; expected: " << words;
    } catch (const Error& error) {
      const std::string text = error.what();
      EXPECT_NE(text.find("box.asset: "), std::string::npos) << text;
      EXPECT_NE(text.find(words), std::string::npos) << text;
      EXPECT_EQ(text.find('\n'), std::string::npos) << text;
    }
  }

  std::filesystem::path m_folder, m_file;
  Asset m_asset;
  std::string m_bytes;
};

TEST_F(AssetFile, ComesBackAsItWas) {
  const Asset read = load(m_file);
  EXPECT_EQ(read.radius, m_asset.radius);
  EXPECT_EQ(read.origin, m_asset.origin);
  EXPECT_EQ(read.positions, m_asset.positions);
  EXPECT_EQ(read.volumes, m_asset.volumes);
  EXPECT_EQ(read.gyrations, m_asset.gyrations);
  EXPECT_EQ(read.triangles, m_asset.triangles);
  ASSERT_EQ(read.springs.size(), m_asset.springs.size());
  for (std::size_t s = 0; s < read.springs.size(); ++s) {
    EXPECT_EQ(read.springs[s].first, m_asset.springs[s].first);
    EXPECT_EQ(read.springs[s].second, m_asset.springs[s].second);
    EXPECT_EQ(read.springs[s].area, m_asset.springs[s].area);
  }
  ASSERT_EQ(read.anchors.size(), m_asset.anchors.size());
  ASSERT_FALSE(read.anchors.empty());
  for (std::size_t a = 0; a < read.anchors.size(); ++a)
    EXPECT_EQ(read.anchors[a].point, m_asset.anchors[a].point);
  ASSERT_EQ(read.corners.size(), m_asset.corners.size());
  for (std::size_t c = 0; c < read.corners.size(); ++c)
    EXPECT_EQ(read.corners[c].normal, m_asset.corners[c].normal);
  ASSERT_EQ(read.vertices.size(), m_asset.vertices.size());
  for (std::size_t v = 0; v < read.vertices.size(); ++v)
    EXPECT_EQ(read.vertices[v].elements, m_asset.vertices[v].elements);
  ASSERT_EQ(read.faces.size(), m_asset.faces.size());
  for (std::size_t f = 0; f < read.faces.size(); ++f)
    EXPECT_EQ(read.faces[f].centroid, m_asset.faces[f].centroid);
  ASSERT_EQ(read.cells.size(), m_asset.cells.size());
  for (std::size_t i = 0; i < read.cells.size(); ++i)
    EXPECT_EQ(read.cells[i].innerTriangles, m_asset.cells[i].innerTriangles);
}

TEST_F(AssetFile, LeavesNothingBesideItself) {
  save(m_asset, m_file);  // over the old one
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(m_folder), {}), 1);
}

TEST_F(AssetFile, IsRefusedCutOffAnywhere) {
  for (std::size_t k = 0; k < 50; ++k)
    expectRefused(m_bytes.substr(0, m_bytes.size() * k / 50), "is cut off");
  expectRefused(m_bytes.substr(0, m_bytes.size() - 1), "is cut off");
}

TEST_F(AssetFile, IsRefusedWithBytesAtItsEnd) {
  expectRefused(m_bytes + "x", "1 bytes too many");
}

TEST_F(AssetFile, IsRefusedWithAnyBitFlipped) {
  std::mt19937_64 generator(1);
  for (int k = 0; k < 400; ++k) {
    std::string bytes = m_bytes;
    // The whole header bit by bit in the first rounds would take 768; random bits of it and of the rest do.
    const std::size_t range = k % 2 == 0 ? kHeaderBytes + 8 : bytes.size();
    const std::size_t at = generator() % range;
    bytes[at] = char(bytes[at] ^ (1 << (generator() % 8)));
    expectRefused(bytes, "");
  }
}

TEST_F(AssetFile, OfAnotherVersionIsRefusedByName) {
  std::string bytes = m_bytes;
  bytes[kVersionAt] = 77;
  expectRefused(bytes, "has asset version 77; this library reads versions 1 to 6");
}

TEST_F(AssetFile, OfAnotherKindIsRefusedByName) {
  expectRefused(std::string(1000, 'a'), "is not a rubble asset");
  expectRefused("", "is cut off, or not an asset");
}

// Counts are compared with the file's length before anything is allocated for them; a reader that trusted
// these would ask for 2^60 records or wrap round to a small size.
TEST_F(AssetFile, WithAbsurdCountsIsRefusedBeforeAllocating) {
  for (std::size_t array = 0; array < 8; ++array)
    for (const char top : {'\x10', '\x7f', '\xff'}) {
      std::string bytes = m_bytes;
      bytes[kCountsAt + 8 * array + 7] = top;
      expectRefused(bytes, "do not fit into the file");
    }
}

TEST_F(AssetFile, ThatIsMissingIsNamed) {
  try {
    load(m_folder / "none.asset");
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("none.asset: no such file"), std::string::npos);
  }
}

TEST_F(AssetFile, IntoAMissingFolderIsRefused) {
  EXPECT_THROW(save(m_asset, m_folder / "missing" / "box.asset"), Error);
}

TEST_F(AssetFile, OfAnImpossibleAssetIsNeverWritten) {
  const std::vector<std::function<void(Asset&)>> faults = {
      [](Asset& a) { a.radius = 0; },
      [](Asset& a) { a.positions[3].x() = std::nan(""); },
      [](Asset& a) { a.volumes[0] = -1; },
      [](Asset& a) { a.volumes.pop_back(); },
      [](Asset& a) { a.gyrations[0] = std::nan(""); },
      [](Asset& a) { a.springs[0].second = 20; },
      [](Asset& a) { a.springs[0].first = a.springs[0].second; },
      [](Asset& a) { a.springs[0].area = 0; },
      [](Asset& a) { std::swap(a.springs[0], a.springs[1]); },
      [](Asset& a) { a.anchors[0].element = 20; },
      [](Asset& a) { a.vertices[0].elements[0] = kNoElement; },
      [](Asset& a) { a.vertices[0].position.x() = std::nanf(""); },
      [](Asset& a) { a.corners[0].vertex = std::uint32_t(a.vertices.size()); },
      [](Asset& a) { a.corners[0].element = 21; },
      [](Asset& a) { a.corners[0].normal *= 2; },
      [](Asset& a) { a.triangles[0][0] = std::uint32_t(a.corners.size()); },
      [](Asset& a) { a.triangles[0][0] = std::uint32_t(a.corners.size() - 1); },  // of another cell
      [](Asset& a) { a.faces[0].neighbour = 20; },
      [](Asset& a) { a.faces[0].area = std::nanf(""); },
      [](Asset& a) { a.cells[0].innerTriangles = kNoElement; },
      [](Asset& a) { a.cells[1].firstFace += 1; },
      [](Asset& a) { a.cells.back().faceCount -= 1; }};
  for (std::size_t k = 0; k < faults.size(); ++k) {
    Asset bad = m_asset;
    faults[k](bad);
    EXPECT_THROW(bad.validate(), Error) << "fault " << k;
    EXPECT_THROW(save(bad, m_folder / "bad.asset"), Error) << "fault " << k;
  }
  EXPECT_FALSE(std::filesystem::exists(m_folder / "bad.asset"));
}

TEST(Asset, MeasuresItself) {
  const Asset asset = cookStrictly(boxMesh({1, 2, 4}, {10, 0, 0}), optionsFor(8));
  EXPECT_NEAR(asset.volume(), 8, 1e-12);
  EXPECT_NEAR(asset.spacing(), 1, 1e-12);
  EXPECT_NEAR(asset.diagonal(), std::sqrt(21.0), 1e-6);
  EXPECT_LT((asset.bounds().center() - Eigen::Vector3d(10, 0, 0)).norm(), 1e-6);
}

}  // namespace
}  // namespace rubble::test
