// The asset file. Little-endian whatever the host; every record is written field by field, so padding never
// shows.
//
//   magic "RUBBLEAS" | version u32 | header size u32 | checksum u64 | radius f64 | 8 counts u64 | the arrays,
//   in that order
//
// The checksum covers everything behind it. The reader works out from the counts how long the file must be,
// and compares with how long it is, before it allocates anything for them.
#include <array>
#include <bit>
#include <cstring>
#include <fstream>
#include <random>
#include <sstream>
#include <system_error>
#include <utility>

#include "base/hash.h"
#include "rubble/asset.h"
#include "rubble/error.h"

namespace rubble {
namespace {

constexpr std::array<char, 8> kMagic = {'R', 'U', 'B', 'B', 'L', 'E', 'A', 'S'};
constexpr std::uint32_t kVersion = 1;

enum Array { kElements, kSprings, kAnchors, kVertices, kCorners, kTriangles, kFaces, kCells, kArrayCount };

// Bytes of one record of each array in the file, and what messages call it.
struct RecordKind {
  std::uint64_t bytes;
  const char* name;
};
constexpr std::array<RecordKind, kArrayCount> kRecords = {{{3 * 8 + 8 + 8, "elements"},
                                                           {4 + 4 + 8, "springs"},
                                                           {4 + 8 + 3 * 8, "anchors"},
                                                           {3 * 4 + 4 * 4, "cell vertices"},
                                                           {4 + 4 + 3 * 4, "corners"},
                                                           {3 * 4, "triangles"},
                                                           {4 + 4 + 3 * 4 + 3 * 4, "faces"},
                                                           {5 * 4, "cells"}}};

constexpr std::size_t kChecksumOffset = kMagic.size() + 4 + 4;
constexpr std::size_t kBodyOffset = kChecksumOffset + 8;  // the checksum covers the file from here on
constexpr std::size_t kHeaderBytes = kBodyOffset + 8 + 8 * kArrayCount;

class Writer {
 public:
  explicit Writer(std::size_t bytes) { m_bytes.reserve(bytes); }

  void put(std::uint32_t value) { putLittleEndian(value, 4); }
  void put(std::uint64_t value) { putLittleEndian(value, 8); }
  void put(float value) { put(std::bit_cast<std::uint32_t>(value)); }
  void put(double value) { put(std::bit_cast<std::uint64_t>(value)); }
  template <class Scalar>
  void put(const Eigen::Matrix<Scalar, 3, 1>& v) {
    for (int axis = 0; axis < 3; ++axis) put(v[axis]);
  }
  template <std::size_t N>
  void put(const std::array<std::uint32_t, N>& values) {
    for (const std::uint32_t value : values) put(value);
  }
  void putMagic() { m_bytes.insert(m_bytes.end(), kMagic.begin(), kMagic.end()); }

  void setChecksum() {
    const std::uint64_t sum = base::checksum(std::span(m_bytes).subspan(kBodyOffset));
    for (std::size_t b = 0; b < 8; ++b) m_bytes[kChecksumOffset + b] = std::uint8_t(sum >> (8 * b));
  }

  std::vector<std::uint8_t> take() { return std::move(m_bytes); }

 private:
  void putLittleEndian(std::uint64_t value, int count) {
    for (int b = 0; b < count; ++b) m_bytes.push_back(std::uint8_t(value >> (8 * b)));
  }

  std::vector<std::uint8_t> m_bytes;
};

// Reads in the order the Writer wrote. The caller has made sure that there are enough bytes.
class Reader {
 public:
  explicit Reader(std::span<const std::uint8_t> bytes) : m_bytes(bytes) {}

  void get(std::uint32_t& value) { value = std::uint32_t(getLittleEndian(4)); }
  void get(std::uint64_t& value) { value = getLittleEndian(8); }
  void get(float& value) { value = std::bit_cast<float>(std::uint32_t(getLittleEndian(4))); }
  void get(double& value) { value = std::bit_cast<double>(getLittleEndian(8)); }
  template <class Scalar>
  void get(Eigen::Matrix<Scalar, 3, 1>& v) {
    for (int axis = 0; axis < 3; ++axis) get(v[axis]);
  }
  template <std::size_t N>
  void get(std::array<std::uint32_t, N>& values) {
    for (std::uint32_t& value : values) get(value);
  }
  void skip(std::size_t count) { m_at += count; }

 private:
  std::uint64_t getLittleEndian(std::size_t count) {
    std::uint64_t value = 0;
    for (std::size_t b = 0; b < count; ++b) value |= std::uint64_t(m_bytes[m_at + b]) << (8 * b);
    m_at += count;
    return value;
  }

