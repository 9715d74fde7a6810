// libFuzzer's way into the loader of asset files. An input is tried as it is, and with its checksum made
// right.
#include <unistd.h>

#include <cstdint>
#include <vector>

#include "fuzz/asset_input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  // One a process: workers of one run share the folder. In memory, where the system has such a folder.
  static const std::filesystem::path file =
      (std::filesystem::is_directory("/dev/shm") ? std::filesystem::path("/dev/shm")
                                                 : std::filesystem::temp_directory_path()) /
      ("rubble_asset_fuzz" + std::to_string(getpid()));
  std::vector<std::uint8_t> bytes(data, data + size);
  rubble::test::loadsAsAsset(bytes, file);
  rubble::test::sealAsset(bytes);
  rubble::test::loadsAsAsset(bytes, file);
  return 0;
}
