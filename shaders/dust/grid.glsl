// The cells and faces of the grid, numbered as in Lattice. DUST_N, DUST_GROUP_X and DUST_GROUP_Y are defined
// when the kernel is built; the groups divide the grid, so no kernel has to ask whether its cell exists.
#include "shared/dust.h"

layout(std140, binding = DUST_BIND_PARAMS) uniform Params { DustParams params; };

const int n = DUST_N;

int index(ivec3 c) { return (c.z * n + c.y) * n + c.x; }

// Low face of a cell along `axis`; the coordinate on that axis runs to n inclusive.
int faceOf(int axis, ivec3 c) {
  int nx = axis == 0 ? n + 1 : n, ny = axis == 1 ? n + 1 : n;
  return n * n * (n + 1) * axis + (c.z * ny + c.y) * nx + c.x;
}

ivec3 along(int axis) { return ivec3(axis == 0, axis == 1, axis == 2); }

// Bounds that a value which is not a number falls to, unlike clamp().
vec4 bounded(vec4 a, vec4 low, vec4 high) {
  vec4 b = mix(low, a, greaterThan(a, low));
  return mix(high, b, lessThan(b, high));
}
