// Where a value of a scene stands, and who gave it.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace rubble::demo {

/// Which source (a file or an option as `--set`) each dotted path came from; the longest matching prefix
/// counts.
using Origins = std::map<std::string, std::string>;

struct Place {
  const Origins* origins;
  std::string path;

  Place child(const std::string& name) const { return {origins, path.empty() ? name : path + "." + name}; }
  /// Paths of several children.
  std::vector<std::string> children(const std::vector<std::string>& names) const;
  /// Who gave the value.
  std::string source() const;
  /// The same, as errors begin. Where a file gave the value, options are named that gave one of the values
  /// `others` (their paths) or one below them: `FILE with --set KEY`.
  std::string blamed(const std::vector<std::string>& others) const;
  /// Throws InputError. `others` may be at fault as well.
  [[noreturn]] void refuse(const std::string& wrong, const std::string& allowed,
                           const std::vector<std::string>& others = {}) const;
};

}  // namespace rubble::demo
