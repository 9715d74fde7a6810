// Gauss-Seidel on the cells of one colour: their neighbours all have the other one, so order does not matter.
#include "dust/level.glsl"
layout(location = DUST_UNIFORM_B) uniform int uColour;

void main() {
  ivec3 id = ivec3(gl_GlobalInvocationID);
  ivec3 c = ivec3(2 * id.x + ((id.y + id.z + uColour) & 1), id.yz);
  int i = cellOf(c);
  bPressure[i] = (neighbourSum(c) - bRhs[i]) * bInverse[i];
}
