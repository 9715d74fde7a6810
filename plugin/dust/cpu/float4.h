// Four floats in one register: the unit of velocity fields, so that one load fetches all components of a
// cell.
#pragma once

namespace rubble::dust {

struct alignas(16) Float4 {
  using Register = float __attribute__((vector_size(16)));
  Register v = {0, 0, 0, 0};

  Float4() = default;
  Float4(float x, float y, float z, float w = 0) : v{x, y, z, w} {}
  static Float4 all(float s) { return {s, s, s, s}; }
  float operator[](int i) const { return v[i]; }
  void set(int i, float s) { v[i] = s; }

  friend Float4 operator+(Float4 a, Float4 b) { return Float4(a.v + b.v); }
  friend Float4 operator-(Float4 a, Float4 b) { return Float4(a.v - b.v); }
  friend Float4 operator*(Float4 a, Float4 b) { return Float4(a.v * b.v); }
  friend Float4 operator*(Float4 a, float s) { return Float4(a.v * s); }
  // As SSE does: the second if either is not a number, so clamp() returns a bound for NaN.
  friend Float4 min(Float4 a, Float4 b) { return Float4(a.v < b.v ? a.v : b.v); }
  friend Float4 max(Float4 a, Float4 b) { return Float4(a.v > b.v ? a.v : b.v); }
  friend Float4 clamp(Float4 a, Float4 low, Float4 high) { return min(max(a, low), high); }
  friend Float4 mix(Float4 a, Float4 b, float t) { return a + (b - a) * t; }

 private:
  explicit Float4(Register r) : v(r) {}
};

}  // namespace rubble::dust
