// The Gaudin-Schuhmann distribution of grain sizes in a crushed element, and the share of it that is dust
// (eq. 5 to 7).
#pragma once

#include <cstdint>
#include <span>

#include "rubble/material.h"

namespace rubble::debris {

/// The share of the mass in grains smaller than R is (R / maxRadius)^modulus; what is smaller than dustRadius
/// is dust.
struct SizeLaw {
  double maxRadius;   ///< R_max of eq. (4), radius of the largest grain [m]
  double dustRadius;  ///< R_dust, radius of the largest dust grain [m], > 0
  double modulus;     ///< m, 0 < m <= 1, dimensionless
};

/// What one piece is made of.
struct PieceSize {
  double radius;     ///< R of its grains [m]
  double massShare;  ///< of the element's mass, dimensionless
};

/// Throws rubble::Error unless the three numbers are finite and in range (maxRadius >= 0).
void validate(const SizeLaw& law);

/// P of eq. (6), (R_dust / R_max)^m, clamped to [0, 1]: 1 when R_max <= R_dust.
double dustShare(const SizeLaw& law);

/// C = (R_dust / C_B^2)^m, the coefficient of eq. (7) [J^-2m].
double dustCoefficient(double bondConstant, double dustRadius, double modulus);

/// P of eq. (7), C W^(2m), clamped to [0, 1]. The same as eq. (6) with eq. (4) put in.
double dustShareFromEnergy(double dustCoefficient, double fractureEnergy, double modulus);

/// R of eq. (5) [m] for piece n of N, n = 1 to N: sizes evenly spaced by number, as the paper prints it.
double radiusByNumber(const SizeLaw& law, std::uint32_t n, std::uint32_t count);

/// R [m] below which the share q of the mass outside the dust lies, 0 <= q <= 1: R_max (P + (1 - P) q)^(1/m).
double radiusByMass(const SizeLaw& law, double q);

/// u in [0, 1): the place of an element's sizes in their mass classes. A hash of seed and body begins, and
/// each element stands a golden section from the one before, so that a few crushed neighbours already share
/// the classes evenly: 29 elements of `wall` keep within 0.014 to 0.018 of their laws for 20 seeds, with a
/// hash for each element within 0.012 to 0.024.
double sizeOffset(std::uint64_t seed, std::uint32_t body, std::uint32_t element);

/// Sizes and mass shares of out.size() pieces, from fine to coarse; returns P, the share of the dust. The
/// shares of the pieces add up to 1 - P. With P = 1 (R_max <= R_dust) the element is all dust and `out` is
/// left as it was.
///
/// `Number` (the paper): eq. (5). The paper gives its pieces no mass; here they share the mass as spheres of
/// one density would, in proportion to R^3, so that the one piece of R_max holds nearly all. `Mass`
/// (DEVIATION, default): the mass is cut in N equal classes from fine to coarse and each piece is a parcel of
/// the grains of one class: R at q = (n + u) / N, n = 0 to N - 1. Over many elements, u spread evenly in [0,
/// 1), the sizes by mass follow Gaudin-Schuhmann, which eq. (5) does not with any finite N.
double pieceSizes(const SizeLaw& law, DebrisSizes mode, double u, std::span<PieceSize> out);

}  // namespace rubble::debris
