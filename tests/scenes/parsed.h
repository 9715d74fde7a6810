// The command line of the program, parsed in the process of the test.
#pragma once

#include <string>
#include <vector>

#include "demo/command_line.h"

namespace rubble::test {

/// Throws demo::InputError for what the program refuses. Without the program's name.
inline demo::CommandLine parsed(std::vector<std::string> words) {
  std::string program = "rubble";
  std::vector<char*> raw = {program.data()};
  for (std::string& word : words) raw.push_back(word.data());
  return demo::parseCommandLine(int(raw.size()), raw.data());
}

}  // namespace rubble::test
