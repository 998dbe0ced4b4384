// Motions across links, films and bodies under tension do not grow, whatever the step.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "tests/common/random.hpp"
#include "tests/particles/systems.hpp"
#include "viscontact/particles/state/rigid_bodies.hpp"

namespace viscontact::particles {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kGravity = 9.81;

enum class Link { kArm, kSpring };

class MotionUnderTension : public ::testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Dimensions, MotionUnderTension, ::testing::Values(2, 3));

/// The largest distance of the middle sphere of a chain of films from its centre of mass, across
/// the chain, in the first and the second half of the time 90. The films absorb the impulse 100 at
/// first; then both ends are pulled with 1, and the middle sphere gets an impulse of 1e-3.
std::array<double, 2> swing_of_films(int dimension, Scheme scheme, double restitution, double h,
                                     std::optional<FrictionMethod> method) {
  constexpr int kCount = 9, kMiddle = 4;
  Setting setting;
  setting.time_step = h;
  setting.scheme = scheme;
  setting.laws.film.gamma_min = -200;
  setting.laws.restitution.coefficient = restitution;
  if (method) setting.laws.friction = FrictionLaw{.coefficient = 0.3, .method = *method};
  State state = no_particles(dimension);
  for (int k = 0; k < kCount; ++k)
    add_particle(state, {0.2 * k, 0, 0}, 0.1, 1,
                 {k == 0            ? 100.0
                  : k == kCount - 1 ? -100.0
                                    : 0.0,
                  0, 0});
  if (method) add_rotation(state.particles);
  setting.forces[0] = constant({-1, 0, 0});
  setting.forces[kCount - 1] = constant({1, 0, 0});
  Simulation simulation(setting, state, 1);
  std::array<double, 2> largest{};
  const auto directions = static_cast<std::size_t>(dimension);
  for (int n = 0; n * h < 90; ++n) {
    simulation.added_forces()[kMiddle * directions + 1] = n == 2 ? 1e-3 / h : 0;
    EXPECT_TRUE(simulation.step(1e9).converged) << h << " " << n;
    double mean = 0;
    for (std::size_t k = 0; k < kCount; ++k)
      mean += simulation.state().particles.position(k)[1] / kCount;
    auto& part = largest[n * h < 45 ? 0 : 1];
    part = std::max(part, std::abs(simulation.state().particles.position(kMiddle)[1] - mean));
  }
  return largest;
}

TEST_P(MotionUnderTension, OfFilmsDoesNotGrowWithAndWithoutRestitution) {
  // The sum of the amplitudes of all modes of a free chain of 9 masses at the distances 0.2 under
  // the tension 1 after an impulse of 1e-3 on the middle one.
  double bound = 0;
  for (int k = 2; k < 9; k += 2) {
    const double w = 2 * std::sqrt(1 / 0.2) * std::sin(k * kPi / 18);
    bound += 1e-3 / w * 2 / 9;
  }
  for (const double restitution : {0.0, 0.5})
    for (const double h : {0.1, 0.3, 0.6, 1.5, 3.0})
      for (const auto scheme : {Scheme::kLeapfrog, Scheme::kEuler}) {
        const auto largest = swing_of_films(GetParam(), scheme, restitution, h, {});
        EXPECT_LT(largest[0], 1.02 * bound) << h;
        EXPECT_LT(largest[1], 1.02 * bound) << h;
        // An impact in the middle of a motion has an amplitude that is smaller by (1 +
        // kappa/4)^(1/2), with kappa = 20 h^2 of the fastest mode.
        EXPECT_GT(largest[1], 0.5 * bound / std::sqrt(1 + 5 * h * h)) << h;
      }
  for (const auto method : {FrictionMethod::kCoulomb, FrictionMethod::kConvex}) {
    const auto largest = swing_of_films(GetParam(), Scheme::kLeapfrog, 0.5, 1.5, method);
    EXPECT_LT(largest[1], 1.02 * bound);
  }
}

