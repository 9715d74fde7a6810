// A rigid prop.
#include "shared/draw.h"
#include "draw/solid_out.glsl"

layout(location = RUBBLE_POSITION_ATTRIBUTE) in vec3 aPosition;
layout(location = RUBBLE_NORMAL_ATTRIBUTE) in vec4 aNormal;
layout(location = RUBBLE_MODEL_UNIFORM) uniform mat4 uModel;

void main() {
  emitSolid((uModel * vec4(aPosition, 1)).xyz, mat3(uModel) * aNormal.xyz, aPosition, 0.0);
}
