// Solids that a scene names: their surfaces are made here, and not in rubble::cook, for they are what scenes
// are written with; an application has meshes of its own.
#pragma once

#include "demo/brick_mesh.h"
#include "demo/scene.h"
#include "rubble/cook.h"

namespace rubble::demo {

/// Diameter of a column's shaft [m]: as given, or chosen where it is 0.
double shaftOf(const SceneObject& column);
/// Height of a column's base and of its capital [m]: as given, or chosen where it is 0.
double plinthOf(const SceneObject& column);

BrickCourse brickCourseOf(const SceneObject& object);

/// The closed surface of an object without a mesh or an asset, about its own centre.
SurfaceMesh primitiveMesh(const SceneObject& object);

}  // namespace rubble::demo
