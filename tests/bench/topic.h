// A topic of the benchmarks: one table of a README.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace rubble::test {

/// One quantity of a table.
struct BenchColumn {
  enum class Kind {
    Time,      ///< processor time of an iteration
    ItemTime,  ///< the same over the items that the benchmark says it processes in an iteration
    Counter,   ///< a number that the benchmark counts
    Count,     ///< the same, of whole things
    Seconds,   ///< a counter that holds seconds
  };
  std::string title;
  Kind kind = Kind::Time;
  std::string counter;  ///< name of it, of Kind::Counter, Count and Seconds
};

struct BenchTopic {
  /// Of the command, and the beginning of the names of its benchmarks: NAME/row.
  std::string name;
  std::vector<BenchColumn> columns;
  /// Benchmarks side by side, quantities one below the other.
  bool transposed = false;
  /// Registers the benchmarks with Google Benchmark.
  void (*add)();
  /// Of all that decides what is measured: the inputs, and the bits of a small result of the layer.
  std::uint64_t (*hash)();
};

/// All topics.
const std::vector<BenchTopic>& benchTopics();
/// The topic of that name. Throws demo::InputError, naming those there are.
const BenchTopic& benchTopic(const std::string& name);

BenchTopic assetTopic();
BenchTopic cookTopic();
BenchTopic cookMemoryTopic();
BenchTopic cookSitesTopic();
BenchTopic cookStagesTopic();
BenchTopic debrisTopic();
BenchTopic dustTopic();
BenchTopic pressureTopic();
BenchTopic wholeBodiesTopic();

}  // namespace rubble::test
