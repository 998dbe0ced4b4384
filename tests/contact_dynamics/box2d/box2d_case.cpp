#include "tests/contact_dynamics/box2d/box2d_case.hpp"

#include <cstddef>
#include <cstdint>

namespace viscontact::particles {
namespace {

/// x <- 6364136223846793005 x + 1442695040888963407 mod 2^64 from 12345; the top 53 bits.
class Uniform {
 public:
  double operator()() {
    x_ = 6364136223846793005U * x_ + 1442695040888963407U;
    return static_cast<double>(x_ >> 11) * 0x1p-53;
  }

 private:
  std::uint64_t x_ = 12345;
};

/// The number of particles along an edge of the lattice.
int along_edge(int count, int dimension) {
  int n = 1;
  const auto fits = [&] { return dimension == 2 ? n * n >= count : n * n * n >= count; };
  while (!fits()) ++n;
  return n;
}

}  // namespace

State particles_in_box(int count, int dimension) {
  State state;
  auto& p = state.particles;
  p.dimension = dimension;
  Uniform uniform;
  const int n = along_edge(count, dimension);
  for (int k = 0; k < count; ++k) {
    const double radius = 0.8 + 0.2 * uniform();
    p.radii.push_back(radius);
    p.masses.push_back(dimension == 2 ? radius * radius : radius * radius * radius);
    for (int d = 0, place = k; d < dimension; ++d, place /= n)
      p.positions.push_back(1.05 + 2.1 * (d + 1 < dimension ? place % n : place) +
                            0.1 * (uniform() - 0.5));
  }
  p.velocities.assign(p.positions.size(), 0.0);
  return state;
}

Setting box(int count, int dimension) {
  Setting setting;
  const double width = 2.1 * along_edge(count, dimension);
  const auto plane = [&](const Vector& point, const Vector& normal) {
    Plane p;
    p.start = {point, normal};
    setting.planes.push_back(p);
  };
  const auto up = static_cast<std::size_t>(dimension - 1);
  Vector upwards{};
  upwards[up] = 1;
  plane({}, upwards);
  for (std::size_t d = 0; d < up; ++d) {
    Vector inwards{}, corner{};
    inwards[d] = 1;
    corner[d] = width;
    plane({}, inwards);
    plane(corner, -1 * inwards);
  }
  setting.gravity = -1 * upwards;
  setting.time_step = 0.05;
  setting.laws.film.gamma_min = -2;
  return setting;
}

}  // namespace viscontact::particles
