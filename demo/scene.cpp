#include "demo/scene.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "demo/input_error.h"
#include "demo/scene_keys.h"

namespace rubble::demo {
namespace {

constexpr int kDeepestExtends = 8;                  // a chain of `extends` longer than this is a circle
constexpr int kDeepestNesting = 32;                 // [levels]; no scene is deeper
constexpr std::uintmax_t kLargestFile = 16u << 20;  // [bytes]; no scene is larger, a wrong file may be

// The merged scene and where its values came from.
struct Document {
  Json json = Json::object();
  Origins origins;
};

std::string joined(const std::string& path, const std::string& name) {
  return path.empty() ? name : path + "." + name;
}

// "0 to 2, or 3 for a new entry given whole".
std::string indices(std::size_t count, bool canGrow) {
  std::string text;
  if (count > 0) text = count == 1 ? "0" : "0 to " + std::to_string(count - 1);
  if (canGrow) text += (text.empty() ? "" : ", or ") + std::to_string(count) + " for a new entry given whole";
  return text;
}

// The entry of a list. `isNew` may be the one behind the last; three numbers have no fourth.
Json& entryOfList(Json& list, const std::string& index, const Place& place, bool isNew) {
  const std::size_t count = list.size();
  const bool canGrow = count == 0 || !list.front().is_number();
  for (std::size_t i = 0; i < count; ++i)
    if (index == std::to_string(i)) return list[i];
  if (isNew && canGrow && index == std::to_string(count)) return list.emplace_back(nullptr);
  place.child(index).refuse("unknown index", "allowed: " + indices(count, canGrow));
}

// The entry `part` of an object or list, made when it is new; in a list, where `isNew` allows it.
Json& entry(Json& parent, const std::string& part, const Place& place, bool isNew) {
  if (parent.is_object() || parent.is_null()) return parent[part];
  if (!parent.is_array()) place.refuse("is " + shown(parent), "has no keys of its own");
  return entryOfList(parent, part, place, isNew);
}

// Of the value and all that was below it.
void replaceOrigin(Origins& origins, const std::string& path, const std::string& source) {
  std::erase_if(origins, [&](const auto& origin) { return origin.first.starts_with(path + "."); });
  origins[path] = source;
}

// Objects merge, null takes a key away, everything else replaces (RFC 7386).
void merge(Document& document, Json& target, const Json& value, const std::string& path,
           const std::string& source) {
  if (!value.is_object() || !target.is_object()) replaceOrigin(document.origins, path, source);
  if (!value.is_object()) {
    target = value;
    return;
  }
  if (!target.is_object()) target = Json::object();
  for (const auto& [name, child] : value.items()) {
    if (child.is_null()) {
      target.erase(name);
      replaceOrigin(document.origins, joined(path, name), source);
    } else {
      merge(document, target[name], child, joined(path, name), source);
    }
  }
}

bool hasEmptyName(const std::string& path) {
  return path.starts_with('.') || path.ends_with('.') || path.find("..") != std::string::npos;
}

// Merges `value` at a dotted path.
void mergeAt(Document& document, const std::string& path, const Json& value, const std::string& source) {
  if (hasEmptyName(path))
    throw InputError(source, path, "has an empty name in it, must be names joined by single dots");
  Json* target = &document.json;
  Json* parent = nullptr;
  const Origins origins = {{"", source}};  // errors on the way are this source's
  std::string part, last, done;
  std::istringstream parts(path + ".");
  while (std::getline(parts, part, '.')) {
    const bool isLast = joined(done, part) == path;
    parent = target;
    target = &entry(*target, part, {&origins, done}, isLast && !value.is_null());
    done = joined(done, part);
    if (target->is_null()) document.origins[done] = source;  // made on the way
    last = part;
  }
  if (value.is_null() && parent->is_object()) {
    parent->erase(last);
    replaceOrigin(document.origins, path, source);
  } else {
    merge(document, *target, value, path, source);
  }
}

std::string readFile(const std::filesystem::path& file, const std::string& name) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(file, error);
  if (!std::filesystem::is_regular_file(status)) {
    const std::string wrong = std::filesystem::is_directory(status) ? "is a folder"
                              : std::filesystem::exists(status)     ? "is a pipe, a socket or a device"
                                                                    : "there is no such file";
    throw InputError(name, "", wrong + ", must be a scene file or one of: " + sceneNames());
  }
  if (std::filesystem::file_size(file, error) > kLargestFile)
    throw InputError(name, "", "is larger than 16 MB, must be a scene");
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  if (!stream) throw InputError(name, "", "cannot be read, must be a readable file");
  return text.str();
}

// "line 3, column 5" of a byte offset.
std::string lineAndColumn(const std::string& text, std::size_t byte) {
  const std::string before = text.substr(0, byte > 0 ? byte - 1 : 0);
  const auto line = std::count(before.begin(), before.end(), '\n') + 1;
  const auto lineStart = before.rfind('\n');
  const std::size_t column = before.size() - (lineStart == std::string::npos ? 0 : lineStart + 1) + 1;
  return "line " + std::to_string(line) + ", column " + std::to_string(column);
}

// Refuses deep nesting: a hostile file must not use up the stack of what reads it.
bool limitDepth(int depth, Json::parse_event_t, Json&) {
  if (depth > kDeepestNesting) throw std::length_error("nested too deeply");
  return true;
}

// Takes everything, and keeps where the first number stands that no double holds.
class FindNumberOutOfRange : public nlohmann::json_sax<Json> {
 public:
  bool null() override { return true; }
  bool boolean(bool) override { return true; }
  bool number_integer(number_integer_t) override { return true; }
  bool number_unsigned(number_unsigned_t) override { return true; }
  bool number_float(number_float_t, const string_t&) override { return true; }
  bool string(string_t&) override { return true; }
  bool binary(binary_t&) override { return true; }
  bool start_object(std::size_t) override { return true; }
  bool key(string_t&) override { return true; }
  bool end_object() override { return true; }
  bool start_array(std::size_t) override { return true; }
  bool end_array() override { return true; }
  bool parse_error(std::size_t end, const std::string& token, const Json::exception&) override {
    first = end - token.size() + 1;
    number = token;
    return false;
  }

