#include "debris/size_distribution.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "debris/bond.h"
#include "rubble/error.h"
#include "unit/debris/random.h"

namespace rubble::test {
using namespace debris;
namespace {

constexpr SizeLaw kLaw{8.5e-3, 1e-6, 0.7};
constexpr std::uint32_t kPieces = 14;

TEST(NumberSizes, FollowEquationFive) {
  // Values computed from eq. (5) independently, in the specification of this library.
  const double micrometre = 1e-6;
  EXPECT_NEAR(radiusByNumber(kLaw, 1, kPieces), 1.0327 * micrometre, 5e-5 * micrometre);
  EXPECT_NEAR(radiusByNumber(kLaw, 2, kPieces), 1.0693 * micrometre, 5e-5 * micrometre);
  EXPECT_NEAR(radiusByNumber(kLaw, 12, kPieces), 2.3304 * micrometre, 5e-5 * micrometre);
  EXPECT_NEAR(radiusByNumber(kLaw, 13, kPieces), 3.1500 * micrometre, 5e-5 * micrometre);
  EXPECT_DOUBLE_EQ(radiusByNumber(kLaw, 14, kPieces), 8.5e-3);
  EXPECT_NEAR(radiusByNumber(kLaw, 0, kPieces), micrometre, 1e-12 * micrometre);
}

TEST(NumberSizes, AreTheEquationAsPrinted) {
  // eq. (5) written as the paper prints it, without the scaling by R_dust of the library.
  const double a = 3 - kLaw.modulus;
  for (std::uint32_t n = 1; n <= kPieces; ++n) {
    const double printed = std::pow(
        ((kPieces - n) * std::pow(kLaw.dustRadius, -a) + n * std::pow(kLaw.maxRadius, -a)) / kPieces, -1 / a);
    EXPECT_NEAR(radiusByNumber(kLaw, n, kPieces) / printed, 1, 1e-9) << n;
  }
}

TEST(NumberSizes, ShareTheMassAsSpheresOfOneDensity) {
  std::array<PieceSize, kPieces> sizes;
  const double dust = pieceSizes(kLaw, DebrisSizes::Number, 0.3, sizes);
  double sum = dust;
  for (const PieceSize& piece : sizes) {
    sum += piece.massShare;
    const double ratio = std::pow(piece.radius / sizes.back().radius, 3);
    EXPECT_NEAR(piece.massShare / sizes.back().massShare / ratio, 1, 1e-12);
  }
  EXPECT_NEAR(sum, 1, 1e-14);
}

TEST(MassSizes, PiecesShareTheMassEqually) {
  std::array<PieceSize, kPieces> sizes;
  const double dust = pieceSizes(kLaw, DebrisSizes::Mass, 0.3, sizes);
  for (const PieceSize& piece : sizes) EXPECT_NEAR(piece.massShare, (1 - dust) / kPieces, 1e-15);
  EXPECT_NEAR(dust, std::pow(1e-6 / 8.5e-3, 0.7), 1e-15);
}

TEST(MassSizes, EveryGrainLiesBetweenDustAndTheLargest) {
  std::array<PieceSize, kPieces> sizes;
  for (const double u : {0.0, 0.5, std::nextafter(1.0, 0.0)}) {
    pieceSizes(kLaw, DebrisSizes::Mass, u, sizes);
    EXPECT_GE(sizes.front().radius, kLaw.dustRadius * (1 - 1e-12));
    EXPECT_LE(sizes.back().radius, kLaw.maxRadius);
    EXPECT_TRUE(std::is_sorted(sizes.begin(), sizes.end(),
                               [](const PieceSize& a, const PieceSize& b) { return a.radius < b.radius; }));
  }
}

struct Grain {
  double radius, mass;
};

// Crushes `elements` elements of the given R_max and masses; the dust counts as grains of R_dust.
template <typename MaxRadius>
std::vector<Grain> crush(std::uint32_t elements, MaxRadius maxRadiusOf) {
  std::vector<Grain> grains;
  std::array<PieceSize, kPieces> sizes;
  for (std::uint32_t e = 0; e < elements; ++e) {
    const auto [maximum, mass] = maxRadiusOf(e);
    const double dust = pieceSizes({maximum, 1e-6, 0.7}, DebrisSizes::Mass, sizeOffset(1, 0, e), sizes);
    grains.push_back({1e-6, dust * mass});
    for (const PieceSize& piece : sizes) grains.push_back({piece.radius, piece.massShare * mass});
  }
  std::sort(grains.begin(), grains.end(), [](const Grain& a, const Grain& b) { return a.radius < b.radius; });
  return grains;
}

// Largest distance between the share of the mass in grains up to R and `law(R)`, on both sides of every step.
template <typename Law>
double supDistance(const std::vector<Grain>& grains, Law law, std::size_t stride = 1) {
  double total = 0;
  for (const Grain& g : grains) total += g.mass;
  double below = 0, worst = 0;
  for (std::size_t i = 0; i < grains.size(); ++i) {
    const double after = below + grains[i].mass / total;
    const bool dust = grains[i].radius <= 1e-6;  // the law within the dust is not resolved
    if (!dust && i % stride == 0) {
      const double expected = law(grains[i].radius);
      worst = std::max({worst, std::abs(below - expected), std::abs(after - expected)});
    }
    below = after;
  }
  return worst;
}

TEST(MassSizes, GrainsByMassFollowGaudinSchuhmann) {
  const auto grains = crush(10000, [](std::uint32_t) { return std::pair(8.5e-3, 1.0); });
  const double distance = supDistance(grains, [](double r) { return std::pow(r / 8.5e-3, 0.7); });
  EXPECT_LT(distance, 0.01);
}

TEST(MassSizes, ElementsOfManySizesFollowTheSumOfTheirLaws) {
  test::Random random(7);
  std::vector<std::pair<double, double>> elements(2000);
  for (auto& [maximum, mass] : elements) {
    maximum = 1e-3 * std::pow(17.0, random.uniform(0, 1));
    mass = random.uniform(0.02, 0.1);
  }
  const auto grains = crush(2000, [&](std::uint32_t e) { return elements[e]; });
  const auto law = [&](double r) {
    double below = 0, total = 0;
    for (const auto& [maximum, mass] : elements) {
      below += mass * std::pow(std::min(r / maximum, 1.0), 0.7);
      total += mass;
    }
    return below / total;
  };
  EXPECT_LT(supDistance(grains, law, 23), 0.02);
}

TEST(NumberSizes, DoNotFollowGaudinSchuhmann) {
  // The reason for the mass sizes: eq. (5) puts nearly all mass at R_max, where the law has only the share of
  // one class.
  std::array<PieceSize, kPieces> sizes;
  pieceSizes(kLaw, DebrisSizes::Number, 0, sizes);
  EXPECT_GT(sizes.back().massShare, 0.99);
}

TEST(DustShare, IsOneFromBothEquations) {
  const double constant = bondConstant(13.5, 1e-3, 0.7, 0.07);
  for (const double energy : {0.05, 0.3, 2.0}) {
    const double fromRadius = dustShare({maxRadius(constant, energy), 1e-6, 0.7});
    const double fromEnergy = dustShareFromEnergy(dustCoefficient(constant, 1e-6, 0.7), energy, 0.7);
    EXPECT_NEAR(fromEnergy / fromRadius, 1, 1e-12);
    EXPECT_LT(fromRadius, 1);
  }
  EXPECT_EQ(dustShareFromEnergy(dustCoefficient(constant, 1e-6, 0.7), 1e9, 0.7), 1);
}

TEST(DustShare, GrainsBelowDustAreAllDust) {
  std::array<PieceSize, 2> sizes{{{-1, -1}, {-1, -1}}};
  for (const double maximum : {0.0, 1e-7, 1e-6})
    EXPECT_EQ(pieceSizes({maximum, 1e-6, 0.7}, DebrisSizes::Mass, 0.5, sizes), 1);
  EXPECT_EQ(sizes[0].radius, -1) << "no pieces are made";
}

TEST(SizeOffset, SpreadsElementsEvenly) {
  constexpr int kElements = 10000, kBins = 10;
  std::array<int, kBins> count{};
  for (std::uint32_t e = 0; e < kElements; ++e) {
    const double u = sizeOffset(1, 0, e);
    ASSERT_GE(u, 0);
    ASSERT_LT(u, 1);
    ++count[std::size_t(u * kBins)];
  }
  double chiSquare = 0;
  for (const int n : count) chiSquare += std::pow(n - kElements / kBins, 2) / (kElements / kBins);
  EXPECT_LT(chiSquare, 27.9);  // 99.9 % of chi-square with 9 degrees of freedom
}

TEST(SizeOffset, DependsOnSeedBodyAndElement) {
  const double u = sizeOffset(1, 2, 3);
  EXPECT_EQ(u, sizeOffset(1, 2, 3));
  EXPECT_NE(u, sizeOffset(2, 2, 3));
  EXPECT_NE(u, sizeOffset(1, 3, 3));
  EXPECT_NE(u, sizeOffset(1, 2, 4));
  EXPECT_NE(sizeOffset(1, 2, 3), sizeOffset(1, 3, 2));
}

TEST(SizeLaw, RefusesNumbersOutOfRange) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  std::array<PieceSize, 3> sizes;
  for (const SizeLaw& law :
       {SizeLaw{nan, 1e-6, 0.7}, SizeLaw{infinity, 1e-6, 0.7}, SizeLaw{-1, 1e-6, 0.7}, SizeLaw{1e-3, 0, 0.7},
        SizeLaw{1e-3, nan, 0.7}, SizeLaw{1e-3, 1e-6, 0}, SizeLaw{1e-3, 1e-6, 1.5}, SizeLaw{1e-3, 1e-6, nan}})
    EXPECT_THROW(pieceSizes(law, DebrisSizes::Mass, 0.5, sizes), Error);
  EXPECT_THROW(pieceSizes(kLaw, DebrisSizes::Mass, 1.0, sizes), Error);
  EXPECT_THROW(pieceSizes(kLaw, DebrisSizes::Mass, nan, sizes), Error);
  EXPECT_NO_THROW(pieceSizes(kLaw, DebrisSizes::Mass, 0.5, {}));
}

}  // namespace
}  // namespace rubble::test
