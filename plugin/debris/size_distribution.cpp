#include "debris/size_distribution.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "rubble/error.h"

namespace rubble::debris {

namespace {

// SplitMix64's finalizer [Steele, Lea, Flood 2014]: every input bit reaches every output bit.
std::uint64_t mixed(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15u;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

void sizesByNumber(const SizeLaw& law, double piecesShare, std::span<PieceSize> out) {
  const auto count = std::uint32_t(out.size());
  double sum = 0;
  for (std::uint32_t i = 0; i < count; ++i) {
    const double radius = radiusByNumber(law, i + 1, count);
    const double relative = radius / law.maxRadius;  // relative, or the cubes of small grains could underflow
    out[i] = {radius, relative * relative * relative};
    sum += out[i].massShare;
  }
  for (PieceSize& piece : out) piece.massShare *= piecesShare / sum;
}

void sizesByMass(const SizeLaw& law, double piecesShare, double u, std::span<PieceSize> out) {
  const auto count = double(out.size());
  double n = 0;
  for (PieceSize& piece : out) {
    piece = {radiusByMass(law, (n + u) / count), piecesShare / count};
    n += 1;
  }
}

}  // namespace

void validate(const SizeLaw& law) {
  const auto refuse = [](const char* name, double value, const char* allowed) {
    throw Error(std::string("debris sizes: ") + name + " is " + std::to_string(value) + ", must be " +
                allowed);
  };
  if (!(law.maxRadius >= 0) || !std::isfinite(law.maxRadius))
    refuse("R_max", law.maxRadius, "finite and >= 0");
  if (!(law.dustRadius > 0) || !std::isfinite(law.dustRadius))
    refuse("dustRadius", law.dustRadius, "finite and > 0");
  if (!(law.modulus > 0 && law.modulus <= 1)) refuse("sizeModulus", law.modulus, "> 0 and <= 1");
}

double dustShare(const SizeLaw& law) {
  if (!(law.maxRadius > law.dustRadius)) return 1;
  return std::pow(law.dustRadius / law.maxRadius, law.modulus);
}

double dustCoefficient(double bondConstant, double dustRadius, double modulus) {
  return std::pow(dustRadius / (bondConstant * bondConstant), modulus);
}

double dustShareFromEnergy(double dustCoefficient, double fractureEnergy, double modulus) {
  if (!(fractureEnergy > 0)) return 0;
  return std::min(1.0, dustCoefficient * std::pow(fractureEnergy, 2 * modulus));
}

double radiusByNumber(const SizeLaw& law, std::uint32_t n, std::uint32_t count) {
  // eq. (5) divided through by R_dust^-(3-m), so that no power of a micrometre overflows for a small R_dust.
  const double exponent = -(3 - law.modulus);
  const double coarse = std::pow(law.maxRadius / law.dustRadius, exponent);
  const double mean = (double(count - n) + double(n) * coarse) / count;
  return n == count ? law.maxRadius : law.dustRadius * std::pow(mean, 1 / exponent);
}

double radiusByMass(const SizeLaw& law, double q) {
  const double dust = dustShare(law);
  return law.maxRadius * std::pow(dust + (1 - dust) * q, 1 / law.modulus);
}

double sizeOffset(std::uint64_t seed, std::uint32_t body, std::uint32_t element) {
  // In 64-bit fractions of 1, where the golden section's steps wrap by themselves. The upper 53 bits fill a
  // double's mantissa, so 1 is never reached.
  constexpr std::uint64_t kGoldenSection = 0x9e3779b97f4a7c15;
  const std::uint64_t begin = mixed(mixed(seed) ^ mixed(~std::uint64_t{body}));
  return double((begin + element * kGoldenSection) >> 11) * 0x1p-53;
}

double pieceSizes(const SizeLaw& law, DebrisSizes mode, double u, std::span<PieceSize> out) {
  validate(law);
  if (!(u >= 0 && u < 1)) throw Error("debris sizes: u is " + std::to_string(u) + ", must be in [0, 1)");
  const double dust = dustShare(law);
  if (dust >= 1 || out.empty()) return dust;
  if (mode == DebrisSizes::Number)
    sizesByNumber(law, 1 - dust, out);
  else
    sizesByMass(law, 1 - dust, u, out);
  return dust;
}

}  // namespace rubble::debris
