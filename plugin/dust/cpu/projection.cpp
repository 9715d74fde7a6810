#include "dust/cpu/projection.h"

namespace rubble::dust {

namespace {

// Normal velocity of the face between two cells: the solid's if one is solid, else the mean.
float faceVelocity(float low, float high, float airLow, float airHigh) {
  const float mean = 0.5f * (low + high);
  const float solid = airLow < airHigh ? low : high;
  return airLow == airHigh ? mean : solid;
}

void faceRow(const Lattice& lattice, const Fields& fields, int axis, int y, int z, float* face) {
  const int n = lattice.n;
  const int stride = axis == 1 ? n : n * n;
  const int k = axis == 1 ? y : z;  // coordinate along the axis
  const bool lowSide = k == 0, highSide = k == n;
  const int high = lattice.index(0, highSide && axis == 1 ? n - 1 : y, highSide && axis == 2 ? n - 1 : z);
  const int low = lowSide || highSide ? high : high - stride;
  const float open = lowSide && axis == 1 ? 0.0f : 1.0f;  // the floor lets nothing through
  const Float4* u = fields.velocity.data();
  const float* air = fields.air.data();
  for (int x = 0; x < n; ++x) {
    face[x] = open * faceVelocity(u[low + x][axis], u[high + x][axis], air[low + x], air[high + x]);
  }
}

void faceRowX(const Lattice& lattice, const Fields& fields, int y, int z, float* face) {
  const int n = lattice.n;
  const Float4* u = &fields.velocity[lattice.index(0, y, z)];
  const float* air = &fields.air[lattice.index(0, y, z)];
  face[0] = u[0][0];
  for (int x = 1; x < n; ++x) face[x] = faceVelocity(u[x - 1][0], u[x][0], air[x - 1], air[x]);
  face[n] = u[n - 1][0];
}

// Faces of one row of cells along an axis, low and high.
struct FaceRows {
  float* low[3];
  float* high[3];
};

FaceRows faceRows(const Lattice& lattice, Fields& fields, int y, int z) {
  float* f = fields.faces.data();
  return {{f + lattice.face(0, 0, y, z), f + lattice.face(1, 0, y, z), f + lattice.face(2, 0, y, z)},
          {f + lattice.face(0, 1, y, z), f + lattice.face(1, 0, y + 1, z), f + lattice.face(2, 0, y, z + 1)}};
}

// Gradient of the pressure through a face [m/s], 0 where a solid closes it.
float gradient(float low, float high, float airLow, float airHigh, float inverse) {
  return (high - low) * inverse * (airLow * airHigh);
}

// Corrects n faces of one axis. `inverse` is doubled at an open side, where the pressure is 0 half a cell
// away.
void correctFaces(int n, const float* low, const float* high, const float* airLow, const float* airHigh,
                  float inverse, float* face) {
  for (int x = 0; x < n; ++x) face[x] -= gradient(low[x], high[x], airLow[x], airHigh[x], inverse);
}

// Corrects all low faces of a row, and the high faces at the far sides.
void correctRow(const Lattice& lattice, PaddedPressure pressure, const Eigen::Vector3f& inverse, int y, int z,
                Fields& fields) {
  const int n = lattice.n;
  const FaceRows faces = faceRows(lattice, fields, y, z);
  const float* p = pressure.row(y, z);
  const float* air = &fields.air[lattice.index(0, y, z)];
  faces.low[0][0] -= gradient(0, p[0], 1, air[0], 2 * inverse.x());
  correctFaces(n - 1, p, p + 1, air, air + 1, inverse.x(), faces.low[0] + 1);
  faces.low[0][n] -= gradient(p[n - 1], 0, air[n - 1], 1, 2 * inverse.x());
  if (y > 0) correctFaces(n, pressure.row(y - 1, z), p, air - n, air, inverse.y(), faces.low[1]);
  if (y == n - 1) correctFaces(n, p, pressure.row(n, z), air, air, 2 * inverse.y(), faces.high[1]);
  const bool front = z == 0;
  correctFaces(n, pressure.row(y, z - 1), p, front ? air : air - n * n, air, (front ? 2 : 1) * inverse.z(),
               faces.low[2]);
  if (z == n - 1) correctFaces(n, p, pressure.row(y, n), air, air, 2 * inverse.z(), faces.high[2]);
}

// One component of one cell: minus the mean gradient of its two faces; beside a wall the mean of its faces,
// so that the wall holds the air back.
float correctedComponent(float u, float low, float high, float mean, bool wall) {
  return wall ? 0.5f * (low + high) : u - mean;
}

void correctCells(const Lattice& lattice, PaddedPressure pressure, const Eigen::Vector3f& inverse, int y,
                  int z, Fields& fields) {
  const int n = lattice.n;
  const FaceRows f = faceRows(lattice, fields, y, z);
  const float* p[3] = {pressure.row(y, z), pressure.row(y - 1, z), pressure.row(y, z - 1)};
  const float* up = pressure.row(y + 1, z);
  const float* back = pressure.row(y, z + 1);
  const float* air = &fields.air[lattice.index(0, y, z)];
  Float4* u = &fields.velocity[lattice.index(0, y, z)];
  const Eigen::Vector3f half = 0.5f * inverse;
  const int below = y > 0 ? -n : 0, above = y < n - 1 ? n : 0;
  const int front = z > 0 ? -n * n : 0, behind = z < n - 1 ? n * n : 0;
  // At an open side the ghost mirrors the cell with the other sign: the pressure is 0 on the side itself.
  const float top = y == n - 1 ? 1.0f : 0.0f, sideLow = z == 0 ? 1.0f : 0.0f,
              sideHigh = z == n - 1 ? 1.0f : 0.0f;
  for (int x = 0; x < n; ++x) {
    if (air[x] == 0) continue;
    const float c = p[0][x];
    const float left = x > 0 ? p[0][x - 1] : -c, right = x < n - 1 ? p[0][x + 1] : -c;
    const bool wallX = (x > 0 && air[x - 1] == 0) || (x < n - 1 && air[x + 1] == 0);
    const bool wallY = y == 0 || air[x + below] == 0 || air[x + above] == 0;
    const bool wallZ = air[x + front] == 0 || air[x + behind] == 0;
    const float dx = (right - left) * half.x();
    const float dy = (up[x] - top * c - p[1][x]) * half.y();
    const float dz = (back[x] - sideHigh * c - (p[2][x] - sideLow * c)) * half.z();
    u[x] = Float4(correctedComponent(u[x][0], f.low[0][x], f.high[0][x], dx, wallX),
                  correctedComponent(u[x][1], f.low[1][x], f.high[1][x], dy, wallY),
                  correctedComponent(u[x][2], f.low[2][x], f.high[2][x], dz, wallZ));
  }
}

}  // namespace

void computeFaces(const Lattice& lattice, Fields& fields, base::ThreadPool& pool) {
  const int n = lattice.n;
  pool.run(n, 3 * n * n, [&](int begin, int end) {
    for (int z = begin; z < end; ++z) {
      for (int y = 0; y < n; ++y) {
        const FaceRows f = faceRows(lattice, fields, y, z);
        faceRowX(lattice, fields, y, z, f.low[0]);
        faceRow(lattice, fields, 1, y, z, f.low[1]);
        faceRow(lattice, fields, 2, y, z, f.low[2]);
        if (y == n - 1) faceRow(lattice, fields, 1, n, z, f.high[1]);
        if (z == n - 1) faceRow(lattice, fields, 2, y, n, f.high[2]);
      }
    }
  });
}

void computeDivergence(const Lattice& lattice, Fields& fields, base::ThreadPool& pool) {
  const int n = lattice.n;
  const Eigen::Vector3f inverse = lattice.cell.cwiseInverse();
  pool.run(n, n * n, [&](int begin, int end) {
    for (int z = begin; z < end; ++z) {
      for (int y = 0; y < n; ++y) {
        const FaceRows f = faceRows(lattice, fields, y, z);
        const float* air = &fields.air[lattice.index(0, y, z)];
        float* out = &fields.divergence[lattice.index(0, y, z)];
        for (int x = 0; x < n; ++x) {
          out[x] = air[x] *
                   ((f.high[0][x] - f.low[0][x]) * inverse.x() + (f.high[1][x] - f.low[1][x]) * inverse.y() +
                    (f.high[2][x] - f.low[2][x]) * inverse.z());
        }
      }
    }
  });
}

void subtractGradient(const Lattice& lattice, PaddedPressure pressure, Fields& fields,
                      base::ThreadPool& pool) {
  const int n = lattice.n;
  const Eigen::Vector3f inverse = lattice.cell.cwiseInverse();
  pool.run(n, 2 * n * n, [&](int begin, int end) {
    for (int z = begin; z < end; ++z) {
      for (int y = 0; y < n; ++y) correctRow(lattice, pressure, inverse, y, z, fields);
    }
  });
  pool.run(n, 2 * n * n, [&](int begin, int end) {
    for (int z = begin; z < end; ++z) {
      for (int y = 0; y < n; ++y) correctCells(lattice, pressure, inverse, y, z, fields);
    }
  });
}

}  // namespace rubble::dust
