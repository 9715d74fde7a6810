// `rubble report element_size`: the scene `wall` in fewer and more elements of one material, each in a few
// packings, as CSV, SVG and Markdown. Tells what of a blow depends on the size of the elements.
#pragma once

#include <cstdint>
#include <filesystem>
#include <ostream>
#include <span>
#include <string>
#include <vector>

#include "demo/markdown_table.h"
#include "rubble/version.h"

namespace rubble::demo {

/// The word that asks for it on the command line.
inline constexpr const char* kSizeReportName = "element_size";

struct SizeReportOptions {
  bool quick = false;            ///< the coarsest sizes in one packing each
  bool longest = false;          ///< 32000 elements too: some five minutes more
  std::filesystem::path folder;  ///< of CSV and SVG; empty: out/report
  std::filesystem::path write;   ///< a Markdown file that holds this report's markers; empty: none
};

/// What is asked for: a number of elements in so many packings, of the seeds 1, 2, ...
struct WallSize {
  std::uint32_t elements;
  int seeds;
};
std::vector<WallSize> wallSizes(const SizeReportOptions& options);

/// What one blow left.
struct SizeRun {
  std::uint32_t wanted = 0, elements = 0;
  std::uint64_t seed = 0;
  double spacing = 0;           ///< h, cube root of the volume of an element [m]
  double crackArea = 0;         ///< faces of springs that broke, without those of crushed elements [m^2]
  double tensionEnergy = 0;     ///< in springs that broke in tension, over their faces [J/m^2]
  double asked = 0;             ///< the same by tensionEnergyPerArea
  double crushed = 0;           ///< [kg]
  double dust = 0;              ///< [kg]
  double exitSpeed = 0;         ///< [m/s]
  double strikingSpeed = 0;     ///< of what it is the exit speed of [m/s]
  double mass = 0;              ///< of the wall before [kg]
  double largest = 0;           ///< share of the wall's mass that is in its largest fragment
  double light = 0, heavy = 0;  ///< fragments above kLightFragment and kHeavyFragment
  double milliseconds = 0;      ///< of one core per simulated second
};
/// [kg]; the second is heavier than an element of any size in the report.
inline constexpr double kLightFragment = 0.01, kHeavyFragment = 0.5;

/// Energy in a spring that is pulled to its strength, over its face [J/m^2]: stress^2 / (2 E) in the volume
/// `spacing` x area. [Pa], [Pa], [m].
double tensionEnergyPerArea(double strength, double modulus, double spacing);

/// b of the power law y = a x^b through points of positive coordinates, by least squares of the logarithms.
/// Not finite where no two x differ.
double exponentOf(std::span<const double> x, std::span<const double> y);

/// A row a size with the mean of its packings and, behind it, half of what they differ by.
TextRows sizeTable(std::span<const SizeRun> runs);
/// A row a run; where they were made in the last columns.
TextRows sizeCsv(std::span<const SizeRun> runs);
/// Shares that say how far it converges, over h.
std::string sizeSvg(std::span<const SizeRun> runs);

/// What the numbers depend on: the scenes and the version of the solver; as 16 hexadecimal digits.
std::string sizeReportHash(const SizeReportOptions& options,
                           std::span<const SolverVersion> versions = kSolverVersions);

/// Throws InputError before the first run when a file is wrong, MachineError, RunStopped.
void sizeReport(const SizeReportOptions& options, std::ostream& out);

}  // namespace rubble::demo
