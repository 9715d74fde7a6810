#include "demo/console.h"

#include <iostream>

#include "demo/progress.h"

namespace rubble::demo {

LogFunction consoleLog() {
  return [](LogLevel level, const std::string& line) {
    if (level == LogLevel::Warning) std::cerr << "rubble: warning: " << line << '\n';
  };
}

Assets cookWithProgress(const Scene& scene, const CacheOptions& cache, const LogFunction& log) {
  Progress progress(scene.name);
  return cookObjects(
      scene, [&](double share, const char* what) { progress.show(share, what); }, log, cache);
}

}  // namespace rubble::demo
