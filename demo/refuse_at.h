// What the library refuses, as the scene's error.
#pragma once

#include <string>
#include <vector>

#include "demo/input_error.h"
#include "demo/scene.h"
#include "demo/words.h"
#include "rubble/error.h"

namespace rubble::demo {

/// Does `work` on one object of the scene; what the library refuses there becomes the scene's error, in which
/// the values `others` may have a part.
template <class Work>
void refuseAt(const Scene& scene, std::size_t object, const Work& work,
              const std::vector<std::string>& others = {}) {
  try {
    work();
  } catch (const Error& error) {
    const std::string name = "objects." + std::to_string(object);
    throw InputError(scene.blamed(name, others), name, inWordsOfTheScene(error.what()));
  }
}

}  // namespace rubble::demo
