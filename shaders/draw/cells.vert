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
  uint element = bCellVertices[vertex].elements[owner];
  vec3 normal = rotate(bPoses[element].rotation, aNormal.xyz);
  emitSolid(cellPoint(vertex, owner), normal, bCellVertices[vertex].position.xyz, aNormal.w);
}
