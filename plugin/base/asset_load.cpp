// Reads an asset file once: header and length first, then the arrays straight into their places, each block
// into the checksum while it is in the cache. Memory is taken for as much as the file has.
#include <algorithm>
#include <bit>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <new>
#include <span>
#include <sstream>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "base/asset_format.h"
#include "base/hash.h"
#include "base/huge_pages.h"
#include "base/input_file.h"
#include "base/material_name.h"

namespace rubble {
namespace {

using namespace base;

std::string reasonOf(int error) {
  return error == 0 ? std::string() : ": " + std::generic_category().message(error);
}

// A plain number from its little-endian bytes.
template <class T>
T decoded(const std::uint8_t* bytes) {
  std::array<std::uint8_t, sizeof(T)> number;
  std::memcpy(number.data(), bytes, sizeof(T));
  if constexpr (std::endian::native == std::endian::big) std::reverse(number.begin(), number.end());
  return std::bit_cast<T>(number);
}

constexpr std::uint64_t kMostBytesOfNames = kMostMaterials * (kMostNameBytes + 1);

struct Header {
  AssetLayout layout;
  std::uint64_t checksum = 0;
  AssetCounts counts{};

  bool hasRest() const { return counts[kRest] > 0; }
};

// The file's body from its beginning on; adds up the checksum of what it has read. A visitor of
// visitAssetArrays. Asks for as many bytes as the length check has let through.
class BodyReader {
 public:
  BodyReader(const std::filesystem::path& file, std::ifstream& stream, const Header& header)
      : m_file(file),
        m_stream(stream),
        m_header(header),
        m_checksum(header.layout.isAligned ? FileChecksum::kLanes : 1) {
    m_stream.clear();
    m_stream.seekg(std::streamoff(kAssetBodyOffset));
  }

  template <class T>
  void number(T& value) {
    read(std::as_writable_bytes(std::span(&value, 1)));
    turnBytes(value);
  }
  template <class Records>
  void array(AssetArray array, Records& records) {
    using Record = typename Records::value_type;
    const std::size_t count = m_header.counts[array];
    records.reserve(count);
    preferHugePages(records.data(), count * sizeof(Record));
    // Zeros that it grows by are overwritten in the cache.
    for (std::size_t at = 0; at < count; at = records.size()) {
      records.resize(std::min(count, at + kAssetBlock / sizeof(Record)));
      const std::span<Record> block(records.data() + at, records.size() - at);
      read(std::as_writable_bytes(block));
      if constexpr (std::endian::native == std::endian::big)
        for (Record& record : block) visitRecord(record, [](auto& value) { turnBytes(value); });
    }
    skipPadding(count * sizeof(Record));
  }
  // In memory they have a gap.
  void array(AssetArray, std::vector<AssetAnchor>& anchors) {
    anchors.reserve(m_header.counts[kAnchors]);
    while (anchors.size() < m_header.counts[kAnchors]) {
      AssetAnchor anchor;
      number(anchor.element);
      skipPadding(sizeof anchor.element);
      number(anchor.area);
      for (double& coordinate : anchor.point) number(coordinate);
      anchors.push_back(anchor);
    }
  }
  std::uint64_t checksum() const { return m_checksum.value(); }

 private:
  void skipPadding(std::size_t bytesBefore) {
    if (!m_header.layout.isAligned) return;
    std::array<std::byte, kAssetAlignment> zeros{};
    read(std::span(zeros).first((kAssetAlignment - bytesBefore % kAssetAlignment) % kAssetAlignment));
    if (zeros != decltype(zeros){}) refuseFile(m_file, "is damaged: bytes between its arrays are not zero");
  }
  void read(std::span<std::byte> bytes) {
    errno = 0;
    m_stream.read(reinterpret_cast<char*>(bytes.data()), std::streamsize(bytes.size()));
    const int error = errno;
    if (m_stream.eof()) refuseFile(m_file, "is cut off: it became shorter while it was being read");
    if (!m_stream) refuseFile(m_file, "cannot be read" + reasonOf(error));
    m_checksum.add(bytes);
  }

