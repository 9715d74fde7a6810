// The static state in an asset's file: an optional section at its end, believed no more than the rest.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "support/strict_cook.h"
#include "unit/base/asset_old_bytes.h"
#include "unit/cook/shapes.h"

namespace rubble::test {
namespace {

constexpr std::size_t kElements = 12;
// key | displacements | rotations
constexpr std::size_t kRestBytes = 8 + kElements * (3 + 4) * 8;

class RestSection : public testing::Test {
 protected:
  RestSection() {
    const std::string name = testing::UnitTest::GetInstance()->current_test_info()->name();
    m_folder = std::filesystem::path(testing::TempDir()) / ("rubble_asset_rest_" + name);
    std::filesystem::create_directories(m_folder);
    m_file = m_folder / "box.asset";
    CookOptions options = optionsFor(kElements);
    options.anchorDirection = -Eigen::Vector3d::UnitY();
    m_asset = cookStrictly(boxMesh({1, 1, 1}), options);
    save(m_asset, m_file);
    m_bare = fileBytes(m_file);
    AssetRest rest;
    rest.key = 0x0123456789abcdefu;
    for (std::size_t i = 0; i < kElements; ++i) {
      rest.displacements.emplace_back(1e-5 * double(i), -1.0 / 3 * 1e-4, -0.0);
      rest.rotations.emplace_back(
          Eigen::Quaterniond(Eigen::AngleAxisd(1e-3 * double(i), Eigen::Vector3d(1, 2, 2) / 3)));
    }
    m_asset.rest = rest;
    save(m_asset, m_file);
    m_bytes = fileBytes(m_file);
  }
  ~RestSection() override { std::filesystem::remove_all(m_folder); }

  std::filesystem::path m_folder, m_file;
  Asset m_asset;
  std::string m_bare, m_bytes;  // the files without and with it
};

TEST_F(RestSection, ComesBackBitByBit) {
  ASSERT_EQ(m_bytes.size(), m_bare.size() + kRestBytes);
  const Asset read = load(m_file);
  ASSERT_TRUE(read.rest);
  EXPECT_EQ(read.rest->key, m_asset.rest->key);
  EXPECT_EQ(read.rest->displacements, m_asset.rest->displacements);
  ASSERT_EQ(read.rest->rotations.size(), kElements);
  for (std::size_t i = 0; i < kElements; ++i)
    EXPECT_EQ(read.rest->rotations[i].coeffs(), m_asset.rest->rotations[i].coeffs());
  save(read, m_file);
  EXPECT_EQ(fileBytes(m_file), m_bytes);
}

TEST_F(RestSection, IsOptional) {
  EXPECT_TRUE(m_bytes.substr(kHeaderBytes, m_bare.size() - kHeaderBytes) == m_bare.substr(kHeaderBytes));
  writeBytes(m_file, m_bare);
  EXPECT_FALSE(load(m_file).rest);
}

TEST_F(RestSection, OfAWrongLengthIsRefused) {
  for (const std::size_t cut : {std::size_t(1), std::size_t(8), kRestBytes - 1, kRestBytes})
    expectHas(refusalOf(m_file, m_bytes.substr(0, m_bytes.size() - cut)),
              "box.asset: is cut off or damaged: " + std::to_string(kRestBytes - cut) +
                  " bytes are left for the " + std::to_string(kRestBytes) + " of its static state");
  expectHas(refusalOf(m_file, m_bytes + std::string(56, '\0')), "56 bytes too many at its end");
  std::string renamed = oldBytesOf(m_asset);  // the section is there, the version says that it is not
  setNumber(renamed, kVersionAt, std::uint32_t(1));
  expectHas(refusalOf(m_file, renamed), std::to_string(kRestBytes) + " bytes too many at its end");
}

TEST_F(RestSection, WithAChangedBitIsRefused) {
  for (std::size_t at = m_bare.size(); at < m_bytes.size(); at += 7) {
    std::string bytes = m_bytes;
    bytes[at] = char(bytes[at] ^ 4);
    writeBytes(m_file, bytes);
    EXPECT_THROW(load(m_file), Error) << "byte " << at;
  }
}

// With a right checksum: every number of it by itself.
TEST_F(RestSection, WithAbsurdNumbersIsRefused) {
  ASSERT_EQ(refusalOf(m_file, m_bytes), "");
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const std::size_t numbers = m_bare.size() + 8, rotations = numbers + kElements * 3 * 8;
  for (std::size_t at = numbers; at < m_bytes.size(); at += 8)
    for (const double value : {1e300, -1e300, 2.0, infinity, -infinity, std::nan("")}) {
      std::string bytes = m_bytes;
      setNumber(bytes, at, value);
      const std::string text = refusalOf(m_file, bytes);
      expectHas(text, at < rotations ? "rest.displacements[" : "rest.rotations[");
      expectHas(text, "allowed");
    }
}

TEST_F(RestSection, ThatIsImpossibleIsNeverWritten) {
  struct Fault {
    const char* words;
    std::function<void(AssetRest&)> make;
  };
  const std::vector<Fault> faults = {
      {"rest.displacements", [](AssetRest& r) { r.displacements.pop_back(); }},
      {"rest.rotations", [](AssetRest& r) { r.rotations.emplace_back(1, 0, 0, 0); }},
      {"rest.rotations", [](AssetRest& r) { r.rotations.clear(); }},
      {"rest.displacements[3] has length 1.8 m; allowed: up to the bounds' diagonal, 1.73",
       [](AssetRest& r) {
         r.displacements[3] = {0, 1.8, 0};
       }},
      {"rest.rotations[4] has length 0; allowed: 1", [](AssetRest& r) { r.rotations[4].coeffs().setZero(); }},
      {"rest.rotations[4] has length 1", [](AssetRest& r) { r.rotations[4].coeffs() *= 1 + 1e-6; }}};
  for (const Fault& fault : faults) {
    Asset bad = m_asset;
    fault.make(*bad.rest);
    try {
      save(bad, m_folder / "bad.asset");
      ADD_FAILURE() << "written; expected: " << fault.words;
    } catch (const Error& error) {
      expectHas(error.what(), fault.words);
    }
  }
  EXPECT_FALSE(std::filesystem::exists(m_folder / "bad.asset"));
}

}  // namespace
}  // namespace rubble::test
