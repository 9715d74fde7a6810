// Dust density [kg/m^3] of either back end -> extinction [1/m] in a texture, and the box of cells that hold
// any.
#include "shared/draw.h"
layout(local_size_x = RUBBLE_COPY_GROUP_X, local_size_y = RUBBLE_COPY_GROUP_Y) in;

layout(std430, binding = RUBBLE_DENSITY_BUFFER) readonly buffer Density { float bDensity[]; };
layout(std430, binding = RUBBLE_DUST_BOUNDS_BUFFER) buffer Bounds { uint bLow[4], bHigh[4]; };
layout(binding = RUBBLE_EXTINCTION_IMAGE, r32f) writeonly uniform image3D uExtinction;
layout(location = RUBBLE_GRID_UNIFORM) uniform ivec4 uGrid;
layout(location = RUBBLE_EXTINCTION_UNIFORM) uniform float uMassExtinction;  // [m^2/kg]

shared uint sLow[3];
shared uint sHigh[3];

const float kThinnest = 1e-4;  // [1/m]: ten metres of it hide a thousandth

void main() {
  if (gl_LocalInvocationIndex < 3u) {
    sLow[gl_LocalInvocationIndex] = 0xffffffffu;
    sHigh[gl_LocalInvocationIndex] = 0u;
  }
  barrier();
  uvec3 cell = gl_GlobalInvocationID;
  uint n = uint(uGrid.x);
  bool holdsDust = false;
  if (all(lessThan(cell, uvec3(n)))) {
    float extinction = max(bDensity[(cell.z * n + cell.y) * n + cell.x] * uMassExtinction, 0.0);
    holdsDust = extinction > kThinnest;
    imageStore(uExtinction, ivec3(cell), vec4(extinction));
  }
  if (holdsDust) {
    for (int axis = 0; axis < 3; ++axis) {
      atomicMin(sLow[axis], cell[axis]);
      atomicMax(sHigh[axis], cell[axis]);
    }
  }
  barrier();
  uint axis = gl_LocalInvocationIndex;
  if (axis < 3u && sLow[axis] <= sHigh[axis]) {
    atomicMin(bLow[axis], sLow[axis]);
    atomicMax(bHigh[axis], sHigh[axis]);
  }
}
