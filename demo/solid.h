// Solids from mesh files, as the command line and scenes take them.
#pragma once

#include <filesystem>
#include <string>

#include "rubble/cook.h"
#include "rubble/limits.h"

namespace rubble::demo {

/// Length units of meshes [m], from nanometres to a thousand kilometres.
inline constexpr Limits kMeshScale = {1e-9, 1e6};

/// Coordinates of meshes [m]: all that the cook takes.
inline constexpr Limits kMeshPlace = {-1e9, 1e9};

/// The surface in the file, `scale` metres a unit. Throws rubble::Error that starts with the file, also when
/// its size is none that a solid may have.
SurfaceMesh readSolid(const std::filesystem::path& file, double scale);

/// What to say of a mesh that was read without a scale and is longer than 100 m, "is 800 m long; if its units
/// are millimetres, ..."; `way` is how a scale is given. Else nothing.
std::string unitAdvice(const SurfaceMesh& mesh, const std::string& way);

/// The mesh as rubble::repair mends it. `log` is told what was done and what was not.
SurfaceMesh repairSolid(const SurfaceMesh& mesh, const LogFunction& log);

/// Where `refusal`, of cook, is of a fault of the mesh that repair mends all of: what to add to it, "; WAY
/// mends that: ..."; else nothing. As long as a repair takes.
std::string repairHint(const SurfaceMesh& mesh, const std::string& refusal, const std::string& way);

/// [m^3]; of an inside-out mesh below 0. An open one has a volume of a kind; cook() refuses both.
double volumeOf(const SurfaceMesh& mesh);

/// How far a vertex of a flat side may be from the furthest one and still be anchored: the rounding of a file
/// of floats [m].
double anchorBandOf(const SurfaceMesh& mesh);

}  // namespace rubble::demo
