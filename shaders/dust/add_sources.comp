// The dust of this frame: one thread a cell that gets any. No two entries share a cell.
#include "dust/grid.glsl"
layout(local_size_x = DUST_LIST_GROUP) in;

layout(std430, binding = DUST_BIND_VELOCITY) writeonly buffer Velocity { vec4 bVelocity[]; };
layout(std430, binding = DUST_BIND_DENSITY) buffer Density { float bDensity[]; };
layout(std430, binding = DUST_BIND_LIST) readonly buffer Sources { DustSourceCell bSources[]; };
layout(location = DUST_UNIFORM_A) uniform int uCount;

void main() {
  int i = int(gl_GlobalInvocationID.x);
  if (i >= uCount) return;
  DustSourceCell s = bSources[i];
  bDensity[s.cell] += s.velocity.w;
  bVelocity[s.cell] = vec4(s.velocity.xyz, 0);
}
