// Makers of rows for tables of keys. `member` is a pointer to member of T or of a base of T.
#pragma once

#include <optional>
#include <type_traits>

#include "demo/keys.h"

namespace rubble::demo {

template <class T, class M>
Key<T> number(std::string name, M member, Limits limits, std::string unit, std::string meaning) {
  return {std::move(name),
          "number, " + limits.text(),
          std::move(unit),
          std::move(meaning),
          [=](T& target, const Json& json, const Place& place) {
            using Value = std::decay_t<decltype(target.*member)>;
            target.*member = Value(readNumber(json, limits, place));
          },
          [=](const T& target) { return shown(target.*member); }};
}

template <class T, class M>
Key<T> whole(std::string name, M member, Limits limits, std::string unit, std::string meaning) {
  return {std::move(name),
          "whole number, " + limits.text(),
          std::move(unit),
          std::move(meaning),
          [=](T& target, const Json& json, const Place& place) {
            using Value = std::decay_t<decltype(target.*member)>;
            target.*member = Value(readWhole(json, limits, place));
          },
          [=](const T& target) { return std::to_string(target.*member); }};
}

template <class T>
Key<T> flag(std::string name, bool T::*member, std::string meaning) {
  return {std::move(name),
          "true or false",
          "",
          std::move(meaning),
          [=](T& target, const Json& json, const Place& place) { target.*member = readFlag(json, place); },
          [=](const T& target) { return std::string(target.*member ? "true" : "false"); }};
}

template <class T, class M>
Key<T> vector(std::string name, M member, Limits limits, std::string unit, std::string meaning) {
  return {std::move(name),
          "[x, y, z], each " + limits.text(),
          std::move(unit),
          std::move(meaning),
          [=](T& target, const Json& json, const Place& place) {
            target.*member = readVector(json, limits, place);
          },
          [=](const T& target) { return shown(Eigen::Vector3d(target.*member)); }};
}

/// A direction: any vector but zero; it need not be of unit length.
template <class T, class M>
Key<T> direction(std::string name, M member, std::string meaning) {
  Key<T> key = vector<T>(std::move(name), member, Limits{-1e6, 1e6}, "", std::move(meaning));
  key.type = "[x, y, z], not zero";
  key.read = [read = key.read, member](T& target, const Json& json, const Place& place) {
    read(target, json, place);
    if ((target.*member).norm() < 1e-9) place.refuse("has no direction", "must not be [0, 0, 0]");
  };
  return key;
}

template <class E>
using Words = std::vector<std::pair<std::string, E>>;

template <class T, class E, class M>
Key<T> word(std::string name, M member, Words<E> words, std::string meaning) {
  std::vector<std::string> names;
  std::string type;
  for (const auto& [text, value] : words) {
    names.push_back(text);
    type += (type.empty() ? "" : ", ") + text;
  }
  return {.name = std::move(name),
          .type = std::move(type),
          .unit = "",
          .meaning = std::move(meaning),
          .read =
              [=](T& target, const Json& json, const Place& place) {
                const std::string chosen = readWord(json, names, place);
                for (const auto& [text, value] : words)
                  if (text == chosen) target.*member = value;
              },
          .standard =
              [=](const T& target) {
                for (const auto& [text, value] : words)
                  if (value == target.*member) return text;
                return std::string();
              },
          .isChoice = true};
}

/// An object that is always there; its keys have defaults.
template <class T, class U, class M>
Key<T> object(std::string name, M member, const Table<U>& table, std::string meaning) {
  return {.name = std::move(name),
          .type = "object",
          .unit = "",
          .meaning = std::move(meaning),
          .read = [=, &table](T& target, const Json& json,
                              const Place& place) { readObject(table, target.*member, json, place); },
          .standard = [](const T&) { return std::string("as below"); },
          .describeNested = [&table](std::vector<KeyLine>& lines,
                                     const std::string& path) { describe(table, lines, path + "."); },
          .listNested =
              [=, &table](std::vector<std::string>& lines, const T& target, const std::string& path) {
                listValues(table, lines, U(target.*member), path + ".");
              }};
}

/// An object whose absence means that the part is left out.
template <class T, class U>
Key<T> part(std::string name, std::optional<U> T::*member, const Table<U>& table, std::string meaning) {
  return {
      .name = std::move(name),
      .type = "object",
      .unit = "",
      .meaning = std::move(meaning),
      .read = [=, &table](T& target, const Json& json,
                          const Place& place) { readObject(table, (target.*member).emplace(), json, place); },
      .standard = [](const T&) { return std::string("left out"); },
      .describeNested = [&table](std::vector<KeyLine>& lines,
                                 const std::string& path) { describe(table, lines, path + "."); },
      .listNested =
          [=, &table](std::vector<std::string>& lines, const T& target, const std::string& path) {
            if (target.*member) {
              listValues(table, lines, *(target.*member), path + ".");
            } else {
              lines.push_back(path + " = left out");
            }
          }};
}

template <class T, class U>
Key<T> list(std::string name, std::vector<U> T::*member, const Table<U>& table, std::string meaning) {
  return {.name = std::move(name),
          .type = "list of objects",
          .unit = "",
          .meaning = std::move(meaning),
          .read =
              [=, &table](T& target, const Json& json, const Place& place) {
                requireList(json, place);
                for (std::size_t i = 0; i < json.size(); ++i)
                  readObject(table, (target.*member).emplace_back(), json[i], place.child(std::to_string(i)));
              },
          .standard = [](const T&) { return std::string("[]"); },
          .describeNested = [&table](std::vector<KeyLine>& lines,
                                     const std::string& path) { describe(table, lines, path + ".N."); },
          .listNested =
              [=, &table](std::vector<std::string>& lines, const T& target, const std::string& path) {
                for (std::size_t i = 0; i < (target.*member).size(); ++i)
                  listValues(table, lines, (target.*member)[i], path + "." + std::to_string(i) + ".");
              }};
}

}  // namespace rubble::demo
