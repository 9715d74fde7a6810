#include "demo/size_report.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

#include "base/hash.h"
#include "demo/commit.h"
#include "demo/csv_table.h"
#include "demo/error_plot.h"
#include "demo/machine.h"
#include "demo/marked_text.h"
#include "demo/output_file.h"
#include "demo/progress.h"
#include "demo/settings_hash.h"
#include "demo/size_run.h"

namespace rubble::demo {
namespace {

// Raised by hand when what is measured changes and the scenes do not.
constexpr std::uint64_t kSizeRevision = 1;

// A column of the table.
struct SizeQuantity {
  const char* name;  ///< with its unit
  std::function<double(const SizeRun&)> value;
  bool fitted = true;  ///< the note tells how it goes with h
};

const std::vector<SizeQuantity>& sizeQuantities() {
  static const std::vector<SizeQuantity> list = {
      {"h, mm", [](const SizeRun& r) { return 1e3 * r.spacing; }, false},
      {"crack area, m2", [](const SizeRun& r) { return r.crackArea; }},
      {"f_t^2 h / 2 E, J/m2", [](const SizeRun& r) { return r.asked; }, false},
      {"energy of springs broken in tension, J/m2", [](const SizeRun& r) { return r.tensionEnergy; }},
      {"crushed, kg", [](const SizeRun& r) { return r.crushed; }},
      {"exit speed, m/s", [](const SizeRun& r) { return r.exitSpeed; }},
      {"largest fragment, share", [](const SizeRun& r) { return r.largest; }},
      {"fragments above 10 g", [](const SizeRun& r) { return r.light; }},
      {"fragments above 0.5 kg", [](const SizeRun& r) { return r.heavy; }},
      {"dust, g", [](const SizeRun& r) { return 1e3 * r.dust; }},
      {"ms a simulated second", [](const SizeRun& r) { return r.milliseconds; }}};
  return list;
}

// Runs of one size stand together.
std::vector<std::span<const SizeRun>> sizesOf(std::span<const SizeRun> runs) {
  std::vector<std::span<const SizeRun>> sizes;
  for (std::size_t begin = 0, end = 0; begin < runs.size(); begin = end) {
    while (end < runs.size() && runs[end].wanted == runs[begin].wanted) ++end;
    sizes.push_back(runs.subspan(begin, end - begin));
  }
  return sizes;
}

double sizeMean(std::span<const SizeRun> size, const SizeQuantity& quantity) {
  double sum = 0;
  for (const SizeRun& run : size) sum += quantity.value(run);
  return sum / double(size.size());
}

std::string sizeCell(std::span<const SizeRun> size, const SizeQuantity& quantity) {
  const std::string mean = rounded(sizeMean(size, quantity));
  if (size.size() < 2 || !quantity.fitted) return mean;
  const auto [least, most] = std::ranges::minmax(size, {}, quantity.value);
  return mean + " +- " + rounded(0.5 * (quantity.value(most) - quantity.value(least)));
}

std::string sizeExponents(std::span<const SizeRun> runs) {
  std::string text;
  for (const SizeQuantity& quantity : sizeQuantities()) {
    if (!quantity.fitted) continue;
    std::vector<double> x, y;
    for (const SizeRun& run : runs) {
      x.push_back(run.spacing);
      y.push_back(quantity.value(run));
    }
    const double exponent =
        std::ranges::all_of(y, [](double v) { return v > 0; }) ? exponentOf(x, y) : std::nan("");
    text += (text.empty() ? "" : ", ") +
            std::string(quantity.name).substr(0, std::string(quantity.name).find(',')) + " " +
            (std::isfinite(exponent) ? rounded(exponent) : "-");
  }
  return text;
}

std::string sizeNotes(std::span<const SizeRun> runs) {
  return "The scene wall after 0.3 s, its first object in as many elements whose radius is chosen so that "
         "they "
         "fill the same share of it: mean of the packings of seeds 1, 2, ..., +- half of what they differ "
         "by. "
         "h: cube root of an element's volume. Cracks: faces of springs that broke, without those of crushed "
         "elements. f_t^2 h / 2 E: what a spring of the length h holds that is pulled to f_t, over its face; "
         "one that is bent to f_t holds a third, one that shears as well more.\n\nOver all runs they go with "
         "these powers of h: " +
         sizeExponents(runs) + ".\n\nCommit " + commitName() + ", " + machineName() + ".\n";
}

}  // namespace

std::vector<WallSize> wallSizes(const SizeReportOptions& options) {
  if (options.quick) return {{500, 1}, {1000, 1}};
  std::vector<WallSize> sizes = {{500, 3}, {1000, 3}, {2000, 3}, {4000, 3}, {8000, 3}};
  if (options.longest) sizes.push_back({32000, 1});
  return sizes;
}

double tensionEnergyPerArea(double strength, double modulus, double spacing) {
  return strength * strength * spacing / (2 * modulus);
}

double exponentOf(std::span<const double> x, std::span<const double> y) {
  double n = 0, sumX = 0, sumY = 0, sumXX = 0, sumXY = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double u = std::log(x[i]), v = std::log(y[i]);
    n += 1;
    sumX += u;
    sumY += v;
    sumXX += u * u;
    sumXY += u * v;
  }
  return (n * sumXY - sumX * sumY) / (n * sumXX - sumX * sumX);
}

