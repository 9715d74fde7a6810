#include "demo/keys.h"

#include <cmath>
#include <sstream>

#include "base/number_text.h"

namespace rubble::demo {
namespace {

std::string kind(const Json& value) {
  return std::string("is ") + shown(value);
}

// A path as objects.0.size makes an object of the key 0 where there is no list.
void refuseIndex(const Json& value, const Place& place) {
  if (!value.is_object() || value.empty()) return;
  const std::string name = value.items().begin().key();
  if (name.empty() || name.find_first_not_of("0123456789") != name.npos) return;
  place.child(name).refuse("unknown index", "there is no list yet: give " + place.path + " whole, [...]");
}

}  // namespace

std::string shown(const Json& value) {
  constexpr std::size_t kLongest = 60;  // characters of a value that still help to find it
  const std::string text = value.dump(-1, ' ', true, Json::error_handler_t::replace);
  return text.size() <= kLongest ? text : text.substr(0, kLongest) + "...";
}

std::string shown(double value) {
  return base::numberText(value);
}
std::string shown(float value) {
  return base::numberText(value);
}
std::string shown(const Eigen::Vector3d& value) {
  std::ostringstream text;
  text << '[' << shown(value.x()) << ", " << shown(value.y()) << ", " << shown(value.z()) << ']';
  return text.str();
}

double readNumber(const Json& value, const Limits& limits, const Place& place) {
  if (!value.is_number()) place.refuse(kind(value), "must be a number " + limits.text());
  const double number = value.get<double>();
  if (!limits.hold(number)) place.refuse(kind(value), "must be " + limits.text());
  return number;
}

std::uint64_t readWhole(const Json& value, const Limits& limits, const Place& place) {
  const std::string allowed = "must be a whole number " + limits.text();
  if (!value.is_number()) place.refuse(kind(value), allowed);
  const double number = value.get<double>();
  if (!limits.hold(number) || std::floor(number) != number) place.refuse(kind(value), allowed);
  return value.is_number_integer() ? value.get<std::uint64_t>() : std::uint64_t(number);
}

bool readFlag(const Json& value, const Place& place) {
  if (!value.is_boolean()) place.refuse(kind(value), "must be true or false");
  return value.get<bool>();
}

std::string readWord(const Json& value, const std::vector<std::string>& words, const Place& place) {
  std::string allowed;
  for (const std::string& word : words) {
    if (value.is_string() && value.get_ref<const std::string&>() == word) return word;
    allowed += (allowed.empty() ? "" : ", ") + word;
  }
  place.refuse(kind(value), "must be one of: " + allowed);
}

Eigen::Vector3d readVector(const Json& value, const Limits& limits, const Place& place) {
  refuseIndex(value, place);
  if (!value.is_array() || value.size() != 3) place.refuse(kind(value), "must be a list of three numbers");
  Eigen::Vector3d vector;
  for (int axis = 0; axis < 3; ++axis) {
    vector[axis] = readNumber(value[std::size_t(axis)], limits, place.child(std::to_string(axis)));
  }
  return vector;
}

void requireObject(const Json& value, const Place& place) {
  if (!value.is_object()) place.refuse(kind(value), "must be an object {...}");
}

void requireList(const Json& value, const Place& place) {
  refuseIndex(value, place);
  if (!value.is_array()) place.refuse(kind(value), "must be a list [...]");
}

}  // namespace rubble::demo