/// The largest distance of a particle from its place at the start in 300 steps, in both halves.
std::array<double, 2> farthest(Simulation& simulation) {
  const auto start = simulation.state().particles;
  std::array<double, 2> largest{};
  for (int n = 0; n < 300; ++n) {
    EXPECT_TRUE(simulation.step(1e9).converged) << n;
    auto& part = largest[n < 150 ? 0 : 1];
    for (std::size_t k = 0; k < start.count(); ++k)
      part = std::max(part, norm(simulation.state().particles.position(k) - start.position(k)));
  }
  return largest;
}

TEST_P(MotionUnderTension, OfABodyOnAHingeDoesNotGrow) {
  const int dimension = GetParam();
  const auto swing = [&](double h) {
    Setting setting;
    setting.time_step = h;
    setting.scheme = Scheme::kLeapfrog;
    setting.gravity = {0, -kGravity, 0};
    State state = no_particles(dimension);
    add_particle(state, {0, 0, 0}, 0.1, 1);
    add_particle(state, {0, -0.15, 0}, 0.1, 1);
    add_particle(state, {0, -1.15, 0}, 0.1, 100, {0.01, 0, 0});
    add_rotation(state.particles);
    add_rigid_body(state.particles, {{0, 1}});
    Hinge hinge;
    hinge.at = {0, 0.05, 0};
    hinge.point = {0, hinge.at - state.particles.bodies.bodies[0].centre};
    setting.links.hinges = {hinge};
    setting.links.arms = {{1, 2, PiecewiseLinearLength{{{0, 1.0}}}}};
    Simulation simulation(setting, state, 1);
    return farthest(simulation);
  };
  // The slow mode, of a pendulum of the length 1.2, has the amplitude v sqrt(1.2/g) = 3.5e-3.
  for (const double h : {0.05, 0.1, 0.3}) {
    const auto largest = swing(h);
    EXPECT_LT(std::max(largest[0], largest[1]), 3.7e-3) << h;
    EXPECT_GT(largest[1], 3.3e-3) << h;
  }
}

TEST(MotionUnderTensionOf, ANetOfSpringsDoesNotGrow) {
  // 3 x 3 free masses in a net of springs with the tension 100; the middle one is hit across it.
  const auto net = [](double h) {
    Setting setting;
    setting.time_step = h;
    State state = no_particles(3);
    for (int i = 0; i < 5; ++i)
      for (int j = 0; j < 5; ++j) {
        const bool is_free = i > 0 && i < 4 && j > 0 && j < 4;
        const auto k = static_cast<std::int32_t>(state.particles.count());
        const double x = i, y = j;
        add_particle(state, {x, y, 0}, 0.1, 1, {0, 0, i == 2 && j == 2 ? 1e-3 : 0});
        if (!is_free) setting.links.hinges.push_back({{k, {}}, {x, y, 0}});
        if (i > 0) setting.links.springs.push_back({k - 5, k, 1000, 0.9});
        if (j > 0) setting.links.springs.push_back({k - 1, k, 1000, 0.9});
      }
    add_rotation(state.particles);
    Simulation simulation(setting, state, 1);
    return farthest(simulation);
  };
  // No amplitude exceeds the velocity over the least frequency.
  const double slowest = std::sqrt(100 * 2 * 4 * std::pow(std::sin(kPi / 8), 2));
  for (const double h : {0.05, 0.1, 0.3, 0.7}) {
    const auto largest = net(h);
    EXPECT_LT(std::max(largest[0], largest[1]), 1e-3 / slowest) << h;
    // Steps that do not resolve a vibration start it with a smaller amplitude.
    EXPECT_GT(largest[1], (h < 0.5 ? 0.2e-3 : 0.1e-3) / slowest) << h;
  }
}