  std::size_t first = 0;  // byte, from 1
  std::string number;
};

[[noreturn]] void refuseNumber(const std::string& text, const std::string& name) {
  constexpr std::size_t kLongest = 60;  // characters that still help to find it
  FindNumberOutOfRange found;
  Json::sax_parse(text, &found);
  std::string number = found.number.substr(0, kLongest);
  if (number.size() < found.number.size()) number += "...";
  throw InputError(name, lineAndColumn(text, found.first), "is " + number + ", must be within +-1.8e308");
}

Json parse(const std::string& text, const std::string& name) {
  try {
    return Json::parse(text, limitDepth);
  } catch (const Json::parse_error& error) {
    throw InputError(name, lineAndColumn(text, error.byte), "is not JSON here, must be an object {...}");
  } catch (const Json::out_of_range&) {
    refuseNumber(text, name);
  } catch (const std::length_error& error) {
    throw InputError(name, "", std::string(error.what()) + ", must be at most 32 levels");
  }
}

// JSON, or a bare word.
Json parseValue(const Override& change) {
  try {
    return Json::parse(change.value, limitDepth);
  } catch (const std::exception&) {
    return change.value;
  }
}

bool isName(const std::string& nameOrPath) {
  return nameOrPath.find('/') == std::string::npos && !nameOrPath.ends_with(".json");
}

std::filesystem::path bundled(const std::string& name) {
  return sceneFolder() / (name + ".json");
}

// The file that `extends` means in `file`: beside it, else one of the bundled.
std::filesystem::path baseOf(const std::filesystem::path& file, const std::string& nameOrPath) {
  const std::filesystem::path folder = file.parent_path();
  if (!isName(nameOrPath)) return folder / nameOrPath;  // an absolute path stays as it is
  const std::filesystem::path neighbour = folder / (nameOrPath + ".json");
  std::error_code error;
  return std::filesystem::exists(neighbour, error) ? neighbour : bundled(nameOrPath);
}

// `wantedBy` says who extends the file, as errors begin when it cannot be read.
void mergeFile(Document& document, const std::filesystem::path& file, const std::string& wantedBy,
               int depth) {
  const std::string name = file.string();
  Json json = parse(readFile(file, wantedBy + name), name);
  if (!json.is_object()) throw InputError(name, "", "is " + shown(json) + ", must be an object {...}");
  if (const auto base = json.find("extends"); base != json.end()) {
    if (!base->is_string())
      throw InputError(name, "extends", "is " + shown(*base) + ", must be the name of a scene");
    if (depth >= kDeepestExtends)
      throw InputError(name, "extends", "goes in a circle, must end at a whole scene");
    mergeFile(document, baseOf(file, base->get<std::string>()), name + ": extends: ", depth + 1);
    json.erase("extends");
  }
  document.origins[""] = name;
  for (const auto& [path, value] : json.items()) mergeAt(document, path, value, name);
}

// The air of the dust grid knows a weight along -y alone.
void checkGravity(const Scene& scene, const Place& place) {
  const Eigen::Vector3d& g = scene.gravity;
  if (scene.dust && (g.x() != 0 || g.z() != 0 || !limits::kDustGravity.hold(-g.y())))
    place.refuse("is [" + shown(g.x()) + ", " + shown(g.y()) + ", " + shown(g.z()) + "]",
                 "must be [0, -g, 0] with g " + limits::kDustGravity.text() + " in a scene with dust",
                 {"dust"});
}

// "impactors.0 to impactors.2".
std::string entriesOf(const std::string& list, std::size_t count) {
  if (count == 0) return "";
  const std::string last = count == 1 ? "" : " to " + joined(list, std::to_string(count - 1));
  return joined(list, "0") + last;
}

// They name a body that the scene has.
void checkAnchorBodies(const Scene& scene, const Place& objects) {
  const std::size_t moving = scene.impactors.size(), still = scene.statics.size();
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    const std::string& body = scene.objects[i].anchorBody;
    if (body.empty() || entryNamed(body, "impactors", moving) || entryNamed(body, "statics", still)) continue;
    std::string allowed = entriesOf("impactors", moving);
    if (still > 0) allowed += (moving > 0 ? ", " : "") + entriesOf("statics", still);
    objects.child(std::to_string(i))
        .child("anchor_body")
        .refuse("is " + body,
                allowed.empty() ? "there are no impactors and no statics to hold to"
                                : "must be one of: " + allowed,
                {"impactors", "statics"});
  }
}

