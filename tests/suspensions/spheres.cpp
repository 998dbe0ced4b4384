#include "tests/suspensions/spheres.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "viscontact/suspensions/cell/sheared_cell.hpp"

namespace viscontact::particles {

State spheres_at(const std::vector<Vector>& places, const std::vector<double>& radii) {
  State state;
  auto& p = state.particles;
  p.dimension = 3;
  p.radii = radii;
  for (const auto& x : places) p.positions.insert(p.positions.end(), x.begin(), x.end());
  p.velocities.assign(p.positions.size(), 0);
  for (const double a : radii) p.masses.push_back(4 * M_PI / 3 * a * a * a);
  add_rotation(p);
  return state;
}

State random_spheres(double period, double offset, const std::vector<double>& radii, double gap,
                     Random& random) {
  const suspensions::ShearedCell cell{{}, {period, period, period}, offset};
  std::vector<Vector> places;
  for (int trials = 0; places.size() < radii.size(); ++trials) {
    // The first spheres may leave no room for the last ones.
    if (trials % 5000 == 4999) places.clear();
    const Vector x{random.uniform(0, period), random.uniform(0, period), random.uniform(0, period)};
    bool is_free = true;
    for (std::size_t k = 0; k < places.size() && is_free; ++k)
      is_free = norm(cell.nearest(x - places[k])) >= (1 + gap) * (radii[k] + radii[places.size()]);
    if (is_free) places.push_back(x);
  }
  return spheres_at(places, radii);
}

State disturbed_lattice(int side, double spacing, double displacement, Random& random) {
  std::vector<Vector> places;
  const auto moved = [&](int site) {
    return spacing * (site + 0.5) + random.uniform(-displacement, displacement);
  };
  for (int x = 0; x < side; ++x)
    for (int y = 0; y < side; ++y)
      for (int z = 0; z < side; ++z) {
        const double at_x = moved(x), at_y = moved(y);
        places.push_back({at_x, at_y, moved(z)});
      }
  return spheres_at(places, std::vector<double>(places.size(), 1));
}

State reordered(const State& state, const std::vector<std::size_t>& order) {
  std::vector<Vector> places;
  std::vector<double> radii;
  for (const auto k : order) {
    places.push_back(state.particles.position(k));
    radii.push_back(state.particles.radii[k]);
  }
  return spheres_at(places, radii);
}

std::vector<std::size_t> shuffled(std::size_t count) {
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), 0U);
  std::shuffle(order.begin(), order.end(), std::mt19937(1));
  return order;
}

State scaled(const State& state, double length) {
  auto radii = state.particles.radii;
  for (auto& radius : radii) radius *= length;
  std::vector<Vector> places;
  for (std::size_t k = 0; k < state.particles.count(); ++k)
    places.push_back(length * state.particles.position(k));
  return spheres_at(places, radii);
}

std::vector<RelativeMotion> mirrored(std::vector<RelativeMotion> motions) {
  for (auto& motion : motions) {
    motion.along[2] *= -1;
    motion.turn[0] *= -1;
    motion.turn[1] *= -1;
  }
  return motions;
}

std::vector<RelativeMotion> in_units(std::vector<RelativeMotion> motions, double length,
                                     double time) {
  for (auto& motion : motions) {
    motion.along = (time / length) * motion.along;
    motion.turn = time * motion.turn;
  }
  return motions;
}

std::vector<double> two_sizes(std::size_t count) {
  std::vector<double> radii;
  for (std::size_t k = 0; k < count; ++k) radii.push_back(k % 2 == 0 ? 1 : 1.4);
  return radii;
}

Setting sheared_cube(double period, double offset) {
  Setting setting;
  setting.domain = BoxDomain{{0, 0, 0}, {period, period, period}, {true, true, true}};
  PairLubrication lubrication;
  lubrication.viscosity = 1;
  lubrication.pairs = PairTerms::kNearContact;
  lubrication.regularisation = 1e-3;
  lubrication.gradient[0][1] = 1;
  lubrication.offset = offset;
  setting.lubrication = lubrication;
  return setting;
}

void PrintTo(const StepKind& kind, std::ostream* out) {
  *out << "pairs " << static_cast<int>(kind.pairs) << ", regularisation " << kind.regularisation
       << ", roughness " << kind.roughness << ", friction " << kind.friction;
}

Setting sheared_cube(double period, double offset, const StepKind& kind) {
  auto setting = sheared_cube(period, offset);
  auto& of = *setting.lubrication;
  of.pairs = kind.pairs;
  of.regularisation = kind.regularisation;
  of.roughness = kind.roughness;
  if (kind.friction > 0) setting.laws.friction = FrictionLaw{kind.friction};
  if (kind.pairs == PairTerms::kNone) {
    setting.laws.film.viscosity = 1;
    setting.laws.film.roughness = 1e-3;
  }
  return setting;
}

void expect_continued(const Setting& setting, const State& start, int before, int after) {
  SuspensionSimulation whole(setting, start, 1);
  for (int n = 0; n < before; ++n) whole.step(10);
  SuspensionSimulation rest(setting, whole.state(), 1);
  for (int n = 0; n < after; ++n) {
    whole.step(10);
    rest.step(10);
  }
  const State &one = whole.state(), &two = rest.state();
  EXPECT_EQ(one.particles.positions, two.particles.positions);
  EXPECT_EQ(one.particles.velocities, two.particles.velocities);
  EXPECT_EQ(one.particles.angular_velocities, two.particles.angular_velocities);
  EXPECT_EQ(one.pairs, two.pairs);
  EXPECT_EQ(one.walls, two.walls);
  EXPECT_EQ(one.shear, two.shear);
}

RelativeMotion relative_motion(const SuspensionSimulation& simulation, const Setting& setting,
                               std::size_t k) {
  const auto& p = simulation.state().particles;
  const auto& g = setting.lubrication->gradient;
  const double rate = simulation.state().shear.rate;
  const Vector x = p.position(k);
  const Vector flow{dot(g[0], x), dot(g[1], x), dot(g[2], x)};
  const Vector turn{(g[2][1] - g[1][2]) / 2, (g[0][2] - g[2][0]) / 2, (g[1][0] - g[0][1]) / 2};
  return {p.velocity(k) - rate * flow, point_of(p.angular_velocities.data(), k, 3) - rate * turn};
}

double largest_difference(const std::vector<RelativeMotion>& a,
                          const std::vector<RelativeMotion>& b) {
  double difference = 0, largest = 0;
  for (std::size_t k = 0; k < a.size(); ++k)
    for (std::size_t d = 0; d < 3; ++d) {
      difference = std::max({difference, std::abs(a[k].along[d] - b[k].along[d]),
                             std::abs(a[k].turn[d] - b[k].turn[d])});
      largest = std::max({largest, std::abs(a[k].along[d]), std::abs(a[k].turn[d])});
    }
  return difference / largest;
}

}  // namespace viscontact::particles
