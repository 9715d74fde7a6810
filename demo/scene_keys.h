// Every key that a scene may hold.
#pragma once

#include "demo/keys.h"
#include "demo/scene.h"

namespace rubble::demo {

const Table<Scene>& sceneKeys();

}  // namespace rubble::demo
