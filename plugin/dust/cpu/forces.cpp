#include "dust/cpu/forces.h"

#include <algorithm>
#include <cmath>

#include "shared/dust.h"

namespace rubble::dust {

namespace {

// Offsets to the two neighbours along an axis; at a side the cell stands for its missing neighbour.
struct Reach {
  int low, high;
};

Reach reach(int i, int n, int stride) {
  return {i > 0 ? -stride : 0, i < n - 1 ? stride : 0};
}

// Decay rate of the sponge [1/s] at `distance` cells from an open side (0 is the cell at the side).
float spongeRate(int distance) {
  const float d = 1 - float(distance) / float(shared::kDustSpongeCells);
  return d > 0 ? shared::kDustSpongeRate * d * d : 0;
}

int distanceToSide(int i, int n) {
  return std::min(i, n - 1 - i);
}

// Change of velocity by confinement: eps h |w| (N x w) dt with N the direction in which |w| grows. Fedkiw's
// eps h (N x w) carries a hidden 1/s; with |w| in its place eps has no dimension and weak eddies die out. The
// angle |w| dt is cut.
Float4 confinement(const Float4* curl, Reach rx, Reach ry, Reach rz, Float4 halfInverse, float strength,
                   float dt) {
  const Float4 w = curl[0];
  const Float4 slope = Float4(curl[rx.high][3] - curl[rx.low][3], curl[ry.high][3] - curl[ry.low][3],
                              curl[rz.high][3] - curl[rz.low][3]) *
                       halfInverse;
  const float length = std::sqrt(slope[0] * slope[0] + slope[1] * slope[1] + slope[2] * slope[2]);
  const float scale =
      strength * std::min(w[3] * dt, shared::kDustMaxTurn) / (length + shared::kDustLevelCurl);
  return Float4(slope[1] * w[2] - slope[2] * w[1], slope[2] * w[0] - slope[0] * w[2],
                slope[0] * w[1] - slope[1] * w[0]) *
         scale;
}

}  // namespace

void computeCurl(const Lattice& lattice, Fields& fields, base::ThreadPool& pool) {
  const int n = lattice.n;
  const Eigen::Vector3f half = 0.5f * lattice.cell.cwiseInverse();
  pool.run(n, n * n, [&](int begin, int end) {
    for (int z = begin; z < end; ++z) {
      const Reach rz = reach(z, n, n * n);
      for (int y = 0; y < n; ++y) {
        const Reach ry = reach(y, n, n);
        for (int x = 0; x < n; ++x) {
          const Reach rx = reach(x, n, 1);
          const Float4* u = &fields.velocity[lattice.index(x, y, z)];
          const Float4 dx = (u[rx.high] - u[rx.low]) * half.x();
          const Float4 dy = (u[ry.high] - u[ry.low]) * half.y();
          const Float4 dz = (u[rz.high] - u[rz.low]) * half.z();
          const float a = dy[2] - dz[1], b = dz[0] - dx[2], c = dx[1] - dy[0];
          fields.work[lattice.index(x, y, z)] = Float4(a, b, c, std::sqrt(a * a + b * b + c * c));
        }
      }
    }
  });
}

void applyForces(const Lattice& lattice, const ForceConstants& constants, Fields& fields,
                 base::ThreadPool& pool) {
  const int n = lattice.n;
  const Eigen::Vector3f half = 0.5f * lattice.cell.cwiseInverse();
  const Float4 halfInverse(half.x(), half.y(), half.z());
  const Float4 most = Float4::all(shared::kDustMaxSpeed), least = Float4::all(-shared::kDustMaxSpeed);
  const float strength = constants.vorticity * lattice.cell.minCoeff();
  pool.run(n, n * n, [&](int begin, int end) {
    for (int z = begin; z < end; ++z) {
      const Reach rz = reach(z, n, n * n);
      for (int y = 0; y < n; ++y) {
        const Reach ry = reach(y, n, n);
        const int rowDistance = std::min(n - 1 - y, distanceToSide(z, n));
        for (int x = 0; x < n; ++x) {
          const int i = lattice.index(x, y, z);
          Float4 u = fields.velocity[i];
          if (constants.vorticity > 0) {
            u = u + confinement(&fields.work[i], reach(x, n, 1), ry, rz, halfInverse, strength, constants.dt);
          }
          const float sink =
              std::min(constants.load * fields.density[i], shared::kDustMaxLoad * constants.gravity);
          u = u - Float4(0, sink * constants.dt, 0);
          const float rate = spongeRate(std::min(rowDistance, distanceToSide(x, n)));
          u = u * (constants.decay / (1 + rate * constants.dt));
          fields.velocity[i] = clamp(u, least, most);
        }
      }
    }
  });
}

}  // namespace rubble::dust
