// Writes the asset files that the fuzzer begins with: rubble_asset_corpus FOLDER.
#include <iostream>

#include "fuzz/asset_corpus.h"

int main(int count, char** words) try {
  if (count != 2) throw std::runtime_error("one word is needed: the folder that gets the files");
  const std::filesystem::path folder = words[1];
  const std::filesystem::path scratch = folder / "scratch";
  const auto files = rubble::test::assetCorpus(scratch);
  std::filesystem::remove(scratch);
  for (const auto& [name, bytes] : files) rubble::test::writeBytes(folder / name, bytes);
  return 0;
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 1;
}
