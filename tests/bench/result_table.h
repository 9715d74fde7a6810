// The results of a topic's benchmarks as a Markdown table.
#pragma once

#include <benchmark/benchmark.h>

#include <string>
#include <vector>

#include "bench/topic.h"

namespace rubble::test {

/// Shows results at the console as usual, and keeps them.
class ResultTable : public benchmark::ConsoleReporter {
 public:
  explicit ResultTable(const BenchTopic& topic) : ConsoleReporter(OO_None), m_topic(topic) {}

  void ReportRuns(const std::vector<Run>& runs) override;

  /// A row a benchmark in the order of running, a column a quantity, medians of the repetitions; below it
  /// what it was measured on. Throws std::runtime_error when a benchmark failed or none ran.
  std::string markdown() const;

 private:
  struct Result {
    std::string name;                         // without the topic's
    std::vector<std::vector<double>> values;  // of a column, one a repetition; none where it counts no such
  };
  Result& resultOf(const std::string& name);

  const BenchTopic& m_topic;
  std::vector<Result> m_results;
  std::string m_error;
};

/// Three significant digits with the unit that suits: "130 ns", "18.2 ms".
std::string timeText(double seconds);

}  // namespace rubble::test
