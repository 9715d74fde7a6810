#include "demo/material_report.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <sstream>

#include "base/hash.h"
#include "demo/cases/case_world.h"
#include "demo/cases/cases.h"
#include "demo/commit.h"
#include "demo/csv_table.h"
#include "demo/machine.h"
#include "demo/marked_text.h"
#include "demo/output_file.h"
#include "demo/progress.h"
#include "edem/prestress.h"
#include "edem/testing_machine.h"

namespace rubble::demo {
namespace {

// Raised by hand when a test changes and its words do not.
constexpr std::uint64_t kRevision = 1;

// Of the cube, 4, 6 and 8 across; and of the beam of elements of about that size, half as many across.
struct Size {
  std::size_t cube, beam;
};
constexpr std::array<Size, 3> kSizes = {{{64, 80}, {216, 270}, {512, 640}}};

constexpr double kEdge = 0.3;                         // of the cube [m]
constexpr double kBeamLength = 1, kBeamHeight = 0.1;  // [m]
constexpr double kBeamSag = 1e-4 * kBeamLength;       // at the tip: small strains [m]
constexpr double kOuter = 0.9 * kBeamLength;          // the sag is compared from here to the tip [m]

// Sound crosses the cube a hundred times until it is strained so far.
double slowSpeed(const Material& m, double strain) {
  return 0.01 * strain * std::sqrt(m.youngsModulus / m.density);
}

edem::TestCube cubeOf(const Size& size) {
  return {cookedBox(Eigen::Vector3d::Constant(kEdge), size.cube), kEdge};
}

double pulledModulus(const Material& m, const Size& size) {
  constexpr double kStrain = 1e-3;
  return edem::modulusOf(cubeOf(size), m, slowSpeed(m, kStrain));
}

// From the sag of a cantilever in a gravity that bends it little.
double bentModulus(const Material& m, const Size& size) {
  const double gravity =
      kBeamSag / timoshenkoSag(kBeamLength, kBeamHeight, kBeamLength, m.density, m.youngsModulus, 1);
  edem::BodyDef def;
  def.asset = cookedBox({kBeamLength, kBeamHeight, kBeamHeight}, size.beam, -Eigen::Vector3d::UnitX());
  def.material = m;
  auto body = edem::makeBody<double>(def, 0);
  if (edem::prestress(body, Eigen::Vector3d(0, -gravity, 0)).outcome != edem::PrestressOutcome::Done)
    return std::nan("");
  double asked = 0, sag = 0;
  for (std::uint32_t i = 0; i < body.elementCount(); ++i) {
    const double x = def.asset->positions[i].x() + kBeamLength / 2;
    if (x < kOuter) continue;
    asked += timoshenkoSag(kBeamLength, kBeamHeight, x, m.density, m.youngsModulus, gravity);
    sag -= body.state.displacement[i].y();
  }
  return m.youngsModulus * asked / sag;
}

double tensileStrength(const Material& m, const Size& size) {
  const double strain = m.tensileStrength / m.youngsModulus;
  return edem::strengthOf(cubeOf(size), m, edem::Plates::Glued, slowSpeed(m, strain), 6 * strain);
}

double compressiveStrength(const Material& m, const Size& size, edem::Plates plates) {
  const double strain = m.compressiveStrength / m.youngsModulus;
  return edem::strengthOf(cubeOf(size), m, plates, -slowSpeed(m, strain), 4 * strain);
}

struct MaterialTest {
  std::string name;
  double Material::*asked;
  std::function<double(const Material&, const Size&)> reached;
};

const std::vector<MaterialTest>& tests() {
  static const std::vector<MaterialTest> list = {
      {"E, cube pulled", &Material::youngsModulus, pulledModulus},
      {"E, beam bent", &Material::youngsModulus, bentModulus},
      {"f_t, cube pulled", &Material::tensileStrength, tensileStrength},
      {"f_c, cube crushed between glued plates", &Material::compressiveStrength,
       [](const Material& m, const Size& size) { return compressiveStrength(m, size, edem::Plates::Glued); }},
      {"f_c, cube crushed between greased plates", &Material::compressiveStrength,
       [](const Material& m, const Size& size) {
         return compressiveStrength(m, size, edem::Plates::Greased);
       }}};
  return list;
}

MaterialRow rowOf(const Material& m, const MaterialTest& test, const Size& size) {
  return {m.name, test.name, size.cube, m.*test.asked, test.reached(m, size)};
}

std::vector<Material> presets() {
  std::vector<Material> list;
  for (const std::string& name : materialNames()) list.push_back(material(name));
  return list;
}

std::string megapascals(double pascals) {
  return std::isfinite(pascals) ? rounded(1e-6 * pascals) : "failed";
}

std::string notes() {
  std::ostringstream text;
  text << "Asked and, by elements of the cube, reached [MPa], with the ratio. E: Young's modulus; f_t, f_c: "
          "strength. A cube of 0.3 m between plates that its end cells follow, so slowly that sound "
          "crosses it a hundred times until it breaks; a cantilever of 1 x 0.1 x 0.1 m whose tip sags by 0.1 "
          "mm, "
          "against Timoshenko, of";
  for (const Size& size : kSizes) text << (&size == kSizes.begin() ? " " : ", ") << size.beam;
  text << " elements. Seed " << kCaseSeed << ", commit " << commitName() << ", " << machineName() << ".\n";
  return text.str();
}

}  // namespace

TextRows materialTable(std::span<const MaterialRow> rows) {
  TextRows table = {{"material", "test", "asked"}};
  for (const MaterialRow& row : rows) {
    const std::string heading = std::to_string(row.elements) + " elements";
    if (std::ranges::count(table[0], heading) == 0) table[0].push_back(heading);
    if (table.size() == 1 || table.back()[0] != row.material || table.back()[1] != row.test)
      table.push_back({row.material, row.test, megapascals(row.asked)});
    table.back().push_back(megapascals(row.reached) + " (" + rounded(row.reached / row.asked) + ")");
  }
  return table;
}

TextRows materialCsv(std::span<const MaterialRow> rows) {
  TextRows table = {
      {"material", "test", "elements", "asked_Pa", "reached_Pa", "ratio", "seed", "commit", "machine"}};
  for (const MaterialRow& row : rows)
    table.push_back({row.material, row.test, std::to_string(row.elements), rounded(row.asked),
                     rounded(row.reached), rounded(row.reached / row.asked), std::to_string(kCaseSeed),
                     commitName(), machineName()});
  return table;
}

std::vector<MaterialRow> testMaterial(const Material& material, std::size_t elements) {
  std::vector<MaterialRow> rows;
  for (const Size& size : kSizes)
    for (const MaterialTest& test : tests())
      if (size.cube == elements) rows.push_back(rowOf(material, test, size));
  return rows;
}

std::string materialReportHash(std::span<const Material> materials, std::span<const SolverVersion> versions) {
  base::Fnv1a hash;
  const auto add = [&](const std::string& text) { hash.add(std::as_bytes(std::span(text))); };
  hash.add(kRevision);
  hash.add(kCaseSeed);
  for (const Size& size : kSizes) {
    hash.add(size.cube);
    hash.add(size.beam);
  }
  for (const MaterialTest& test : tests()) add(test.name + "\n");
  for (const Material& m : materials) {
    add(m.name + "\n");
    for (const double constant :
         {m.density, m.youngsModulus, m.tensileStrength, m.compressiveStrength, m.springDamping,
          m.contactStiffness, m.contactDamping, m.friction, m.rollingFriction, m.restitution})
      hash.add(constant);
  }
  for (const SolverVersion& version : versions) hash.add(version.world);
  return hashText(hash.value());
}

std::string materialReportHash() {
  return materialReportHash(presets());
}

void materialReport(const MaterialReportOptions& options, std::ostream& out) {
  const std::filesystem::path folder = options.folder.empty() ? "out/report" : options.folder;
  const std::filesystem::path csv = folder / "materials.csv";
  std::optional<MarkedText> document;
  if (!options.write.empty())
    document.emplace(options.write, std::string("rubble report ") + kMaterialReportName);
  checkFolder("--out", folder);
  checkFile("--out", csv, folder);
  makeFolder(folder);

  Progress progress("report");
  std::vector<MaterialRow> rows;
  const std::vector<Material> materials = presets();
  const double count = double(materials.size() * tests().size() * kSizes.size());
  for (const Material& m : materials) {
    for (const MaterialTest& test : tests()) {
      for (const Size& size : kSizes) {
        progress.show(double(rows.size()) / count,
                      m.name + ", " + test.name + ", " + std::to_string(size.cube) + " elements");
        rows.push_back(rowOf(m, test, size));
      }
    }
  }
  progress.show(1, "all tests");
  const std::string markdown = markdownTable(materialTable(rows)) + "\n" + notes();
  out << markdown;
  writeWhole(csv, csvTable(materialCsv(rows)));
  out << "table: " << csv.string() << '\n';
  if (!document) return;
  document->replace(markdown, materialReportHash());
  out << "written: " << options.write.string() << '\n';
}

}  // namespace rubble::demo