std::filesystem::path dataFolder(const char* folder, const char* builtIn) {
  if (const char* data = std::getenv("RUBBLE_DATA")) return std::filesystem::path(data) / folder;
  return builtIn;
}

}  // namespace

std::filesystem::path sceneFolder() {
  return dataFolder("scenes", RUBBLE_SCENE_FOLDER);
}
std::filesystem::path shaderFolder() {
  return dataFolder("shaders", RUBBLE_SHADER_FOLDER);
}

std::string sceneNames() {
  std::vector<std::string> names;
  std::error_code error;
  for (const auto& file : std::filesystem::directory_iterator(sceneFolder(), error))
    if (file.path().extension() == ".json") names.push_back(file.path().stem().string());
  std::sort(names.begin(), names.end());
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

Override parseOverride(const std::string& text, const std::string& source) {
  const auto equals = text.find('=');
  if (equals == std::string::npos || equals == 0) {
    throw InputError(source, text, "is not a setting, must be key.path=value");
  }
  return {text.substr(0, equals), text.substr(equals + 1), source};
}

Scene loadScene(const std::string& nameOrPath, const std::vector<Override>& overrides) {
  const std::filesystem::path file =
      isName(nameOrPath) ? bundled(nameOrPath) : std::filesystem::path(nameOrPath);
  Document document;
  mergeFile(document, file, "", 0);
  for (const Override& change : overrides) {
    mergeAt(document, change.path, parseValue(change), change.source);
  }
  Scene scene;
  scene.name = file.stem().string();
  scene.file = file.string();
  readObject(sceneKeys(), scene, document.json, {&document.origins, ""});
  checkGravity(scene, {&document.origins, "gravity"});
  checkAnchorBodies(scene, {&document.origins, "objects"});
  scene.origins = std::move(document.origins);
  return scene;
}

std::optional<std::size_t> entryNamed(const std::string& path, const std::string& list, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i)
    if (path == joined(list, std::to_string(i))) return i;
  return std::nullopt;
}

std::string Scene::blamed(const std::string& path, std::vector<std::string> others) const {
  others.insert(others.begin(), path);
  return Place{&origins, path}.blamed(others);
}

}  // namespace rubble::demo
