// Every key that a scene may hold.
#pragma once

#include "keys.h"
#include "scene.h"

namespace rubble::demo {

const Table<Scene>& sceneKeys();

}  // namespace rubble::demo
