#include "demo/asset_cache.h"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <map>
#include <random>
#include <span>
#include <sstream>
#include <utility>

#include "base/asset_format.h"
#include "base/hash.h"
#include "demo/input_error.h"
#include "rubble/version.h"

namespace rubble::demo {
namespace {

namespace fs = std::filesystem;

constexpr const char* kAssetEnding = ".rubble-asset";
constexpr const char* kLogEnding = ".log";
constexpr std::string_view kPartialMark = ".partial";
constexpr std::size_t kNameDigits = 32;
constexpr std::size_t kMostLogBytes = 1 << 16;  // a cook tells a few lines
constexpr std::chrono::hours kOldPartial{1};    // left by a program that was ended while it wrote

// Two hashes of other arithmetic side by side.
class NameHash {
 public:
  void add(std::span<const std::byte> bytes) {
    m_bytes.add(bytes);
    m_words.add(bytes);
  }
  template <class T>
  requires std::is_arithmetic_v<T>
  void add(T value) { add(std::as_bytes(std::span(&value, 1))); }
  // The count first: two lists are not one longer.
  template <class T>
  void addList(const std::vector<T>& list) {
    add(std::uint64_t(list.size()));
    add(std::as_bytes(std::span(list)));
  }
  std::string text() const {
    std::ostringstream out;
    out << std::hex;
    for (const std::uint64_t half : {m_bytes.value(), m_words.value()}) {
      out.width(kNameDigits / 2);
      out.fill('0');
      out << half;
    }
    return out.str();
  }

