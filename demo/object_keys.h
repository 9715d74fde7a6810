// Keys of what can break.
#pragma once

#include "demo/keys.h"
#include "demo/scene.h"

namespace rubble::demo {

const Table<SceneObject>& objectKeys();

}  // namespace rubble::demo
