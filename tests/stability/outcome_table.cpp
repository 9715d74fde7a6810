#include "stability/outcome_table.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <functional>

namespace rubble::test {
namespace {

// Of one row: stable, degraded, refused, stopped, and those that broke the promise.
class Counts {
 public:
  void add(const Outcome& outcome) {
    ++m_kinds.at(std::size_t(outcome.kind));
    m_violations += outcome.violations.empty() ? 0 : 1;
  }
  std::string cells() const {
    std::string text;
    int sum = 0;
    for (const int n : m_kinds) {
      text += " " + std::to_string(n) + " |";
      sum += n;
    }
    return sum == 0 ? ""
                    : " " + std::to_string(sum) + " |" + text + " " + std::to_string(m_violations) + " |";
  }

 private:
  std::array<int, 4> m_kinds{};
  int m_violations = 0;
};

struct Row {
  std::string name;
  std::function<bool(const Case&)> holds;
};

void addRange(std::vector<Row>& rows, const char* name, double Case::*field, std::vector<double> ends) {
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
    const double low = ends[i], high = ends[i + 1];
    char text[100];
    std::snprintf(text, sizeof text, "%s %.3g to %.3g", name, low, high);
    rows.push_back({text, [=](const Case& c) { return c.*field >= low && c.*field < high; }});
  }
}

template <class Enum>
void addNames(std::vector<Row>& rows, const char* name, Enum Case::*field, int count) {
  for (int i = 0; i < count; ++i)
    rows.push_back(
        {std::string(name) + " " + nameOf(Enum(i)), [=](const Case& c) { return c.*field == Enum(i); }});
}

std::vector<Row> rowsOf() {
  std::vector<Row> rows = {{"all", [](const Case&) { return true; }}};
  addRange(rows, "stiffness", &Case::stiffness, {1e-12, 1e-3, 1, 1e3, 1e7});
  addRange(rows, "radius, m", &Case::radius, {0, 0.01, 0.3, 10, 101});
  rows.push_back({"one element", [](const Case& c) { return c.elements == 1; }});
  rows.push_back({"elements 2 to 99", [](const Case& c) { return c.elements > 1 && c.elements < 100; }});
  rows.push_back({"elements 100 to 3000", [](const Case& c) { return c.elements >= 100; }});
  addNames(rows, "shape", &Case::shape, 5);
  addNames(rows, "strength", &Case::strength, 3);
  addNames(rows, "impactor", &Case::impactor, 8);
  addRange(rows, "mass ratio", &Case::massRatio, {1e-7, 1e-3, 1, 1e3, 1e7});
  addRange(rows, "speed, m/s", &Case::speed, {0, 1, 30, 1001});
  addRange(rows, "spin, rad/s", &Case::spin, {0, 1e-9, 10, 1001});
  addRange(rows, "gravity, m/s^2", &Case::gravity, {0, 1e-9, 100, 1e4 + 1});
  addRange(rows, "frame step, s", &Case::frameStep, {0, 0.004, 0.017, 0.1});
  addRange(rows, "distance, m", &Case::distance, {0, 1e-9, 100, 10001});
  addNames(rows, "happening", &Case::happening, 11);
  rows.push_back({"whole until struck", [](const Case& c) { return c.regime == Regime::RigidUntilStruck; }});
  rows.push_back({"double", [](const Case& c) { return c.precision == Precision::Double; }});
  rows.push_back({"paper", [](const Case& c) { return c.paper; }});
  return rows;
}

}  // namespace

std::string outcomeTable(const std::vector<CaseResult>& results) {
  std::string text =
      "| cases | all | stable | degraded | refused | stopped | promise broken "
      "|\n|---|---|---|---|---|---|---|\n";
  for (const Row& row : rowsOf()) {
    Counts counts;
    for (const CaseResult& r : results)
      if (row.holds(r.definition)) counts.add(r.outcome);
    if (!counts.cells().empty()) text += "| " + row.name + " |" + counts.cells() + "\n";
  }
  return text;
}

}  // namespace rubble::test
