#include "shared/draw.h"
#include "draw/view_ray.glsl"
#include "draw/sky.glsl"

layout(location = 0) in vec2 vUv;
layout(location = 0) out vec4 oColour;

void main() { oColour = vec4(skyColour(normalize(worldAt(vUv, 1.0) - uFrame.eye.xyz)), 1); }
