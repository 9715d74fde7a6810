// Writes beside the target and renames, so that the file appears whole or not at all.
#include <algorithm>
#include <bit>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <random>
#include <span>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "base/asset_format.h"
#include "base/hash.h"
#include "base/input_file.h"

namespace rubble {
namespace {

using namespace base;

// A file of a name of its own, gone again unless it gets its place.
class PartialFile {
 public:
  // Beside the target, so that the rename stays within one file system; the random suffix keeps two writers
  // apart.
  explicit PartialFile(const std::filesystem::path& target) : m_target(target), m_path(target) {
    m_path += ".partial" + std::to_string(std::random_device{}());
    errno = 0;
    m_stream.open(m_path, std::ios::binary | std::ios::trunc);
    if (!m_stream) fail(errno);
  }
  PartialFile(const PartialFile&) = delete;
  PartialFile& operator=(const PartialFile&) = delete;
  ~PartialFile() {
    std::error_code ignored;  // it may be in its place already, or never have been made
    m_stream.close();
    std::filesystem::remove(m_path, ignored);
  }

  void write(std::span<const std::uint8_t> bytes) {
    errno = 0;
    m_stream.write(reinterpret_cast<const char*>(bytes.data()), std::streamsize(bytes.size()));
    if (!m_stream) fail(errno);
  }
  void seek(std::size_t offset) {
    errno = 0;
    m_stream.seekp(std::streamoff(offset));  // writes what is buffered
    if (!m_stream) fail(errno);
  }
  void takePlace() {
    errno = 0;
    m_stream.close();
    if (!m_stream) fail(errno);
    std::error_code error;
    std::filesystem::rename(m_path, m_target, error);
    if (error) fail(error.value());
  }

 private:
  [[noreturn]] void fail(int error) const {
    refuseFile(m_target,
               "cannot be written" + (error == 0 ? "" : ": " + std::generic_category().message(error)));
  }

  const std::filesystem::path& m_target;
  std::filesystem::path m_path;
  std::ofstream m_stream;
};

// Gathers blocks and writes them; adds up the checksum of the body.
class Writer {
 public:
  explicit Writer(PartialFile& file) : m_file(file) { m_block.reserve(kAssetBlock); }

  template <class T>
  requires std::is_arithmetic_v<T>
  void put(T value) {
    auto bytes = std::bit_cast<std::array<std::uint8_t, sizeof(T)>>(value);
    if constexpr (std::endian::native == std::endian::big) std::reverse(bytes.begin(), bytes.end());
    put(std::span<const std::uint8_t>(bytes));
  }
  template <class Scalar, int N>
  void put(const Eigen::Matrix<Scalar, N, 1>& v) {
    for (int axis = 0; axis < N; ++axis) put(v[axis]);
  }
  template <std::size_t N>
  void put(const std::array<std::uint32_t, N>& values) {
    for (const std::uint32_t value : values) put(value);
  }

  // The body begins with the next number.
  void startBody() {
    write();
    m_checksum = Fnv1a::kOffsetBasis;
  }
  // The body ends with the last number: its checksum.
  std::uint64_t finish() {
    write();
    return m_checksum;
  }

 private:
  void put(std::span<const std::uint8_t> bytes) {
    for (const std::uint8_t byte : bytes) {
      m_block.push_back(byte);
      if (m_block.size() == kAssetBlock) write();
    }
  }
  void write() {
    m_checksum = checksum(m_block, m_checksum);
    m_file.write(m_block);
    m_block.clear();
  }

  PartialFile& m_file;
  std::vector<std::uint8_t> m_block;
  std::uint64_t m_checksum = Fnv1a::kOffsetBasis;
};

void checkTarget(const std::filesystem::path& file) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(file, error);
  if (std::filesystem::is_directory(status)) refuseFile(file, "is a folder; allowed: a file, old or new");
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
    refuseFile(file, "is a pipe, a socket or a device; allowed: a file, old or new");
}

AssetCounts countsOf(const Asset& asset, std::size_t nameBytes, const std::filesystem::path& file) {
  const AssetCounts counts = {asset.positions.size(),
                              asset.springs.size(),
                              asset.anchors.size(),
                              asset.vertices.size(),
                              asset.corners.size(),
                              asset.triangles.size(),
                              asset.faces.size(),
                              asset.cells.size(),
                              asset.uvs.size(),
                              asset.materials.size(),
                              nameBytes,
                              asset.rest ? asset.positions.size() : 0};
  std::uint64_t bytes = kAssetLookHeaderBytes + (asset.rest ? kAssetRestKeyBytes : 0);
  for (std::size_t a = 0; a < kAssetArrays; ++a) bytes += counts[a] * kAssetRecords[a].bytes;
  if (bytes > kMostAssetBytes)
    refuseFile(file, "would have " + std::to_string(bytes) + " bytes; allowed: up to " +
                         std::to_string(kMostAssetBytes));
  return counts;
}

}  // namespace

void save(const Asset& asset, const std::filesystem::path& file) {
  asset.validate();
  checkTarget(file);
  const std::string names = nameBytesOf(asset);
  const AssetCounts counts = countsOf(asset, names.size(), file);
  const bool hasLook = !asset.uvs.empty() || !asset.materials.empty() || !names.empty();
  PartialFile partial(file);
  Writer writer(partial);
  for (const char letter : kAssetMagic) writer.put(letter);
  writer.put(hasLook ? kAssetVersionWithLook : asset.rest ? kAssetVersionWithRest : kAssetVersion);
  writer.put(std::uint32_t(hasLook ? kAssetLookHeaderBytes : kAssetHeaderBytes));
  writer.put(std::uint64_t{0});  // the checksum's place
  writer.startBody();
  writer.put(asset.radius);
  for (const std::uint64_t count : std::span(counts).first(hasLook ? kAssetArrays : kShapeArrays))
    writer.put(count);
  visitAssetFields(asset, names, [&writer](const auto& value) { writer.put(value); });
  const std::uint64_t sum = writer.finish();
  partial.seek(kAssetChecksumOffset);
  writer.put(sum);
  writer.finish();
  partial.takePlace();
}

}  // namespace rubble
