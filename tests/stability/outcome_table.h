// Counts of outcomes by dimension, as a markdown table.
#pragma once

#include <string>
#include <vector>

#include "stability/runner.h"

namespace rubble::test {

struct CaseResult {
  Case definition;
  Outcome outcome;
};

std::string outcomeTable(const std::vector<CaseResult>& results);

}  // namespace rubble::test
