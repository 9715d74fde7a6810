// Files with a right checksum and wrong numbers, and paths that are no files.
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <functional>
#include <limits>
#include <random>

#include "base/asset_check.h"
#include "unit/base/asset_old_bytes.h"
#include "unit/cook/shapes.h"

namespace rubble::test {
namespace {

class HostileAsset : public testing::Test {
 protected:
  HostileAsset() {
    const std::string name = testing::UnitTest::GetInstance()->current_test_info()->name();
    m_folder = std::filesystem::path(testing::TempDir()) / ("rubble_hostile_asset_" + name);
    std::filesystem::remove_all(m_folder);
    std::filesystem::create_directories(m_folder);
    m_file = m_folder / "box.asset";
    CookOptions options = optionsFor(12);
    options.anchorDirection = -Eigen::Vector3d::UnitY();
    m_asset = cook(boxMesh({1, 1, 1}), options);
    save(m_asset, m_file);
    m_bytes = fileBytes(m_file);
  }
  ~HostileAsset() override { std::filesystem::remove_all(m_folder); }

  std::filesystem::path m_folder, m_file;
  Asset m_asset;
  std::string m_bytes;
};

struct AssetFault {
  const char* words;  // of the refusal
  std::function<void(Asset&)> make;
};

// Each of them alone, and the refusal says what is allowed.
void expectRefused(const Asset& good, const std::vector<AssetFault>& faults) {
  for (const AssetFault& fault : faults) {
    Asset bad = good;
    fault.make(bad);
    try {
      bad.validate();
      ADD_FAILURE() << "accepted; expected: " << fault.words;
    } catch (const Error& error) {
      expectHas(error.what(), fault.words);
      expectHas(error.what(), "allowed");
    }
  }
}

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// No field at all may hold these: no element is so large or so small, no place so far away.
TEST_F(HostileAsset, IsRefusedWithAbsurdNumbersAnywhere) {
  const std::string old = oldBytesOf(m_asset);
  std::mt19937_64 generator(3);
  for (int k = 0; k < 800; ++k) {
    std::string bytes = k < 600 ? m_bytes : old;
    ASSERT_EQ(refusalOf(m_file, bytes), "");
    const std::vector<NumberPlace> places = numberPlaces(bytes);
    const NumberPlace& place = places[generator() % places.size()];
    if (place.kind == NumberKind::Double) {
      for (const double value : {1e300, -1e300, 2e9, kInfinity, -kInfinity, std::nan("")}) {
        setNumber(bytes, place.at, value);
        EXPECT_NE(refusalOf(m_file, bytes), "") << place.name << " = " << value;
      }
    } else if (place.kind == NumberKind::Float) {
      for (const float value : {3e38f, -3e38f, 2e9f, float(kInfinity), std::nanf("")}) {
        setNumber(bytes, place.at, value);
        EXPECT_NE(refusalOf(m_file, bytes), "") << place.name << " = " << value;
      }
    } else {
      for (const std::uint32_t value : {0xfffffffeu, 0x80000000u, 1000000u}) {
        setNumber(bytes, place.at, value);
        EXPECT_NE(refusalOf(m_file, bytes), "") << place.name << " = " << value;
      }
    }
  }
}

TEST_F(HostileAsset, RadiusIsNamedWithWhatIsAllowed) {
  for (const double radius : {1e300, 1e-320, 0.0, -1.0, 1e-7, 2.0}) {
    std::string bytes = m_bytes;
    setNumber(bytes, kRadiusAt, radius);
    const std::string text = refusalOf(m_file, bytes);
    expectHas(text, "box.asset: ");
    expectHas(text, "radius is ");
    expectHas(text, "allowed: 1e-06 to half the bounds' diagonal");
  }
}

TEST_F(HostileAsset, ContradictionsAreNamed) {
  const std::vector<AssetFault> faults = {
      {"positions[1] is 0 m from positions[0]", [](Asset& a) { a.positions[1] = a.positions[0]; }},
      {"positions[", [](Asset& a) { a.positions[3] += Eigen::Vector3d(3, 0, 0); }},
      {"volumes[2] is", [](Asset& a) { a.volumes[2] *= 0.99; }},
      {"volumes[2] is", [](Asset& a) { a.volumes[2] = 1e-320; }},
      {"gyrations[4] is", [](Asset& a) { a.gyrations[4] *= 100; }},
      {"gyrations[4] is", [](Asset& a) { a.gyrations[4] = 1e-320; }},
      {"springs[0].area is", [](Asset& a) { a.springs[0].area *= 2; }},
      {"springs[0].area is", [](Asset& a) { a.springs[0].area = 1e-320; }},
      {"anchors[0].area is", [](Asset& a) { a.anchors[0].area = 7; }},
      {"anchors[0].point is", [](Asset& a) { a.anchors[0].point = a.positions[a.anchors[0].element]; }},
      {"anchors[0].point is", [](Asset& a) { a.anchors[0].point.y() -= 1; }},
      {"is in no corner", [](Asset& a) { a.vertices.push_back(a.vertices[0]); }},
      {"twice; allowed", [](Asset& a) { a.vertices[0].elements[1] = a.vertices[0].elements[0]; }},
      {"faces[0].area is", [](Asset& a) { a.faces[0].area = 10; }},
      {"faces[0].centroid is", [](Asset& a) { a.faces[0].centroid.x() += 5; }},
      {"its own cell", [](Asset& a) { a.faces[0].neighbour = 0; }},
      {"volumes[", [](Asset& a) { a.vertices[0].position.x() += 0.5f; }},
      {"cells[0] has", [](Asset& a) { a.cells[0].outerTriangles = kNoElement; }}};
  expectRefused(m_asset, faults);
}

// The cook puts a cell's corners together; a file need not, and gets away with nothing by it.
TEST_F(HostileAsset, CornersInAnyOrderAreChecked) {
  Asset turned = m_asset;
  std::reverse(turned.corners.begin(), turned.corners.end());
  const auto last = std::uint32_t(turned.corners.size() - 1);
  for (auto& triangle : turned.triangles)
    for (std::uint32_t& corner : triangle) corner = last - corner;
  EXPECT_NO_THROW(turned.validate());
  // Corner 0 is of the last cell, the first cell's are the last.
  const std::vector<AssetFault> faults = {
      {"corners[0].normal has length 2", [](Asset& a) { a.corners[0].normal *= 2; }},
      {"corners[0].normal has length 1", [](Asset& a) { a.corners[0].normal *= 1.0002f; }},
      {"corners[0].vertex is 4294967295", [](Asset& a) { a.corners[0].vertex = kNoElement; }},
      {"of cell 11 names corner 0;", [](Asset& a) { a.corners[0].element = kNoElement; }},
      {"triangles[0] of cell 0 names corner 0;", [](Asset& a) { a.triangles[0][0] = 0; }},
      {"triangles[0] of cell 0 names corner 4294967295", [](Asset& a) { a.triangles[0][0] = kNoElement; }},
      {"volumes[0] is",
       [](Asset& a) { std::swap(a.triangles[0], a.triangles[1]), a.triangles[1] = a.triangles[0]; }},
      // Of no triangle.
      {".vertex is 4294967294",
       [](Asset& a) {
         a.corners.push_back({kNoElement - 1, 0, Eigen::Vector3f::UnitX()});
       }},
      {".element is 4294967295", [](Asset& a) {
         a.corners.push_back({0, kNoElement, Eigen::Vector3f::UnitX()});
       }}};
  expectRefused(turned, faults);
}

// Threads check cells by ranges, and whoever finds something there has it told by one thread: of two faults
// the first, whatever part it is in.
TEST_F(HostileAsset, AnyNumberOfThreadsSaysTheSame) {
  const auto verdict = [](const Asset& asset, int threads) -> std::string {
    try {
      base::checkAsset(asset, threads);
    } catch (const Error& error) {
      return error.what();
    }
    return "valid";
  };
  // A corner that no triangle uses, among those of another cell.
  const auto insertCorner = [](Asset& a, const CellCorner& corner) {
    const std::uint32_t at = std::uint32_t(a.corners.size()) / 2;
    a.corners.insert(a.corners.begin() + at, corner);
    for (auto& triangle : a.triangles)
      for (std::uint32_t& c : triangle) c += c >= at ? 1 : 0;
  };
  struct Change {
    const char* words;
    std::function<void(Asset&)> make;
  };
  const std::vector<Change> changes = {
      {"valid", [](Asset&) {}},
      {"valid", [&](Asset& a) { insertCorner(a, a.corners[0]); }},
      {"corners[",
       [&](Asset& a) {
         insertCorner(a, {kNoElement, 0, Eigen::Vector3f::UnitX()});
       }},
      {"volumes[2] is", [](Asset& a) { a.volumes[2] *= 0.99, a.volumes[9] *= 0.99; }},
      {"volumes[9] is", [](Asset& a) { a.volumes[9] *= 0.99, a.positions[1] = a.positions[0]; }},
      {"anchors[", [](Asset& a) { a.anchors.back().area = 7; }},
      {"is in no corner", [](Asset& a) { a.vertices.push_back(a.vertices[0]); }},
      {".vertex is 4294967294",
       [](Asset& a) {
         a.corners.push_back({kNoElement - 1, 0, Eigen::Vector3f::UnitX()});
       }},
      {"springs[0].area is", [](Asset& a) { a.springs[0].area *= 2; }},
      {"m from positions[0]",
       [](Asset& a) { a.positions[1] = a.positions[0] + Eigen::Vector3d(1e-3, 0, 0); }}};
  for (const Change& change : changes) {
    Asset asset = m_asset;
    change.make(asset);
    const std::string one = verdict(asset, 1);
    expectHas(one, change.words);
    for (const int threads : {2, 3, 5, 12, 40}) EXPECT_EQ(verdict(asset, threads), one) << threads;
  }
}

TEST_F(HostileAsset, WhatIsNoFileIsCalledWhatItIs) {
  expectHas(refusal(m_folder), "is a folder");
  const std::filesystem::path pipe = m_folder / "pipe", link = m_folder / "link",
                              dangling = m_folder / "dangling";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  std::filesystem::create_symlink(pipe, link);
  std::filesystem::create_symlink(m_folder / "nothing", dangling);
  expectHas(refusal(pipe), "pipe: is a pipe");
  expectHas(refusal(link), "link: is a pipe");
  expectHas(refusal(dangling), "no such file");
  expectHas(refusal("/dev/zero"), "is a device");
  EXPECT_THROW(save(m_asset, pipe), Error);
  EXPECT_TRUE(std::filesystem::is_fifo(pipe));
  EXPECT_THROW(save(m_asset, m_folder), Error);
}

// 20 GB without a byte on the disk, named in the file's header or not.
TEST_F(HostileAsset, HugeFilesAreRefusedByTheirHeader) {
  writeBytes(m_file, "");
  std::filesystem::resize_file(m_file, 20'000'000'000u);
  expectHas(refusal(m_file), "box.asset: is not a rubble asset");
  writeBytes(m_file, m_bytes);
  std::filesystem::resize_file(m_file, 20'000'000'000u);
  expectHas(refusal(m_file), "bytes too many at its end");
  std::filesystem::resize_file(m_file, 40'000'000'000u);
  expectHas(refusal(m_file), "allowed: up to 34359738368");
}

// The limit of a file's size stands for a full disk: both fail in the middle of writing.
TEST_F(HostileAsset, IsNotReplacedOnAFullDisk) {
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small{m_bytes.size() / 2, before.rlim_max};
  setrlimit(RLIMIT_FSIZE, &small);
  std::string text;
  try {
    save(m_asset, m_file);
  } catch (const Error& error) {
    text = error.what();
  }
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  expectHas(text, "box.asset: cannot be written: File too large");
  EXPECT_EQ(fileBytes(m_file), m_bytes);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(m_folder), {}), 1);
}

}  // namespace
}  // namespace rubble::test
