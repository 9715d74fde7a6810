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

  void write(std::span<const std::byte> bytes) {
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

// Writes the file and adds up the checksum of it. A visitor of visitAssetArrays.
class Writer {
 public:
  explicit Writer(PartialFile& file) : m_file(file) {}

  template <class T>
  void number(T value) {
    turnBytes(value);
    write(std::as_bytes(std::span(&value, 1)));
  }
  template <class Records>
  void array(AssetArray, const Records& records) {
    if constexpr (std::endian::native == std::endian::little) {
      write(std::as_bytes(std::span(records)));
    } else {
      for (auto record : records) {
        visitRecord(record, [](auto& value) { turnBytes(value); });
        write(std::as_bytes(std::span(&record, 1)));
      }
    }
    pad(records.size() * sizeof(typename Records::value_type));
  }
  // In memory they have a gap.
  void array(AssetArray, const std::vector<AssetAnchor>& anchors) {
    for (const AssetAnchor& anchor : anchors) {
      number(anchor.element);
      pad(sizeof anchor.element);
      number(anchor.area);
      for (const double coordinate : anchor.point) number(coordinate);
    }
  }

  // The body begins with the next number.
  void startBody() { m_checksum = FileChecksum(FileChecksum::kLanes); }
  std::uint64_t checksum() const { return m_checksum.value(); }

 private:
  void pad(std::size_t bytesBefore) {
    constexpr std::array<std::byte, kAssetAlignment> kZeros{};
    write(std::span(kZeros).first((kAssetAlignment - bytesBefore % kAssetAlignment) % kAssetAlignment));
  }
  void write(std::span<const std::byte> bytes) {
    m_checksum.add(bytes);
    m_file.write(bytes);
  }

  PartialFile& m_file;
  FileChecksum m_checksum{FileChecksum::kLanes};
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
  std::uint64_t bytes = kAssetLayouts.back().headerBytes() + (asset.rest ? kAssetRestKeyBytes : 0);
  for (int a = 0; a < kAssetArrays; ++a)
    bytes += assetArrayBytes(AssetArray(a), counts[std::size_t(a)], true);
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
  PartialFile partial(file);
  Writer writer(partial);
  for (const char letter : kAssetMagic) writer.number(letter);
  writer.number(kAssetVersion);
  writer.number(std::uint32_t(kAssetLayouts.back().headerBytes()));
  writer.number(std::uint64_t{0});  // the checksum's place
  writer.startBody();
  writer.number(asset.radius);
  for (const double coordinate : asset.origin) writer.number(coordinate);
  std::array<char, kAssetPresetBytes> preset{};
  asset.preset.copy(preset.data(), preset.size() - 1);
  for (const char letter : preset) writer.number(letter);
  for (const std::uint64_t count : counts) writer.number(count);
  visitAssetArrays(asset, names, writer);
  const std::uint64_t sum = writer.checksum();
  partial.seek(kAssetChecksumOffset);
  writer.number(sum);
  partial.takePlace();
}

}  // namespace rubble
