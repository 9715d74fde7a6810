#include "support/folders.h"

namespace rubble::test {

std::string sourceFolder() {
  return RUBBLE_SOURCE_FOLDER;
}

std::string shaderFolder() {
  return sourceFolder() + "/shaders";
}

}  // namespace rubble::test