  std::span<const std::uint8_t> m_bytes;
  std::size_t m_at = 0;
};

// One description of the arrays' fields serves both directions: `field` is Writer::put or Reader::get.
template <class AssetType, class Field>
void visitArrays(AssetType& asset, Field&& field) {
  for (auto& position : asset.positions) field(position);
  for (auto& volume : asset.volumes) field(volume);
  for (auto& gyration : asset.gyrations) field(gyration);
  for (auto& s : asset.springs) field(s.first), field(s.second), field(s.area);
  for (auto& a : asset.anchors) field(a.element), field(a.area), field(a.point);
  for (auto& v : asset.vertices) field(v.position), field(v.elements);
  for (auto& c : asset.corners) field(c.vertex), field(c.element), field(c.normal);
  for (auto& triangle : asset.triangles) field(triangle);
  for (auto& f : asset.faces) field(f.neighbour), field(f.area), field(f.normal), field(f.centroid);
  for (auto& c : asset.cells)
    field(c.firstTriangle), field(c.outerTriangles), field(c.innerTriangles), field(c.firstFace),
        field(c.faceCount);
}

[[noreturn]] void fail(const std::filesystem::path& file, const std::string& what) {
  throw Error(file.string() + ": " + what);
}

std::vector<std::uint8_t> encode(const Asset& asset) {
  const std::array<std::uint64_t, kArrayCount> counts = {
      asset.positions.size(), asset.springs.size(),   asset.anchors.size(), asset.vertices.size(),
      asset.corners.size(),   asset.triangles.size(), asset.faces.size(),   asset.cells.size()};
  std::size_t bytes = kHeaderBytes;
  for (std::size_t a = 0; a < kArrayCount; ++a) bytes += counts[a] * kRecords[a].bytes;

  Writer writer(bytes);
  writer.putMagic();
  writer.put(kVersion);
  writer.put(std::uint32_t(kHeaderBytes));
  writer.put(std::uint64_t{0});  // the checksum's place
  writer.put(asset.radius);
  for (const std::uint64_t count : counts) writer.put(count);
  visitArrays(asset, [&writer](const auto& value) { writer.put(value); });
  writer.setChecksum();
  return writer.take();
}

std::vector<std::uint8_t> readWhole(const std::filesystem::path& file) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) fail(file, "no such file");
  const std::uintmax_t size = std::filesystem::file_size(file, error);
  if (error) fail(file, "cannot be read: " + error.message());
  if (size < kHeaderBytes) fail(file, "is cut off, or not an asset: shorter than an asset's header");
  std::vector<std::uint8_t> bytes(size);
  std::ifstream stream(file, std::ios::binary);
  stream.read(reinterpret_cast<char*>(bytes.data()), std::streamsize(size));
  if (!stream) fail(file, "cannot be read");
  return bytes;
}

void checkLength(const std::filesystem::path& file, std::uint64_t length,
                 const std::array<std::uint64_t, kArrayCount>& counts) {
  std::uint64_t left = length - kHeaderBytes;
  for (std::size_t a = 0; a < kArrayCount; ++a) {
    if (counts[a] > left / kRecords[a].bytes) {
      std::ostringstream text;
      text << "is cut off or damaged: " << counts[a] << ' ' << kRecords[a].name
           << " do not fit into the file's " << length << " bytes";
      fail(file, text.str());
    }
    left -= counts[a] * kRecords[a].bytes;
  }
  if (left != 0) fail(file, "is damaged: " + std::to_string(left) + " bytes too many at its end");
}

Asset decode(const std::filesystem::path& file, std::span<const std::uint8_t> bytes) {
  if (std::memcmp(bytes.data(), kMagic.data(), kMagic.size()) != 0) fail(file, "is not a rubble asset");
  Reader reader(bytes);
  reader.skip(kMagic.size());
  std::uint32_t version = 0;
  std::uint32_t headerBytes = 0;
  std::uint64_t sum = 0;
  reader.get(version);
  reader.get(headerBytes);
  reader.get(sum);
  if (version != kVersion)
    fail(file, "has asset version " + std::to_string(version) + "; this library reads version " +
                   std::to_string(kVersion) + ": cook it again");
  if (headerBytes != kHeaderBytes) fail(file, "is damaged: impossible header size");

  Asset asset;
  std::array<std::uint64_t, kArrayCount> counts{};
  reader.get(asset.radius);
  for (std::uint64_t& count : counts) reader.get(count);
  checkLength(file, bytes.size(), counts);
  if (base::checksum(bytes.subspan(kBodyOffset)) != sum)
    fail(file, "is damaged: its checksum does not match");

  asset.positions.resize(counts[kElements]);
  asset.volumes.resize(counts[kElements]);
  asset.gyrations.resize(counts[kElements]);
  asset.springs.resize(counts[kSprings]);
  asset.anchors.resize(counts[kAnchors]);
  asset.vertices.resize(counts[kVertices]);
  asset.corners.resize(counts[kCorners]);
  asset.triangles.resize(counts[kTriangles]);
  asset.faces.resize(counts[kFaces]);
  asset.cells.resize(counts[kCells]);
  visitArrays(asset, [&reader](auto& value) { reader.get(value); });
  return asset;
}

}  // namespace

void save(const Asset& asset, const std::filesystem::path& file) {
  asset.validate();
  const std::vector<std::uint8_t> bytes = encode(asset);
  // Beside the target, so that the rename stays within one file system; a random suffix keeps two writers
  // apart.
  std::filesystem::path partial = file;
  partial += ".partial" + std::to_string(std::random_device{}());
  std::error_code error;
  {
    std::ofstream stream(partial, std::ios::binary | std::ios::trunc);
    stream.write(reinterpret_cast<const char*>(bytes.data()), std::streamsize(bytes.size()));
    stream.close();
    if (!stream) {
      std::filesystem::remove(partial, error);
      fail(file, "cannot be written");
    }
  }
  std::filesystem::rename(partial, file, error);
  if (error) {
    const std::string reason = error.message();
    std::filesystem::remove(partial, error);
    fail(file, "cannot be written: " + reason);
  }
}

Asset load(const std::filesystem::path& file) {
  const std::vector<std::uint8_t> bytes = readWhole(file);
  Asset asset = decode(file, bytes);
  try {
    asset.validate();
  } catch (const Error& error) {
    fail(file, std::string("holds an impossible ") + error.what());
  }
  return asset;
}

}  // namespace rubble
