// Marks the cells whose centre a solid holds and gives them its velocity; of two solids the later one wins.
#include "dust/grid.glsl"
layout(local_size_x = DUST_GROUP_X, local_size_y = DUST_GROUP_Y) in;

layout(std430, binding = DUST_BIND_VELOCITY) writeonly buffer Velocity { vec4 bVelocity[]; };
layout(std430, binding = DUST_BIND_AIR) writeonly buffer Air { float bAir[]; };
layout(std430, binding = DUST_BIND_LIST) readonly buffer Solids { DustSolid bSolids[]; };
layout(location = DUST_UNIFORM_A) uniform int uCount;

bool holds(DustSolid s, vec3 offset) {
  if (s.position.w == 0) return dot(offset, offset) <= s.axisX.w * s.axisX.w;
  return abs(dot(offset, s.axisX.xyz)) <= s.axisX.w && abs(dot(offset, s.axisY.xyz)) <= s.axisY.w &&
         abs(dot(offset, s.axisZ.xyz)) <= s.axisZ.w;
}

void main() {
  ivec3 c = ivec3(gl_GlobalInvocationID);
  vec3 centre = params.origin.xyz + (vec3(c) + 0.5) * params.cell.xyz;
  int found = -1;
  for (int k = uCount - 1; k >= 0 && found < 0; --k) {
    if (holds(bSolids[k], centre - bSolids[k].position.xyz)) found = k;
  }
  bAir[index(c)] = found < 0 ? 1 : 0;
  if (found < 0) return;
  DustSolid s = bSolids[found];
  vec3 v = s.velocity.xyz + cross(s.spin.xyz, centre - s.position.xyz);
  bVelocity[index(c)] = bounded(vec4(v, 0), vec4(-kDustMaxSpeed), vec4(kDustMaxSpeed));
}