/// The largest kinetic energies in the first and the second half of 400 steps of a bridge of masses
/// between two hinges, whose shape is in equilibrium with the horizontal force of its links.
std::array<double, 2> energies_of_bridge(Random& random, int dimension, double part, Link link,
                                         Scheme scheme) {
  const int count = random.integer(1, 9);
  const double pull = random.decades(0, 3);
  std::vector<double> masses, lengths, tensions;
  double weight = 0;
  for (int k = 0; k < count; ++k) {
    masses.push_back(random.decades(-1.5, 1.5));
    weight += masses.back();
  }
  std::vector<Vector> places = {{}};
  double upwards = -weight / 2 * random.uniform(0.5, 1.5);
  for (std::size_t k = 0; k <= masses.size(); ++k) {
    const double along = random.uniform(0.5, 1.5), slope = upwards / pull;
    places.push_back(places.back() + Vector{along, slope * along, 0});
    lengths.push_back(along * std::hypot(1, slope));
    tensions.push_back(pull * std::hypot(1, slope));
    if (k < masses.size()) upwards += masses[k];
  }
  double fastest = 0;  // a bound of the angular frequencies across
  for (std::size_t k = 0; k < masses.size(); ++k)
    fastest = std::max(
        fastest,
        std::sqrt(2 * (tensions[k] / lengths[k] + tensions[k + 1] / lengths[k + 1]) / masses[k]));
  Setting setting;
  setting.time_step = part * 2 * kPi / fastest;
  setting.scheme = scheme;
  setting.gravity = {0, -1, 0};
  State state = no_particles(dimension);
  for (std::size_t k = 0; k < places.size(); ++k) {
    const bool is_end = k == 0 || k + 1 == places.size();
    const auto n = static_cast<double>(k);
    const Vector velocity{0, 1e-4 * std::cos(3 * n), dimension == 3 ? 1e-4 * std::sin(5 * n) : 0};
    add_particle(state, places[k], 0.05, is_end ? 1 : masses[k - 1], is_end ? Vector{} : velocity);
    if (is_end) setting.links.hinges.push_back({{static_cast<std::int32_t>(k), {}}, places[k]});
  }
  add_rotation(state.particles);
  for (std::int32_t k = 0; k <= count; ++k) {
    const double length = lengths[index_of(k)];
    if (link == Link::kSpring)
      setting.links.springs.push_back({k, k + 1, 1e4 * tensions[index_of(k)], length - 1e-4});
    else
      setting.links.arms.push_back({k, k + 1, PiecewiseLinearLength{{{0, length}}}});
  }
  Simulation simulation(setting, state, 1);
  std::array<double, 2> largest{};
  for (int n = 0; n < 400; ++n) {
    EXPECT_TRUE(simulation.step(1e12).converged) << n;
    auto& half = largest[n < 200 ? 0 : 1];
    half = std::max(half, kinetic_energy(simulation.state().particles));
  }
  return largest;
}

TEST_P(MotionUnderTension, OfRandomBridgesDoesNotGrow) {
  Random random(5);
  for (int scene = 0; scene < 3; ++scene)
    for (const auto link : {Link::kArm, Link::kSpring})
      for (const auto scheme : {Scheme::kLeapfrog, Scheme::kEuler})
        for (const double part : {1e-3, 0.03, 0.1, 0.3, 1.0}) {
          const auto largest = energies_of_bridge(random, GetParam(), part, link, scheme);
          // The modes are in phase at other times in both halves: 1.2 is seen in 1440 bridges.
          EXPECT_LT(largest[1], 1.5 * largest[0]) << scene << " " << part;
        }
}