TextRows sizeTable(std::span<const SizeRun> runs) {
  TextRows table = {{"elements", "packings"}};
  for (const SizeQuantity& quantity : sizeQuantities()) table[0].emplace_back(quantity.name);
  for (const std::span<const SizeRun> size : sizesOf(runs)) {
    table.push_back({std::to_string(size.front().elements), std::to_string(size.size())});
    for (const SizeQuantity& quantity : sizeQuantities()) table.back().push_back(sizeCell(size, quantity));
  }
  return table;
}

TextRows sizeCsv(std::span<const SizeRun> runs) {
  TextRows table = {{"wanted", "elements", "seed"}};
  for (const SizeQuantity& quantity : sizeQuantities()) table[0].emplace_back(quantity.name);
  table[0].insert(table[0].end(), {"commit", "machine"});
  for (const SizeRun& run : runs) {
    table.push_back({std::to_string(run.wanted), std::to_string(run.elements), std::to_string(run.seed)});
    for (const SizeQuantity& quantity : sizeQuantities())
      table.back().push_back(rounded(quantity.value(run)));
    table.back().insert(table.back().end(), {commitName(), machineName()});
  }
  return table;
}

std::string sizeSvg(std::span<const SizeRun> runs) {
  ErrorPlot plot{.title = "What a blow leaves of the scene wall, by the size of its elements",
                 .timeAxis = "h [mm], cube root of an element's volume",
                 .errorAxis = "share",
                 .lines = {{"exit speed / striking speed", {}}, {"crushed / mass of the wall", {}}},
                 .notes = {"Means of the packings of each size.",
                           "On " + machineName() + ", commit " + commitName() + "."}};
  plot.ring.clear();
  for (const std::span<const SizeRun> size : sizesOf(runs)) {
    double h = 0, speed = 0, crushed = 0;
    for (const SizeRun& run : size) {
      h += 1e3 * run.spacing / double(size.size());
      speed += run.exitSpeed / run.strikingSpeed / double(size.size());
      crushed += run.crushed / run.mass / double(size.size());
    }
    if (speed > 0) plot.lines[0].points.push_back({h, speed});
    if (crushed > 0) plot.lines[1].points.push_back({h, crushed});
  }
  std::erase_if(plot.lines, [](const ErrorPlot::Line& line) { return line.points.empty(); });
  return svgOf(plot);
}

std::string sizeReportHash(const SizeReportOptions& options, std::span<const SolverVersion> versions) {
  std::vector<Scene> scenes;
  for (const WallSize& size : wallSizes(options))
    for (int seed = 1; seed <= size.seeds; ++seed)
      scenes.push_back(sizedWall(size.elements, std::uint64_t(seed)));
  base::Fnv1a hash;
  hash.add(kSizeRevision);
  const std::string settings = settingsHash(scenes, versions);
  hash.add(std::as_bytes(std::span(settings)));
  return hashText(hash.value());
}

void sizeReport(const SizeReportOptions& options, std::ostream& out) {
  const std::filesystem::path folder = options.folder.empty() ? "out/report" : options.folder;
  const std::string name = kSizeReportName;
  const std::filesystem::path csv = folder / (name + ".csv"), svg = folder / (name + ".svg");
  std::optional<MarkedText> document;
  if (!options.write.empty())
    document.emplace(options.write, "rubble report " + name + (options.quick ? " --quick" : "") +
                                        (options.longest ? " --long" : ""));
  checkFolder("--out", folder);
  for (const std::filesystem::path& file : {csv, svg}) checkFile("--out", file, folder);
  makeFolder(folder);

  // Twice the elements take 2^(4/3) times as long: as many more, in shorter substeps.
  const auto work = [](std::uint32_t elements) { return std::pow(double(elements), 4.0 / 3); };
  double all = 0, done = 0;
  for (const WallSize& size : wallSizes(options)) all += size.seeds * work(size.elements);
  Progress progress("report");
  std::vector<SizeRun> runs;
  for (const WallSize& size : wallSizes(options)) {
    for (int seed = 1; seed <= size.seeds; ++seed) {
      runs.push_back(runSized(size.elements, std::uint64_t(seed), [&](double share) {
        progress.show((done + share * work(size.elements)) / all,
                      std::to_string(size.elements) + " elements");
      }));
      done += work(size.elements);
    }
  }
  writeWhole(csv, csvTable(sizeCsv(runs)));
  writeWhole(svg, sizeSvg(runs));
  const std::string markdown = markdownTable(sizeTable(runs)) + "\n" + sizeNotes(runs);
  out << markdown << '\n' << csv.string() << '\n' << svg.string() << '\n';
  if (!document) return;
  document->replace(markdown, sizeReportHash(options));
  out << "written: " << options.write.string() << '\n';
}

}  // namespace rubble::demo
