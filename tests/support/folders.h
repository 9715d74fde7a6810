// Where the sources of the tests' build are.
#pragma once

#include <string>

namespace rubble::test {

/// The top of the source tree.
std::string sourceFolder();
/// Its shaders.
std::string shaderFolder();

}  // namespace rubble::test