/// The largest kinetic energies across a chain of films that is pulled at both ends, in the first
/// and the second half of 300 steps. The films absorb an impact on both ends before.
std::array<double, 2> energies_of_films(Random& random, int dimension, double part,
                                        double restitution, std::optional<FrictionMethod> method,
                                        Scheme scheme) {
  const auto count = static_cast<std::size_t>(random.integer(3, 9));
  const double pull = random.decades(-2, 2);
  std::vector<double> masses, radii;
  for (std::size_t k = 0; k < count; ++k) {
    masses.push_back(random.decades(-1, 1));
    radii.push_back(random.decades(-1, 0));
  }
  double fastest = 0;
  for (std::size_t k = 0; k < count; ++k) {
    double stiffness = 0;
    if (k > 0) stiffness += pull / (radii[k - 1] + radii[k]);
    if (k + 1 < count) stiffness += pull / (radii[k] + radii[k + 1]);
    fastest = std::max(fastest, std::sqrt(2 * stiffness / masses[k]));
  }
  const double period = 2 * kPi / fastest, h = part * period;
  Setting setting;
  setting.time_step = h;
  setting.scheme = scheme;
  setting.laws.film.gamma_min = -1e9 * pull * period;
  setting.laws.restitution.coefficient = restitution;
  if (method) setting.laws.friction = FrictionLaw{.coefficient = 0.3, .method = *method};
  State state = no_particles(dimension);
  double end = 0;
  for (std::size_t k = 0; k < count; ++k) {
    add_particle(state, {end + radii[k], 0, 0}, radii[k], masses[k]);
    end += 2 * radii[k];
  }
  if (method) add_rotation(state.particles);
  // The impact is larger than what the pull takes back in 300 steps.
  const Vector impact{1e4 * pull * 300, 0, 0}, force{pull, 0, 0};
  setting.forces[0] = {{{h, impact}, {1e18, -1 * force}}};
  setting.forces[static_cast<std::int32_t>(count) - 1] = {{{h, -1 * impact}, {1e18, force}}};
  Simulation simulation(setting, state, 1);
  const auto& p = simulation.state().particles;
  const auto directions = static_cast<std::size_t>(dimension);
  std::array<double, 2> largest{};
  for (int n = 0; n < 300; ++n) {
    for (std::size_t k = 0; k < count; ++k)
      simulation.added_forces()[k * directions + 1] =
          n == 2 ? masses[k] * 1e-4 * fastest * radii[0] * std::cos(3.0 * double(k)) / h : 0;
    const auto report = simulation.step(1e12);
    EXPECT_LE(report.excess, 2) << n;  // one step of 288 000 has 1.14
    Vector total{};
    double mass = 0, energy = 0;
    for (std::size_t k = 0; k < count; ++k) {
      total = total + masses[k] * p.velocity(k);
      mass += masses[k];
    }
    for (std::size_t k = 0; k < count; ++k) {
      const Vector v = p.velocity(k) - 1 / mass * total;
      energy += masses[k] * (v[1] * v[1] + v[2] * v[2]) / 2;
    }
    auto& half = largest[n < 150 ? 0 : 1];
    if (n > 3) half = std::max(half, energy);
  }
  return largest;
}

TEST_P(MotionUnderTension, OfRandomChainsOfFilmsDoesNotGrow) {
  Random random(11);
  using Method = std::optional<FrictionMethod>;
  for (int scene = 0; scene < 3; ++scene)
    for (const auto method :
         {Method{}, Method{FrictionMethod::kCoulomb}, Method{FrictionMethod::kConvex}})
      for (const double restitution : {0.0, 0.5})
        for (const auto scheme : {Scheme::kLeapfrog, Scheme::kEuler})
          for (const double part : {0.03, 0.1, 0.3, 1.0}) {
            const auto largest =
                energies_of_films(random, GetParam(), part, restitution, method, scheme);
            EXPECT_LT(largest[1], 1.5 * largest[0]) << scene << " " << part;
            EXPECT_GT(largest[1], 0.02 * largest[0]) << scene << " " << part;
          }
}

