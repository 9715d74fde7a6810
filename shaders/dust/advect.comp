// Semi-Lagrangian step of the velocity.
#include "dust/grid.glsl"
#include "dust/trace.glsl"
layout(local_size_x = DUST_GROUP_X, local_size_y = DUST_GROUP_Y) in;

layout(std430, binding = DUST_BIND_VELOCITY_2) writeonly buffer Forward { vec4 bForward[]; };

void main() {
  ivec3 c = ivec3(gl_GlobalInvocationID);
  int i = index(c);
  Corner from = locate(vec3(c) - bVelocity[i].xyz * (params.origin.w * params.inverse.xyz));
  vec4 v[8];
  for (int k = 0; k < 8; ++k) v[k] = bVelocity[from.base + offsetOf(k)];
  bForward[i] = blend(v, from.f);
}
