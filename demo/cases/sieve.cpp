// The sizes that crushed elements are given, sieved: the share of the mass in grains up to each size.
#include <algorithm>
#include <cmath>
#include <vector>

#include "debris/size_distribution.h"
#include "demo/cases/case_timer.h"
#include "demo/cases/cases.h"

namespace rubble::demo {
namespace sieve {
namespace {

constexpr debris::SizeLaw kLaw{8.5e-3, 1e-6, 0.7};
constexpr std::uint32_t kPieces = 14;  // of a cell with as many faces

struct Grain {
  double radius, mass;
};

// Greatest distance between the share of the mass up to a size and the law, on both sides of every step.
// Within the dust nothing is drawn.
double kolmogorovDistance(std::vector<Grain>& grains) {
  std::ranges::sort(grains, {}, &Grain::radius);
  double total = 0, below = 0, most = 0;
  for (const Grain& grain : grains) total += grain.mass;
  for (const Grain& grain : grains) {
    const double after = below + grain.mass / total,
                 expected = sievedShare(kLaw.maxRadius, kLaw.modulus, grain.radius);
    if (grain.radius > kLaw.dustRadius)
      most = std::max({most, std::abs(below - expected), std::abs(after - expected)});
    below = after;
  }
  return most;
}

// `seconds` is what the crushing of so many is counted as.
CaseOutcome run(std::uint32_t elements, DebrisSizes sizes) {
  std::vector<Grain> grains;
  grains.reserve(std::size_t(elements) * (kPieces + 1));
  std::vector<debris::PieceSize> pieces(kPieces);
  CaseTimer timer;
  timer.time(1, [&] {
    for (std::uint32_t e = 0; e < elements; ++e) {
      grains.push_back(
          {kLaw.dustRadius, debris::pieceSizes(kLaw, sizes, debris::sizeOffset(kCaseSeed, 0, e), pieces)});
      for (const debris::PieceSize& piece : pieces) grains.push_back({piece.radius, piece.massShare});
    }
  });
  return timer.outcome(kolmogorovDistance(grains));
}

}  // namespace
}  // namespace sieve

double sievedShare(double maxRadius, double modulus, double radius) {
  return std::pow(std::min(radius / maxRadius, 1.0), modulus);
}

ReportCase sieveCase() {
  using namespace sieve;
  ReportCase c{
      .name = "sieve",
      .what =
          "Elements are crushed to 14 pieces each, sizes up to 8.5 mm of modulus 0.7, dust below 1 "
          "micrometre",
      .closedForm = "Gaudin and Schuhmann's law, the share (R / 8.5 mm)^0.7 of the mass is finer than R",
      .error = "greatest distance of the shares (Kolmogorov)",
      .runs = {},
      .note =
          "Milliseconds are of the drawing alone, as if all were crushed in a second; the paper's sizes, eq. "
          "(5), "
          "put nearly all of the mass into the largest grain"};
  for (const DebrisSizes sizes : {DebrisSizes::Mass, DebrisSizes::Number})
    for (const std::uint32_t elements : {1, 10, 100, 1000, 10000, 100000})
      c.runs.push_back({sizes == DebrisSizes::Mass ? "by mass" : "by number, the paper's",
                        std::to_string(elements) + (elements == 1 ? " element" : " elements"),
                        sizes == DebrisSizes::Mass && elements == 100, elements <= 10000,
                        [=] { return run(elements, sizes); }});
  return c;
}

}  // namespace rubble::demo
