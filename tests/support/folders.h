// Where the sources of the tests' build are.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace rubble::test {

/// The top of the source tree.
std::string sourceFolder();
/// Its shaders.
std::string shaderFolder();
/// Every Markdown file of the project.
std::vector<std::filesystem::path> readmes();

}  // namespace rubble::test
