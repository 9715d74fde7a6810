// Debris: the cell of an element scaled about the element's centre at rest (paper 3.2, 4.2). Instances of one
// cell are one indirect command.
#include "shared/draw.h"
#include "draw/rotate.glsl"
#include "draw/cell_mesh.glsl"
#include "draw/solid_out.glsl"

layout(location = RUBBLE_CORNER_ATTRIBUTE) in uint aCorner;
layout(location = RUBBLE_NORMAL_ATTRIBUTE) in vec4 aNormal;
layout(location = RUBBLE_PLACE_ATTRIBUTE) in vec4 aPlace;  // xyz position [m], w scale
layout(location = RUBBLE_ROTATION_ATTRIBUTE) in vec4 aRotation;
layout(location = RUBBLE_ELEMENT_ATTRIBUTE) in uint aElement;

void main() {
  vec3 rest = bCellVertices[aCorner >> 2].position.xyz;
  vec3 arm = (rest - bRestCentres[aElement].xyz) * aPlace.w;
  emitSolid(aPlace.xyz + rotate(aRotation, arm), rotate(aRotation, aNormal.xyz), rest, 1.0);
}
