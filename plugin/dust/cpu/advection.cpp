#include "dust/cpu/advection.h"

namespace rubble::dust {

namespace {

// The eight cells around a point given in cells (a whole number is a cell's centre), and the place between
// them.
struct Corner {
  int base;
  float fx, fy, fz;
};

// A point outside takes the nearest point inside: the air beyond a side is like the air at it.
Corner locate(Float4 point, int n, Float4 last) {
  const Float4 p = clamp(point, Float4(), last);
  const int most = n - 2;
  const int x = int(p[0]), y = int(p[1]), z = int(p[2]);
  const int i = x < most ? x : most, j = y < most ? y : most, k = z < most ? z : most;
  return {(k * n + j) * n + i, p[0] - float(i), p[1] - float(j), p[2] - float(k)};
}

Float4 sample(const Float4* field, const Corner& c, int n) {
  const Float4* f = field + c.base;
  const Float4* g = f + n * n;
  const Float4 low = mix(mix(f[0], f[1], c.fx), mix(f[n], f[n + 1], c.fx), c.fy);
  const Float4 high = mix(mix(g[0], g[1], c.fx), mix(g[n], g[n + 1], c.fx), c.fy);
  return mix(low, high, c.fz);
}

Float4 clampToCorner(Float4 value, const Float4* field, const Corner& c, int n) {
  const Float4* f = field + c.base;
  const Float4* g = f + n * n;
  const Float4 low =
      min(min(min(f[0], f[1]), min(f[n], f[n + 1])), min(min(g[0], g[1]), min(g[n], g[n + 1])));
  const Float4 high =
      max(max(max(f[0], f[1]), max(f[n], f[n + 1])), max(max(g[0], g[1]), max(g[n], g[n + 1])));
  return clamp(value, low, high);
}

// Calls body(index, point in cells) for every cell.
template <class Body>
void forCells(const Lattice& lattice, base::ThreadPool& pool, Body&& body) {
  const int n = lattice.n;
  pool.run(n, n * n, [&](int begin, int end) {
    for (int z = begin; z < end; ++z) {
      for (int y = 0; y < n; ++y) {
        const int row = lattice.index(0, y, z);
        Float4 point(0, float(y), float(z));
        for (int x = 0; x < n; ++x, point = point + Float4(1, 0, 0)) body(row + x, point);
      }
    }
  });
}

Float4 cellsPerSpeed(const Lattice& lattice, float dt) {
  const Eigen::Vector3f s = dt * lattice.cell.cwiseInverse();
  return {s.x(), s.y(), s.z()};
}

}  // namespace

void advect(const Lattice& lattice, float dt, Fields& fields, base::ThreadPool& pool) {
  const int n = lattice.n;
  const Float4 scale = cellsPerSpeed(lattice, dt), last = Float4::all(float(n - 1));
  const Float4* u = fields.velocity.data();
  Float4* out = fields.work.data();
  forCells(lattice, pool,
           [=](int i, Float4 point) { out[i] = sample(u, locate(point - u[i] * scale, n, last), n); });
}

void correctAdvection(const Lattice& lattice, float dt, Fields& fields, base::ThreadPool& pool) {
  const int n = lattice.n;
  const Float4 scale = cellsPerSpeed(lattice, dt), last = Float4::all(float(n - 1));
  const Float4* u = fields.velocity.data();
  const Float4* forward = fields.work.data();
  Float4* out = fields.corrected.data();
  forCells(lattice, pool, [=](int i, Float4 point) {
    const Float4 step = u[i] * scale;
    const Float4 restored = sample(forward, locate(point + step, n, last), n);
    const Float4 value = forward[i] + (u[i] - restored) * 0.5f;
    out[i] = clampToCorner(value, u, locate(point - step, n, last), n);
  });
  fields.velocity.swap(fields.corrected);
}

}  // namespace rubble::dust
