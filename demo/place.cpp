#include "demo/place.h"

#include <algorithm>

#include "demo/input_error.h"

namespace rubble::demo {
namespace {

// Files of scenes end in .json; `report` is what the command itself sweeps.
bool isOption(const std::string& source) {
  return source.starts_with("--") || source == "report";
}

// As it was written: --set and --sweep name their key, --frames needs none.
std::string written(const std::string& source, const std::string& path) {
  return source == "--frames" || source == "--seed" ? source : source + " " + path;
}

// What options gave below a path; not the objects that were made on the way there.
std::vector<std::string> optionsBelow(const Origins& origins, const std::string& above) {
  std::vector<std::string> options;
  for (const auto& [path, source] : origins) {
    if (!path.starts_with(above + ".") || !isOption(source)) continue;
    const auto deeper = origins.lower_bound(path + ".");
    if (deeper == origins.end() || !deeper->first.starts_with(path + "."))
      options.push_back(written(source, path));
  }
  return options;
}

}  // namespace

std::vector<std::string> Place::children(const std::vector<std::string>& names) const {
  std::vector<std::string> paths;
  for (const std::string& name : names) paths.push_back(child(name).path);
  return paths;
}

std::string Place::source() const {
  std::string prefix = path;
  while (true) {
    if (const auto found = origins->find(prefix); found != origins->end()) return found->second;
    if (prefix.empty()) return "scene";
    const auto dot = prefix.rfind('.');
    prefix = dot == std::string::npos ? "" : prefix.substr(0, dot);
  }
}

std::string Place::blamed(const std::vector<std::string>& others) const {
  const std::string giver = source();
  if (isOption(giver)) return giver;
  std::vector<std::string> options;
  for (const std::string& other : others) {
    if (const std::string option = Place{origins, other}.source(); isOption(option)) {
      options.push_back(written(option, other));
    } else {
      const std::vector<std::string> below = optionsBelow(*origins, other);
      options.insert(options.end(), below.begin(), below.end());
    }
  }
  std::string with;
  for (const std::string& option : options) with += (with.empty() ? " with " : ", ") + option;
  return giver + with;
}

void Place::refuse(const std::string& wrong, const std::string& allowed,
                   const std::vector<std::string>& others) const {
  throw InputError(blamed(others), path, wrong + ", " + allowed);
}

}  // namespace rubble::demo