TEST(MotionUnderTensionOf, AMembraneUnderPressureDoesNotGrow) {
  // 24 beads on a circle, each pushed outwards with 1.
  constexpr int kBeads = 24;
  const double side = 2 * std::sin(kPi / kBeads), tension = 1 / (2 * std::sin(kPi / kBeads));
  const double period = 2 * kPi / std::sqrt(4 * tension / side);
  for (const bool keeps_area : {false, true})
    for (const double part : {0.1, 0.3, 0.5, 1.0}) {
      Setting setting;
      setting.time_step = part * period;
      State state = no_particles(2);
      Membrane membrane;
      membrane.set_beads(0, kBeads);
      membrane.bending_rigidity = 0;
      membrane.keeps_area = keeps_area;
      membrane.perimeter = kBeads * side;
      membrane.lengths.assign(kBeads, side);
      membrane.area = kBeads * std::sin(2 * kPi / kBeads) / 2;
      for (int k = 0; k < kBeads; ++k) {
        const Vector out{std::cos(2 * kPi * k / kBeads), std::sin(2 * kPi * k / kBeads), 0};
        // With a part that changes its sign from bead to bead.
        add_particle(state, out, 0.05, 1, (1e-5 * std::cos(k * k)) * out);
        setting.forces[k] = constant(out);
      }
      add_rotation(state.particles);
      setting.links.membranes = {membrane};
      setting.laws.film.gamma_min = 0;
      Simulation simulation(setting, state, 1);
      const double at_start = kinetic_energy(state.particles);
      for (int n = 0; n < 300; ++n) {
        // The area of a regular polygon is the largest one of its lengths, and its equation repeats
        // theirs: such cases are refused, and impulses of some steps are not found to 1e-10.
        const bool is_solved = simulation.step(1e9).converged;
        EXPECT_TRUE(is_solved || keeps_area) << part << " " << n;
        EXPECT_LT(kinetic_energy(simulation.state().particles), 1.1 * at_start) << part << " " << n;
        if (HasFailure()) return;
      }
    }
}

TEST_P(MotionUnderTension, OfABodyThatGivenForcesPullApartDoesNotGrowAtAnyStep) {
  // Three particles in a row whose ends are pulled with F: a turn has w^2 = 2 F a/I.
  constexpr double force = 40, arm = 1.5, start = 0.02;
  for (const double part : {1e-3, 0.03, 0.1, 0.2, 0.5, 1.0, 30.0})
    for (const auto scheme : {Scheme::kLeapfrog, Scheme::kEuler}) {
      Setting setting;
      setting.scheme = scheme;
      State state = no_particles(GetParam());
      for (int k = -1; k < 2; ++k) {
        // In space it begins to turn about an axis between y and z.
        add_particle(state, {k * arm, 0, 0}, 0.1, 1,
                     {0, k * arm * start, GetParam() == 3 ? k * arm * start : 0});
        if (k != 0) setting.forces[k + 1] = constant({k * force, 0, 0});
      }
      add_rotation(state.particles);
      add_rigid_body(state.particles, {{0, 1, 2}});
      const auto& body = state.particles.bodies.bodies.front();
      const double inertia = present_inertia(body, GetParam())[8];
      const double w = std::sqrt(2 * force * arm / inertia);
      setting.time_step = part * 2 * kPi / w;
      const double exact = start / w * arm;
      Simulation simulation(setting, state, 1);
      double early = 0, late = 0;
      for (int n = 0; n < 400; ++n) {
        EXPECT_TRUE(simulation.step(1e99).converged);
        const auto at = simulation.state().particles.position(2);
        auto& largest = n < 200 ? early : late;
        largest = std::max(largest, std::abs(at[1]));
        EXPECT_NEAR(at[2], GetParam() == 3 ? at[1] : 0, 1e-9 * exact);
      }
      // With kappa = 0.036 the directions of the beginning of the step act, and the amplitude is
      // larger by up to kappa/8.
      EXPECT_LT(std::max(early, late), 1.005 * exact) << part;
      // A start that the step does not resolve has a smaller amplitude, as in the double pendulum.
      const double kappa = std::pow(2 * kPi * part, 2);
      const double begin = (1 + kappa / 2) / ((1 + 3 * kappa / 8) * std::sqrt(1 + kappa / 4));
      const double least = part > 0.01 ? (scheme == Scheme::kEuler ? 0.5 : 0.95) * begin : 0;
      EXPECT_GT(late, least * exact) << part;
    }
}

}  // namespace
}  // namespace viscontact::particles
