// Cells of one body, all in one draw.
#include "shared/draw.h"
#include "draw/rotate.glsl"
#include "draw/cell_mesh.glsl"
#include "draw/cell_vertex.glsl"
#include "draw/solid_out.glsl"

layout(location = RUBBLE_CORNER_ATTRIBUTE) in uint aCorner;
layout(location = RUBBLE_NORMAL_ATTRIBUTE) in vec4 aNormal;

void main() {
  uint vertex = aCorner >> 2;
  uint owner = aCorner & 3u;
  vec3 place, normal;
  cellCopy(vertex, owner, aNormal.xyz, place, normal);
  emitSolid(place, normal, bCellVertices[vertex].position.xyz, aNormal.w);
}
