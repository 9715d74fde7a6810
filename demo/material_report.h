// `rubble report materials`: what each preset reaches in virtual tests of what it asks for, as CSV and
// Markdown. The machine is the mechanics' own (edem/testing_machine.h): no Bullet world is in between.
#pragma once

#include <filesystem>
#include <ostream>
#include <span>
#include <string>
#include <vector>

#include "demo/markdown_table.h"
#include "rubble/material.h"
#include "rubble/version.h"

namespace rubble::demo {

/// The word that asks for it on the command line.
inline constexpr const char* kMaterialReportName = "materials";

struct MaterialReportOptions {
  std::filesystem::path folder;  ///< of the CSV; empty: out/report
  std::filesystem::path write;   ///< a Markdown file that holds this report's markers; empty: none
};

/// A constant of a material, in one test at one size of the elements.
struct MaterialRow {
  std::string material;
  std::string test;
  std::size_t elements;   ///< of the cube; a beam has others of their size
  double asked, reached;  ///< [Pa]
};

/// A row a test and material with all its sizes side by side, which have to stand together.
TextRows materialTable(std::span<const MaterialRow> rows);

/// All rows with a heading; where they were made in the last columns.
TextRows materialCsv(std::span<const MaterialRow> rows);

/// All tests of one material in a cube of so many elements.
std::vector<MaterialRow> testMaterial(const Material& material, std::size_t elements);

/// What the numbers depend on: the presets, the sizes and the version of the solver; as 16 hexadecimal
/// digits.
std::string materialReportHash(std::span<const Material> materials,
                               std::span<const SolverVersion> versions = kSolverVersions);
/// Of the presets as they are.
std::string materialReportHash();

/// Runs all tests of all presets. Throws InputError before the first when a file is wrong, MachineError.
void materialReport(const MaterialReportOptions& options, std::ostream& out);

}  // namespace rubble::demo
