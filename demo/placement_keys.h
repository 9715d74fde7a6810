// Keys of what stands somewhere and moves.
#pragma once

#include <string>
#include <utility>

#include "demo/key_rows.h"
#include "rubble/limits.h"

namespace rubble::demo {

inline constexpr Limits kRotation = {-3600, 3600};  ///< [degrees]: ten turns

/// The table and where its thing stands.
template <class T>
Table<T> withPlacement(Table<T> table, std::string meaning = "where its centre is at the start") {
  table.push_back(vector<T>("position", &T::position, limits::kPosition, "m", std::move(meaning)));
  table.push_back(vector<T>("rotation_degrees", &T::rotationDegrees, kRotation, "degrees",
                            "turned about this axis by its length"));
  return table;
}

/// The table and how its thing moves at the start.
template <class T>
Table<T> withMotion(Table<T> table) {
  table.push_back(vector<T>("velocity", &T::velocity, limits::kSpeed, "m/s", "at the start"));
  table.push_back(vector<T>("spin", &T::spin, limits::kSpin, "rad/s", "axis times rate at the start"));
  return table;
}

}  // namespace rubble::demo
