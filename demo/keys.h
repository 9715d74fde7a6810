// Tables of keys: one row for each key of a JSON object says its name, unit, limits, meaning and where the
// value goes. The same rows read a scene, refuse what is wrong in it and write the documentation.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "demo/place.h"
#include "rubble/limits.h"

namespace rubble::demo {

using Json = nlohmann::json;

/// The value as an error message shows it: one line, not too long.
std::string shown(const Json& value);
/// Shortest text that reads back as the same number.
std::string shown(double value);
std::string shown(float value);
std::string shown(const Eigen::Vector3d& value);

double readNumber(const Json& value, const Limits& limits, const Place& place);
std::uint64_t readWhole(const Json& value, const Limits& limits, const Place& place);
bool readFlag(const Json& value, const Place& place);
std::string readWord(const Json& value, const std::vector<std::string>& words, const Place& place);
Eigen::Vector3d readVector(const Json& value, const Limits& limits, const Place& place);
void requireObject(const Json& value, const Place& place);
void requireList(const Json& value, const Place& place);

/// A row of the documentation.
struct KeyLine {
  std::string path, type, unit, standard, meaning;
};

template <class T>
struct Key {
  std::string name, type, unit, meaning;
  std::function<void(T&, const Json&, const Place&)> read;
  std::function<std::string(const T&)> standard;    // the default, as documentation shows it
  std::function<bool(const T&)> applies = nullptr;  // looked at when the rows above it have been read
  std::string appliesTo = {};
  bool isRequired = false;
  bool isChoice = false;  // other rows apply or not by its value
  std::function<void(std::vector<KeyLine>&, const std::string&)> describeNested = nullptr;
  std::function<std::string(const T&)> limit =
      nullptr;                           // what is allowed when the value does not fit the others, or ""
  std::vector<std::string> others = {};  // those, which may be at fault as well
  // Lines of a nested value; null for values that `standard` shows.
  std::function<void(std::vector<std::string>&, const T&, const std::string&)> listNested = nullptr;

  Key required() && {
    isRequired = true;
    return std::move(*this);
  }
  Key only(std::string what, std::function<bool(const T&)> when) && {
    appliesTo = std::move(what);
    applies = std::move(when);
    return std::move(*this);
  }
  Key must(std::function<std::string(const T&)> allowed, std::vector<std::string> fitting = {}) && {
    limit = std::move(allowed);
    others = std::move(fitting);
    return std::move(*this);
  }
};

template <class T>
using Table = std::vector<Key<T>>;

template <class T>
std::string acceptedKeys(const Table<T>& table, const T& target) {
  std::string text;
  for (const Key<T>& key : table)
    if (!key.applies || key.applies(target)) text += (text.empty() ? "" : ", ") + key.name;
  return text;
}

/// Where the keys stand by which the row `name` applies or not; none when it always does or there is none.
template <class T>
std::vector<std::string> choicesAbout(const Table<T>& table, const std::string& name, const Place& place) {
  std::vector<std::string> names;
  bool isConditional = false;
  for (const Key<T>& key : table) {
    if (key.isChoice) names.push_back(key.name);
    isConditional |= key.name == name && bool(key.applies);
  }
  return isConditional ? place.children(names) : std::vector<std::string>();
}

/// Reads one object row by row, in the table's order.
template <class T>
void readObject(const Table<T>& table, T& target, const Json& json, const Place& place) {
  requireObject(json, place);
  std::size_t found = 0;
  for (const Key<T>& key : table) {
    if (key.applies && !key.applies(target)) continue;
    const auto entry = json.find(key.name);
    if (entry != json.end()) {
      key.read(target, *entry, place.child(key.name));
      ++found;
    } else if (key.isRequired) {
      place.child(key.name).refuse("is missing", "must be given (" + key.type + ")",
                                   choicesAbout(table, key.name, place));
    }
    if (const std::string allowed = key.limit ? key.limit(target) : ""; !allowed.empty())
      place.child(key.name).refuse("is " + key.standard(target), allowed, place.children(key.others));
  }
  if (found == json.size()) return;
  for (const auto& [name, value] : json.items()) {
    bool known = false;
    for (const Key<T>& key : table) known |= key.name == name && (!key.applies || key.applies(target));
    if (!known)
      place.child(name).refuse("unknown key", "allowed here: " + acceptedKeys(table, target),
                               choicesAbout(table, name, place));
  }
}

template <class T>
void describe(const Table<T>& table, std::vector<KeyLine>& lines, const std::string& prefix) {
  const T standard{};
  for (const Key<T>& key : table) {
    const std::string meaning = key.meaning + (key.appliesTo.empty() ? "" : " (" + key.appliesTo + " only)");
    lines.push_back({prefix + key.name, key.type, key.unit,
                     key.isRequired ? "required" : key.standard(standard), meaning});
    if (key.describeNested) key.describeNested(lines, prefix + key.name);
  }
}

/// Appends "path = value" for every key that applies, with its default where none was given.
template <class T>
void listValues(const Table<T>& table, std::vector<std::string>& lines, const T& target,
                const std::string& prefix) {
  for (const Key<T>& key : table) {
    if (key.applies && !key.applies(target)) continue;
    if (key.listNested) {
      key.listNested(lines, target, prefix + key.name);
    } else {
      lines.push_back(prefix + key.name + " = " + key.standard(target));
    }
  }
}

}  // namespace rubble::demo
