#include "bench/result_table.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "demo/machine.h"
#include "demo/markdown_table.h"

namespace rubble::test {
namespace {

using Kind = BenchColumn::Kind;

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t middle = values.size() / 2;
  return values.size() % 2 == 1 ? values[middle] : (values[middle - 1] + values[middle]) / 2;
}

std::optional<double> counterOf(const benchmark::UserCounters& counters, const std::string& name) {
  const auto found = counters.find(name);
  if (found == counters.end()) return {};
  return found->second.value;
}

std::optional<double> valueOf(const BenchColumn& column, const ResultTable::Run& run) {
  switch (column.kind) {
    case Kind::Time:
      return run.cpu_accumulated_time / double(run.iterations);
    case Kind::ItemTime: {
      const std::optional<double> rate = counterOf(run.counters, "items_per_second");
      return rate && *rate > 0 ? std::optional(1 / *rate) : std::nullopt;
    }
    default:
      return counterOf(run.counters, column.counter);
  }
}

std::string textOf(const BenchColumn& column, const std::vector<double>& values) {
  if (values.empty()) return "-";
  const double value = median(values);
  if (column.kind == Kind::Count) return std::to_string(std::llround(value));
  return column.kind == Kind::Counter ? demo::rounded(value) : timeText(value);
}

demo::TextRows transposed(const demo::TextRows& rows) {
  demo::TextRows result(rows.front().size());
  for (const std::vector<std::string>& row : rows)
    for (std::size_t c = 0; c < row.size(); ++c) result[c].push_back(row[c]);
  return result;
}

}  // namespace

ResultTable::Result& ResultTable::resultOf(const std::string& name) {
  const std::string row = name.substr(m_topic.name.size() + 1);
  for (Result& result : m_results)
    if (result.name == row) return result;
  m_results.push_back({row, std::vector<std::vector<double>>(m_topic.columns.size())});
  return m_results.back();
}

void ResultTable::ReportRuns(const std::vector<Run>& runs) {
  ConsoleReporter::ReportRuns(runs);
  for (const Run& run : runs) {
    if (run.error_occurred) m_error = run.benchmark_name() + ": " + run.error_message;
    if (run.error_occurred || run.run_type != Run::RT_Iteration) continue;
    Result& result = resultOf(run.run_name.function_name);
    for (std::size_t c = 0; c < m_topic.columns.size(); ++c)
      if (const std::optional<double> value = valueOf(m_topic.columns[c], run))
        result.values[c].push_back(*value);
  }
}

std::string ResultTable::markdown() const {
  if (!m_error.empty()) throw std::runtime_error(m_error);
  if (m_results.empty()) throw std::runtime_error(m_topic.name + ": no benchmark ran");
  demo::TextRows rows = {{""}};
  for (const BenchColumn& column : m_topic.columns) rows[0].push_back(column.title);
  std::size_t repetitions = 0;
  for (const Result& result : m_results) {
    rows.push_back({result.name});
    for (std::size_t c = 0; c < m_topic.columns.size(); ++c) {
      rows.back().push_back(textOf(m_topic.columns[c], result.values[c]));
      repetitions = std::max(repetitions, result.values[c].size());
    }
  }
  return demo::markdownTable(m_topic.transposed ? transposed(rows) : rows) + "\nMedians of " +
         std::to_string(repetitions) + "; one core of " + demo::machineName() + ".\n";
}

std::string timeText(double seconds) {
  struct Unit {
    double seconds;
    const char* name;
  };
  constexpr Unit kUnits[] = {{1, " s"}, {1e-3, " ms"}, {1e-6, " us"}};
  for (const Unit& unit : kUnits)
    if (seconds >= unit.seconds) return demo::rounded(seconds / unit.seconds) + unit.name;
  return demo::rounded(seconds / 1e-9) + " ns";
}

}  // namespace rubble::test
