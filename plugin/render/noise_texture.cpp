#include "render/noise_texture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "gl/error.h"
#include "gl/texture.h"

namespace rubble::render {
namespace {

constexpr int kSize = 64;                          // texels along an axis
constexpr std::array<int, 3> kLattice{8, 16, 32};  // knots along an axis, by octave
constexpr std::array<float, 3> kStrength{0.5f, 0.3f, 0.2f};
constexpr float kSlope = 4;  // gradient to colour: fills the range without clipping much
constexpr int kLevels = 7;   // log2(kSize) + 1

// Integer hash (the finaliser of MurmurHash3, over each coordinate in turn) to [0, 1].
float knot(std::uint32_t x, std::uint32_t y, std::uint32_t z, std::uint32_t octave) {
  std::uint32_t h = 0;
  for (const std::uint32_t part : {x, y, z, octave}) {
    h ^= part + 0x9e3779b9u;
    h = (h ^ (h >> 16)) * 0x85ebca6bu;
    h = (h ^ (h >> 13)) * 0xc2b2ae35u;
    h ^= h >> 16;
  }
  return float(h >> 8) / float(0xffffff);
}

float octaveAt(int x, int y, int z, std::uint32_t octave) {
  const int knots = kLattice[octave], cell = kSize / knots;
  float value = 0;
  const std::array<int, 3> at{x, y, z};
  std::array<std::uint32_t, 3> low{}, high{};
  std::array<float, 3> part{};
  for (unsigned a = 0; a < 3; ++a) {
    low[a] = std::uint32_t(at[a] / cell);
    high[a] = std::uint32_t((at[a] / cell + 1) % knots);
    const float t = (float(at[a] % cell) + 0.5f) / float(cell);
    part[a] = t * t * (3 - 2 * t);
  }
  for (unsigned corner = 0; corner < 8; ++corner) {
    float weight = 1;
    std::array<std::uint32_t, 3> k{};
    for (unsigned a = 0; a < 3; ++a) {
      const bool upper = (corner >> a & 1u) != 0;
      k[a] = upper ? high[a] : low[a];
      weight *= upper ? part[a] : 1 - part[a];
    }
    value += weight * knot(k[0], k[1], k[2], octave);
  }
  return value;
}

std::size_t index(int x, int y, int z) {
  const auto wrap = [](int i) { return std::size_t((i + kSize) % kSize); };
  return (wrap(z) * kSize + wrap(y)) * kSize + wrap(x);
}

std::uint8_t toByte(float x) {
  return std::uint8_t(std::lround(std::clamp(x, 0.f, 1.f) * 255));
}

}  // namespace

gl::TextureName makeNoiseTexture() {
  std::vector<float> value(std::size_t{kSize} * kSize * kSize);
  for (int z = 0; z < kSize; ++z) {
    for (int y = 0; y < kSize; ++y) {
      for (int x = 0; x < kSize; ++x) {
        float& v = value[index(x, y, z)];
        for (std::uint32_t o = 0; o < kLattice.size(); ++o) v += kStrength[o] * octaveAt(x, y, z, o);
      }
    }
  }
  std::vector<std::array<std::uint8_t, 4>> texels(value.size());
  for (int z = 0; z < kSize; ++z) {
    for (int y = 0; y < kSize; ++y) {
      for (int x = 0; x < kSize; ++x) {
        const auto slope = [&](std::size_t plus, std::size_t minus) {
          return toByte(0.5f - kSlope * 0.5f * (value[plus] - value[minus]));
        };
        texels[index(x, y, z)] = {
            slope(index(x + 1, y, z), index(x - 1, y, z)), slope(index(x, y + 1, z), index(x, y - 1, z)),
            slope(index(x, y, z + 1), index(x, y, z - 1)), toByte(value[index(x, y, z)])};
      }
    }
  }
  gl::TextureName texture = gl::makeVolume({.format = GL_RGBA8, .size = kSize, .levels = kLevels});
  glTexSubImage3D(GL_TEXTURE_3D, 0, 0, 0, 0, kSize, kSize, kSize, GL_RGBA, GL_UNSIGNED_BYTE, texels.data());
  glGenerateMipmap(GL_TEXTURE_3D);
  gl::checkGl("the noise texture");
  return texture;
}

}  // namespace rubble::render
