#include "support/folders.h"

namespace rubble::test {

std::string sourceFolder() {
  return RUBBLE_SOURCE_FOLDER;
}

std::string shaderFolder() {
  return sourceFolder() + "/shaders";
}

std::vector<std::filesystem::path> readmes() {
  std::vector<std::filesystem::path> files = {sourceFolder() + "/README.md"};
  for (const char* folder : {"plugin", "demo", "tests"})
    for (const auto& file : std::filesystem::recursive_directory_iterator(sourceFolder() + "/" + folder))
      if (file.path().extension() == ".md") files.push_back(file.path());
  return files;
}

}  // namespace rubble::test
