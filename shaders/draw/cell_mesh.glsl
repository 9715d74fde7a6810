// The mesh of one body's cells, at rest.
struct CellVertex {
  vec4 position;   // [m]
  uvec4 elements;  // at most four; unused places have no bit in any mask
};
layout(std430, binding = RUBBLE_CELL_VERTICES_BUFFER) readonly buffer CellVertices {
  CellVertex bCellVertices[];
};
layout(std430, binding = RUBBLE_REST_CENTRES_BUFFER) readonly buffer RestCentres { vec4 bRestCentres[]; };