  const std::filesystem::path& m_file;
  std::ifstream& m_stream;
  const Header& m_header;
  FileChecksum m_checksum;
};

// The file's first bytes, as many as the longest header has or the file.
std::vector<std::uint8_t> readStart(const std::filesystem::path& file, std::ifstream& stream,
                                    std::uint64_t size) {
  std::vector<std::uint8_t> bytes(
      std::size_t(std::min<std::uint64_t>(size, kAssetLayouts.back().headerBytes())));
  errno = 0;
  stream.read(reinterpret_cast<char*>(bytes.data()), std::streamsize(bytes.size()));
  if (!stream) refuseFile(file, "cannot be read" + reasonOf(errno));
  return bytes;
}

const AssetLayout& layoutOf(const std::filesystem::path& file, std::uint32_t version) {
  if (version >= 1 && version <= kAssetVersion) return kAssetLayouts[version - 1];
  refuseFile(file, "has asset version " + std::to_string(version) + "; this library reads versions 1 to " +
                       std::to_string(kAssetVersion) + ": cook it again");
}

Header readHeader(const std::filesystem::path& file, std::ifstream& stream, std::uint64_t size) {
  const std::vector<std::uint8_t> bytes = readStart(file, stream, size);
  const std::size_t start = std::min(bytes.size(), kAssetMagic.size());
  if (!std::equal(bytes.begin(), bytes.begin() + std::ptrdiff_t(start), kAssetMagic.begin()))
    refuseFile(file, "is not a rubble asset");
  const auto requireBytes = [&](std::size_t count) {
    if (bytes.size() < count)
      refuseFile(file, "is cut off, or not an asset: it has " + std::to_string(size) +
                           " bytes; an asset's header has " + std::to_string(count));
  };
  requireBytes(kAssetLayouts.front().headerBytes());
  const std::uint8_t* at = bytes.data() + kAssetMagic.size();
  const auto version = decoded<std::uint32_t>(at);
  const auto headerBytes = decoded<std::uint32_t>(at + 4);
  Header header{.layout = layoutOf(file, version)};
  if (headerBytes != header.layout.headerBytes())
    refuseFile(file, "is damaged: its header has " + std::to_string(headerBytes) +
                         " bytes; allowed: " + std::to_string(header.layout.headerBytes()));
  requireBytes(headerBytes);
  header.checksum = decoded<std::uint64_t>(bytes.data() + kAssetChecksumOffset);
  for (std::size_t a = 0; a < header.layout.counts; ++a)
    header.counts[a] = decoded<std::uint64_t>(bytes.data() + header.layout.countsOffset() + 8 * a);
  if (version == kAssetVersionWithRest) header.counts[kRest] = header.counts[kElements];
  return header;
}

void checkCounts(const std::filesystem::path& file, const AssetCounts& counts) {
  if (counts[kElements] != counts[kCells])
    refuseFile(file, "is damaged: " + std::to_string(counts[kCells]) + " cells for " +
                         std::to_string(counts[kElements]) + " elements; allowed: one an element");
  if (counts[kNameBytes] > kMostBytesOfNames)
    refuseFile(file, "is damaged: " + std::to_string(counts[kNameBytes]) +
                         " bytes of names of materials; allowed: up to " + std::to_string(kMostBytesOfNames));
  if (counts[kRest] != 0 && counts[kRest] != counts[kElements])
    refuseFile(file, "is damaged: static states of " + std::to_string(counts[kRest]) + " elements for " +
                         std::to_string(counts[kElements]) + "; allowed: none or one an element");
}

void checkLength(const std::filesystem::path& file, std::uint64_t size, const Header& header) {
  const AssetCounts& counts = header.counts;
  if (size > kMostAssetBytes)
    refuseFile(file,
               "has " + std::to_string(size) + " bytes; allowed: up to " + std::to_string(kMostAssetBytes));
  std::uint64_t left = size - header.layout.headerBytes();
  for (int a = 0; a < kRest; ++a) {
    const std::size_t i = std::size_t(a);
    // A product could overflow.
    if (counts[i] > left || assetArrayBytes(AssetArray(a), counts[i], header.layout.isAligned) > left) {
      std::ostringstream text;
      text << "is cut off or damaged: " << counts[i] << ' ' << kAssetRecords[i].name
           << " do not fit into the file's " << size << " bytes";
      refuseFile(file, text.str());
    }
    left -= assetArrayBytes(AssetArray(a), counts[i], header.layout.isAligned);
  }
  checkCounts(file, counts);
  if (header.hasRest()) {
    // The elements fitted into the file with more bytes each, so nothing overflows.
    const std::uint64_t bytes = kAssetRestKeyBytes + counts[kRest] * kAssetRecords[kRest].bytes;
    if (left < bytes)
      refuseFile(file, "is cut off or damaged: " + std::to_string(left) + " bytes are left for the " +
                           std::to_string(bytes) + " of its static state");
    left -= bytes;
  }
  if (left != 0) refuseFile(file, "is damaged: " + std::to_string(left) + " bytes too many at its end");
}

// Each name ends with a zero.
std::vector<std::string> splitNames(const std::filesystem::path& file, const std::string& names) {
  if (!names.empty() && names.back() != '\0')
    refuseFile(file, "is damaged: the last name of a material has no end");
  std::vector<std::string> list;
  for (std::size_t at = 0; at < names.size(); at = names.find('\0', at) + 1)
    list.push_back(names.substr(at, names.find('\0', at) - at));
  return list;
}

// Ends with a zero; nothing but zeros follow.
std::string readPreset(const std::filesystem::path& file, BodyReader& body) {
  std::array<char, kAssetPresetBytes> bytes{};
  for (char& letter : bytes) body.number(letter);
  const auto end = std::find(bytes.begin(), bytes.end(), '\0');
  if (end == bytes.end() || std::any_of(end, bytes.end(), [](char letter) { return letter != '\0'; }))
    refuseFile(file, "is damaged: the name of its material preset has no end");
  return std::string(bytes.begin(), end);
}

Asset readBody(const std::filesystem::path& file, std::ifstream& stream, const Header& header) {
  Asset asset;
  if (header.hasRest()) asset.rest.emplace();
  std::string names;
  BodyReader body(file, stream, header);
  body.number(asset.radius);
  if (header.layout.hasOrigin)
    for (double& coordinate : asset.origin) body.number(coordinate);
  if (header.layout.hasPreset) asset.preset = readPreset(file, body);
  AssetCounts again = header.counts;
  for (std::uint64_t& count : std::span(again).first(header.layout.counts)) body.number(count);
  visitAssetArrays(asset, names, body);
  if (again != header.counts || stream.peek() != std::ifstream::traits_type::eof())
    refuseFile(file, "is damaged: it changed while it was being read");
  if (body.checksum() != header.checksum) refuseFile(file, "is damaged: its checksum does not match");
  asset.materialNames = splitNames(file, names);
  return asset;
}

Asset loadFile(const std::filesystem::path& file) {
  const std::uint64_t size = inputSize(file, "an asset file");
  errno = 0;
  std::ifstream stream(file, std::ios::binary);
  if (!stream) refuseFile(file, "cannot be read" + reasonOf(errno));
  const Header header = readHeader(file, stream, size);
  checkLength(file, size, header);
  Asset asset = readBody(file, stream, header);
  try {
    asset.validate();
  } catch (const Error& error) {
    refuseFile(file, std::string("holds an impossible ") + error.what());
  }
  return asset;
}

}  // namespace

Asset load(const std::filesystem::path& file) try { return loadFile(file); } catch (const std::bad_alloc&) {
  base::refuseFile(file, "not enough memory to load it");
} catch (const std::length_error&) {  // more than a vector can ever hold, where pointers are short
  base::refuseFile(file, "not enough memory to load it");
}

}  // namespace rubble
