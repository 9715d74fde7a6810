// rubble_bench [TOPIC [--write FILE.md]] [--benchmark_...]: measures what the layers cost. With a topic, as a
// table; with a file, between the markers of a README:
//
//     <!-- rubble_bench debris -->
//     <!-- end: depends on 0000000000000000 -->
//
// The second marker then holds a hash of what the table depends on (BenchTopic::hash), and a test tells when
// it is out of date. Options that begin with --benchmark_ are Google Benchmark's.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <exception>
#include <filesystem>
#include <iostream>
#include <optional>
#include <string>
#include <vector>

#include "bench/result_table.h"
#include "bench/topic.h"
#include "demo/input_error.h"
#include "demo/marked_text.h"

namespace rubble::test {
namespace {

using demo::InputError;

struct BenchOptions {
  std::string topic;            // empty: all, without a table
  std::filesystem::path write;  // empty: none
};

BenchOptions parse(const std::vector<std::string>& words) {
  BenchOptions options;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (words[i] == "--write" && i + 1 < words.size()) {
      options.write = words[++i];
    } else if (!words[i].starts_with("-") && options.topic.empty()) {
      options.topic = benchTopic(words[i]).name;
    } else {
      throw InputError("rubble_bench", words[i],
                       "is unknown here, allowed: [TOPIC [--write FILE.md]] and options of Google Benchmark");
    }
  }
  if (!options.write.empty() && options.topic.empty())
    throw InputError("rubble_bench", "--write", "has no topic, must be TOPIC --write FILE.md");
  return options;
}

// Printed before Google Benchmark's own help, which ends the program.
void printUsage() {
  std::cout
      << "rubble_bench [TOPIC [--write FILE.md]] [--benchmark_...]\n"
         "Without TOPIC everything is measured; with it, one table; with --write, that table between its "
         "markers in FILE.md.\nTOPIC:";
  for (const BenchTopic& topic : benchTopics()) std::cout << ' ' << topic.name;
  std::cout << "\n\nOptions of Google Benchmark:" << std::endl;
}

void writeTable(const BenchOptions& options) {
  const BenchTopic& topic = benchTopic(options.topic);
  std::optional<demo::MarkedText> document;
  if (!options.write.empty()) document.emplace(options.write, "rubble_bench " + topic.name);
  ResultTable table(topic);
  benchmark::RunSpecifiedBenchmarks(&table, "^" + topic.name + "/");
  const std::string markdown = table.markdown();
  std::cout << markdown;
  if (!document) return;
  document->replace(markdown, demo::hashText(topic.hash()));
  std::cout << "written: " << options.write.string() << '\n';
}

// Google Benchmark takes its options out. A table holds medians of five, unless they say otherwise.
std::vector<std::string> initialize(int argc, char** argv) {
  std::vector<std::string> words(argv, argv + argc);
  if (std::find(words.begin(), words.end(), "--help") != words.end()) printUsage();
  if (std::any_of(words.begin() + 1, words.end(), [](const std::string& w) { return !w.starts_with("-"); }))
    words.insert(words.begin() + 1, "--benchmark_repetitions=5");
  std::vector<char*> raw = {argv[0]};  // is kept
  for (std::size_t i = 1; i < words.size(); ++i) raw.push_back(words[i].data());
  int count = int(raw.size());
  benchmark::Initialize(&count, raw.data());
  return {raw.begin() + 1, raw.begin() + count};
}

int run(int argc, char** argv) {
  try {
    const BenchOptions options = parse(initialize(argc, argv));
    for (const BenchTopic& topic : benchTopics()) topic.add();
    if (options.topic.empty()) {
      benchmark::RunSpecifiedBenchmarks();
    } else {
      writeTable(options);
    }
    return 0;
  } catch (const InputError& error) {
    std::cerr << "rubble_bench: error: " << error.what() << '\n';
    return 2;
  } catch (const std::exception& error) {
    std::cerr << "rubble_bench: error: " << error.what() << '\n';
    return 1;
  }
}

}  // namespace
}  // namespace rubble::test

int main(int argc, char** argv) {
  return rubble::test::run(argc, argv);
}