 private:
  base::Fnv1a m_bytes;
  base::FileChecksum m_words{base::FileChecksum::kLanes};
};

void addOptions(NameHash& hash, const CookOptions& options) {
  // All of them: a new one does not compile here.
  const auto& [elements, radius, fill, seed, maxOverlap, maxIterations, minFaceArea, anchor, anchorBand,
               regions] = options;
  hash.add(std::uint64_t(elements));
  for (const double number : {radius, fill, maxOverlap, minFaceArea, anchorBand}) hash.add(number);
  hash.add(seed);
  hash.add(maxIterations);
  hash.add(anchor.has_value());
  if (anchor)
    for (const double x : *anchor) hash.add(x);
  hash.addList(regions);
}

void addMesh(NameHash& hash, const SurfaceMesh& mesh) {
  const auto& [vertices, triangles, normals, uvs, materials, materialNames] = mesh;
  hash.addList(vertices);
  hash.addList(triangles);
  hash.addList(normals);
  hash.addList(uvs);
  hash.addList(materials);
  hash.add(std::uint64_t(materialNames.size()));
  for (const std::string& name : materialNames) {
    hash.add(std::uint64_t(name.size()));
    hash.add(std::as_bytes(std::span(name)));
  }
}

// Of the file, for what is large; a little less than the truth.
std::uintmax_t leastBytes(const Asset& asset) {
  return asset.vertices.size() * sizeof(CellVertex) + asset.corners.size() * sizeof(CellCorner) +
         asset.triangles.size() * sizeof(asset.triangles[0]) + asset.faces.size() * sizeof(CellFace);
}

std::string textOf(const CookLog& told) {
  std::string text;
  for (const CookLogLine& line : told)
    text += (line.level == LogLevel::Warning ? "warning: " : "info: ") + oneLine(line.text) + "\n";
  return text + "end\n";
}

// None where the file is not as textOf wrote it.
std::optional<CookLog> readLog(const fs::path& file) {
  std::error_code error;
  if (!fs::is_regular_file(file, error) || fs::file_size(file, error) > kMostLogBytes) return {};
  CookLog told;
  std::ifstream stream(file, std::ios::binary);
  for (std::string line; std::getline(stream, line);) {
    if (line == "end") return told;
    const bool isWarning = line.starts_with("warning: ");
    if (!isWarning && !line.starts_with("info: ")) return {};
    told.push_back(
        {isWarning ? LogLevel::Warning : LogLevel::Info, oneLine(line.substr(line.find(' ') + 1))});
  }
  return {};
}

// Whole or not at all. Tells whether it was.
bool writeLog(const fs::path& file, const std::string& text) {
  fs::path partial = file;
  partial += std::string(kPartialMark) + std::to_string(std::random_device{}());
  std::ofstream stream(partial, std::ios::binary);
  stream << text;
  stream.close();
  std::error_code error;
  if (stream) fs::rename(partial, file, error);
  if (stream && !error) return true;
  fs::remove(partial, error);
  return false;
}

// Of a file of ours; else empty.
std::string nameIn(const fs::path& file) {
  const std::string text = file.filename().string();
  const std::string name = text.substr(0, text.find('.'));
  const bool isName = name.size() == kNameDigits && std::ranges::all_of(name, [](char c) {
                        return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f');
                      });
  return isName && text.size() > kNameDigits ? name : "";
}

struct Kept {
  fs::file_time_type used = fs::file_time_type::min();
  std::uintmax_t bytes = 0;
  std::vector<fs::path> files;
};

fs::path absoluteFrom(const char* variable) {
  const char* value = std::getenv(variable);
  const fs::path path = value ? value : "";
  return path.is_absolute() ? path : fs::path();  // others are to be left out, says XDG
}

}  // namespace

fs::path usualCacheFolder() {
  if (const fs::path folder = absoluteFrom("XDG_CACHE_HOME"); !folder.empty()) return folder / "rubble";
  if (const fs::path folder = absoluteFrom("HOME"); !folder.empty()) return folder / ".cache" / "rubble";
  return {};
}

std::string cookName(const SurfaceMesh& mesh, const CookOptions& options) {
  NameHash hash;
  hash.add(kCookVersion);
  hash.add(base::kAssetVersion);
  addOptions(hash, options);
  addMesh(hash, mesh);
  return hash.text();
}

AssetCache::AssetCache(CacheOptions options, LogFunction log)
    : m_options(std::move(options)), m_log(std::move(log)) {}

fs::path AssetCache::file(const std::string& name) const {
  return m_options.folder / (name + kAssetEnding);
}

fs::path AssetCache::logFile(const std::string& name) const {
  return m_options.folder / (name + kLogEnding);
}

void AssetCache::tell(LogLevel level, const std::string& line) const {
  if (m_log) m_log(level, line);
}

std::optional<Asset> AssetCache::take(const std::string& name, std::size_t elements) {
  if (m_options.folder.empty()) return {};
  const fs::path kept = file(name);
  std::error_code error;
  if (!fs::exists(kept, error)) return {};
  try {
    std::optional<Asset> asset = load(kept);
    const std::optional<CookLog> told = readLog(logFile(name));
    if (asset->elementCount() != elements || !told) throw Error(kept.string() + ": is not what was kept");
    for (const auto& [level, text] : *told) tell(level, text);
    for (const fs::path& used : {kept, logFile(name)})
      fs::last_write_time(used, fs::file_time_type::clock::now(), error);
    return asset;
  } catch (const Error& damage) {
    tell(LogLevel::Warning, std::string(damage.what()) + "; cooked anew");
    return {};
  }
}

void AssetCache::keep(const std::string& name, const Asset& asset, const CookLog& told) {
  if (m_options.folder.empty() || leastBytes(asset) > m_options.mostBytes) return;
  try {
    std::error_code error;
    fs::create_directories(m_options.folder, error);
    if (!writeLog(logFile(name), textOf(told)))  // first: an asset without it is not taken
      throw Error(m_options.folder.string() + ": cannot be written");
    save(asset, file(name));
    prune();
  } catch (const Error& failure) {
    tell(m_options.isAsked ? LogLevel::Warning : LogLevel::Info,
         std::string(failure.what()) + "; the cooked asset is not kept");
  }
}

void AssetCache::prune() const {
  std::map<std::string, Kept> all;
  std::uintmax_t bytes = 0;
  std::error_code error;
  const auto now = fs::file_time_type::clock::now();
  for (const auto& entry : fs::directory_iterator(m_options.folder, error)) {
    const fs::path& path = entry.path();
    const std::string name = nameIn(path);
    std::error_code gone;
    const auto used = entry.last_write_time(gone);
    const std::uintmax_t size = entry.file_size(gone);
    if (name.empty() || gone) continue;
    if (path.filename().string().find(kPartialMark) != std::string::npos) {
      if (now - used > kOldPartial) fs::remove(path, gone);
      continue;
    }
    Kept& kept = all[name];
    kept.used = std::max(kept.used, used);
    kept.bytes += size;
    kept.files.push_back(path);
    bytes += size;
  }
  std::vector<Kept> oldest;
  for (auto& [name, kept] : all) oldest.push_back(std::move(kept));
  std::ranges::sort(oldest, {}, &Kept::used);
  for (const Kept& kept : oldest) {
    if (bytes <= m_options.mostBytes) return;
    for (const fs::path& path : kept.files) fs::remove(path, error);
    bytes -= kept.bytes;
  }
}

}  // namespace rubble::demo
