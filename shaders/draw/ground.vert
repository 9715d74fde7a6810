// A square of floor that follows the eye.
#include "shared/draw.h"
layout(location = RUBBLE_GROUND_UNIFORM) uniform vec4 uGround;  // colour, height
layout(location = 0) out vec3 vPosition;

const float kReach = 6.0;  // over the haze: the horizon has faded into the sky well before

void main() {
  vec2 corner = vec2((gl_VertexID & 1) * 2 - 1, (gl_VertexID & 2) - 1) * (kReach / uFrame.tone.w);
  vPosition = vec3(uFrame.eye.x + corner.x, uGround.w, uFrame.eye.z - corner.y);
  gl_Position = uFrame.viewProjection * vec4(vPosition, 1);
}
