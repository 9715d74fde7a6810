// Cooked assets kept from run to run, each under a name that is a hash of all that it was cooked from.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "rubble/cook.h"

namespace rubble::demo {

struct CacheOptions {
  std::filesystem::path folder = {};  ///< empty: nothing is kept
  bool isAsked = false;               ///< by a person, who is warned where it cannot be written
  std::uintmax_t mostBytes = std::uintmax_t{1} << 30;  ///< of all files; those not used for longest go
};

/// $XDG_CACHE_HOME/rubble, else $HOME/.cache/rubble, else none.
std::filesystem::path usualCacheFolder();

/// 32 hexadecimal digits: a hash of the surface with its look, all options, the version of the file and that
/// of the cook (kCookVersion).
std::string cookName(const SurfaceMesh& mesh, const CookOptions& options);

/// What a cook told its log.
struct CookLogLine {
  LogLevel level;
  std::string text;
};
using CookLog = std::vector<CookLogLine>;

/// A folder that may be removed at any time and shared by programs that run at once: files appear whole, and
/// what is read is checked as any asset. Nothing that is wrong with it is an error.
class AssetCache {
 public:
  AssetCache(CacheOptions options, LogFunction log);

  /// The asset of that name; what its cook told is told again. None where there is none of so many elements,
  /// or a damaged one, of which the log is told.
  std::optional<Asset> take(const std::string& name, std::size_t elements);
  /// Keeps it where that is possible and it is not too large, and removes what has become too much.
  void keep(const std::string& name, const Asset& asset, const CookLog& told);

  std::filesystem::path file(const std::string& name) const;

 private:
  std::filesystem::path logFile(const std::string& name) const;
  void tell(LogLevel level, const std::string& line) const;
  void prune() const;

  CacheOptions m_options;
  LogFunction m_log;
};

}  // namespace rubble::demo
