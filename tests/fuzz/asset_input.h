// Bytes that claim to be an asset file, through the public loader.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <span>
#include <sstream>
#include <stdexcept>
#include <string>

#include "base/asset_format.h"
#include "base/hash.h"
#include "rubble/asset.h"
#include "rubble/error.h"

namespace rubble::test {

inline std::string bytesOf(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

/// Loads them from `file`, which is written; false where the loader refuses them. What it takes must come
/// back from a file of its own as it is. Throws anything but rubble::Error that the loader throws, and
/// std::logic_error where an asset does not come back.
inline bool loadsAsAsset(std::span<const std::uint8_t> bytes, const std::filesystem::path& file) {
  const auto write = [&file](const char* data, std::size_t size) {
    std::ofstream(file, std::ios::binary | std::ios::trunc).write(data, std::streamsize(size));
  };
  const auto written = [&file](const Asset& asset) {
    const std::filesystem::path again = file.string() + ".again";
    save(asset, again);
    std::string text = bytesOf(again);
    std::filesystem::remove(again);
    return text;
  };
  write(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  Asset asset;
  try {
    asset = load(file);
  } catch (const Error&) {
    return false;
  }
  const std::string first = written(asset);
  write(first.data(), first.size());
  if (written(load(file)) != first)
    throw std::logic_error("an asset that loads does not come back from a file");
  return true;
}

/// Makes the checksum right, so that what is behind it is looked at: whoever forges a file can do that too.
inline void sealAsset(std::span<std::uint8_t> bytes) {
  if (bytes.size() < base::kAssetBodyOffset) return;
  const bool isOld = bytes[base::kAssetMagic.size()] <= 3;
  base::FileChecksum sum(isOld ? 1 : base::FileChecksum::kLanes);
  sum.add(std::as_bytes(bytes.subspan(base::kAssetBodyOffset)));
  for (std::size_t b = 0; b < 8; ++b)
    bytes[base::kAssetChecksumOffset + b] = std::uint8_t(sum.value() >> (8 * b));
}

}  // namespace rubble::test
