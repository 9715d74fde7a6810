// Numbers as messages show them.
#pragma once

#include <array>
#include <charconv>
#include <cmath>
#include <string>

namespace rubble::base {

/// Shortest text that reads back as the same number; whole ones below a milliard without an exponent.
template <class Float>
std::string numberText(Float value) {
  constexpr Float kAllDigits = Float(1e9);
  if (value == std::floor(value) && std::abs(value) < kAllDigits) return std::to_string(long(value));
  std::array<char, 40> text;
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
  return std::string(text.data(), end);
}

}  // namespace rubble::base
