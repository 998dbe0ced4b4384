#include "tests/particles/box2d/box2d_case.hpp"

#include <cmath>
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

}  // namespace

State box_of_discs(int count) {
  State state;
  auto& p = state.particles;
  Uniform uniform;
  const int n = static_cast<int>(std::ceil(std::sqrt(count)));
  for (int k = 0; k < count; ++k) {
    const double radius = 0.8 + 0.2 * uniform();
    const double x = 0.1 * (uniform() - 0.5), y = 0.1 * (uniform() - 0.5);
    p.radii.push_back(radius);
    p.masses.push_back(radius * radius);
    p.positions.insert(p.positions.end(), {1.05 + 2.1 * (k % n) + x, 1.05 + 2.1 * (k / n) + y});
  }
  p.velocities.assign(p.positions.size(), 0.0);
  return state;
}

Setting box(int count) {
  Setting setting;
  const double width = 2.1 * std::ceil(std::sqrt(count));
  const auto plane = [&](Vector point, Vector normal) {
    Plane p;
    p.start = {point, normal};
    setting.planes.push_back(p);
  };
  plane({}, {0, 1, 0});
  plane({}, {1, 0, 0});
  plane({width, 0, 0}, {-1, 0, 0});
  setting.gravity = {0, -1, 0};
  setting.time_step = 0.05;
  setting.laws.film.gamma_min = -2;
  return setting;
}

}  // namespace viscontact::particles
