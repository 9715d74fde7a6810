// One blow of `rubble report element_size`.
#pragma once

#include <functional>

#include "demo/scene.h"
#include "demo/size_report.h"

namespace rubble::demo {

/// The scene `wall` as it is compared.
Scene sizedWall(std::uint32_t elements, std::uint64_t seed);

/// Runs it to its end; `shown` gets the share done, 0 to 1. Throws RunStopped.
SizeRun runSized(std::uint32_t elements, std::uint64_t seed, const std::function<void(double)>& shown = {});

}  // namespace rubble::demo
