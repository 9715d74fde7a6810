#include "demo/words.h"

#include <cctype>

namespace rubble::demo {
namespace {

// Fields of Material, DestructionDef and DestructibleBodyDef that messages name. Not every word with a
// capital in it is one: kPa is none.
constexpr const char* kFields[] = {
    "youngsModulus",   "tensileStrength",  "compressiveStrength", "breakingAngle",       "stretchThreshold",
    "springDamping",   "contactStiffness", "contactDamping",      "rollingFriction",     "bondWorkIndex",
    "crushEfficiency", "sizeModulus",      "dustRadius",          "debrisSpeed",         "massDamping",
    "maxEvents",       "substepSafety",    "maxDebris",           "maxSubstepsPerFrame", "anchorBody"};

std::string keyOf(const std::string& field) {
  if (field == "maxDebris") return "debris.budget";
  std::string key;
  for (const char c : field) {
    if (std::isupper(static_cast<unsigned char>(c))) key += '_';
    key += char(std::tolower(static_cast<unsigned char>(c)));
  }
  return key;
}

}  // namespace

std::string inWordsOfTheScene(std::string text) {
  if (text.starts_with("body ")) text.replace(0, 5, "object ");
  for (const std::string field : kFields)
    for (auto at = text.find(field); at != text.npos; at = text.find(field, at)) {
      const std::string key = keyOf(field);
      text.replace(at, field.size(), key);
      at += key.size();
    }
  return text;
}

LogFunction inWordsOfTheScene(const LogFunction& log) {
  if (!log) return log;
  return [log](LogLevel level, const std::string& line) { log(level, inWordsOfTheScene(line)); };
}

}  // namespace rubble::demo
