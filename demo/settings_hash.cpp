#include "demo/settings_hash.h"

#include "base/hash.h"
#include "demo/marked_text.h"

namespace rubble::demo {

std::string settingsHash(std::span<const Scene> scenes, std::span<const SolverVersion> versions) {
  base::Fnv1a hash;
  const auto add = [&](const std::string& text) { hash.add(std::as_bytes(std::span(text))); };
  for (const Scene& scene : scenes) {
    for (const std::string& line : listScene(scene)) {
      const bool isLook = line.starts_with("camera.") || line.starts_with("light.");
      if (!isLook) add(line + "\n");
    }
  }
  for (const SolverVersion& version : versions) {
    add(version.precision);
    for (const std::uint64_t part : {version.world, version.debris, version.dust}) hash.add(part);
  }
  return hashText(hash.value());
}

}  // namespace rubble::demo
