// The forces of contacts in files: Newton's law for each particle, the weight on walls, and the
// stress of closed forms.
#include "viscontact/particle_runs/io/contact_file.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <sstream>

#include "tests/common/temporary_folder.hpp"
#include "tests/particles/systems.hpp"
#include "viscontact/particle_runs/io/restart.hpp"

namespace viscontact::particles {
namespace {

/// The numbers of each row of a table of the case at this state.
std::vector<std::vector<double>> rows_of(const std::string& name, const Setting& setting,
                                         const State& state) {
  const auto tables = asked_tables(setting, state.particles, std::vector{name});
  EXPECT_EQ(tables.size(), 1U);
  std::istringstream lines(tables.front().rows(setting, state, {}));
  std::vector<std::vector<double>> rows;
  for (std::string line; std::getline(lines, line);) {
    auto& row = rows.emplace_back();
    std::istringstream fields(line);
    for (std::string field; std::getline(fields, field, ',');) row.push_back(std::stod(field));
  }
  return rows;
}

/// Particles that fall on a floor and on each other, in units of length, time and mass that are
/// these numbers.
struct Fall {
  Setting setting;
  State state;
  Fall(int dimension, bool has_friction, double length, double time, double mass) {
    Random random(7);
    state = random_cloud(
        dimension, 30, 12, [&] { return random.uniform(0.5, 1); }, random);
    auto& p = state.particles;
    for (auto* lengths : {&p.positions, &p.radii})
      for (auto& x : *lengths) x *= length;
    for (auto& m : p.masses) m *= mass;
    add_rotation(p);
    const auto up = static_cast<std::size_t>(dimension - 1);
    double lowest = 1e300;
    for (std::size_t k = 0; k < p.count(); ++k)
      lowest = std::min(lowest, p.position(k)[up] - p.radii[k]);
    Vector floor{}, normal{};
    floor[up] = lowest;
    normal[up] = 1;
    setting.planes = {plane_at_rest(floor, normal)};
    setting.gravity[up] = -length / (time * time);
    setting.laws.film.gamma_min = -0.2 * mass * length / time;
    if (has_friction) setting.laws.friction = FrictionLaw{0.3};
    setting.time_step = 0.05 * time;
  }
};

/// The unit normal of a contact from its first particle, or from the floor, to its second one.
Vector normal_of(const CurrentContact& contact, const Particles& p, const Vector& up) {
  if (contact.first < 0) return up;
  const Vector apart = p.position(index_of(contact.second)) - p.position(index_of(contact.first));
  return (1 / norm(apart)) * apart;
}

TEST(ForcesOfContacts, ChangeTheMomentumOfEachParticle) {
  Random units(3);
  for (const int dimension : {2, 3})
    for (const bool has_friction : {false, true}) {
      SCOPED_TRACE(testing::Message() << dimension << has_friction);
      const double length = units.decades(-5, 5), time = units.decades(-5, 5),
                   mass = units.decades(-5, 5), force = mass * length / (time * time);
      const Fall fall(dimension, has_friction, length, time, mass);
      Simulation simulation(fall.setting, fall.state, 1);
      const Vector up = fall.setting.planes[0].start.normal;
      std::size_t seen = 0;
      for (int step = 0; step < 120; ++step) {
        const auto before = simulation.state().particles;
        const auto report = simulation.step(1e300);
        // A step that is divided has the sum of impulses along different normals.
        if (report.parts > 1) continue;
        const auto& state = simulation.state();
        const auto& p = state.particles;
        std::vector<Vector> forces(p.count());
        for (const auto& contact : contacts_of(simulation.setting(), state)) {
          const Vector f =
              contact.normal_force * normal_of(contact, before, up) + contact.tangential_force;
          auto& second = forces[index_of(contact.second)];
          second = second + f;
          if (contact.first >= 0) {
            auto& first = forces[index_of(contact.first)];
            first = first - f;
          }
          ++seen;
        }
        for (std::size_t k = 0; k < p.count(); ++k) {
          const Vector change =
              p.masses[k] / fall.setting.time_step * (p.velocity(k) - before.velocity(k));
          const Vector missing = change - forces[k] - p.masses[k] * fall.setting.gravity;
          // Rounding errors of impulses that are 1e3 times as large while all is stopped.
          EXPECT_LE(norm(missing), 1e-10 * force) << step;
        }
      }
      EXPECT_GT(seen, 500U);
    }
}

TEST(ForcesOfContacts, OfAHeapCarryItsWeight) {
  for (const int dimension : {2, 3}) {
    const Fall fall(dimension, true, 1, 1, 1);
    Simulation simulation(fall.setting, fall.state, 1);
    run(simulation, 200);
    double weight = 0;
    for (const double m : simulation.state().particles.masses) weight += m;
    const auto rows = rows_of("walls", simulation.setting(), simulation.state());
    ASSERT_EQ(rows.size(), 1U);
    const auto axes = static_cast<std::size_t>(dimension);
    ASSERT_EQ(rows[0].size(), 2 + 3 * axes);
    EXPECT_NEAR(rows[0][0], 200, 1e-9);
    EXPECT_EQ(rows[0][1], -1);
    EXPECT_NEAR(rows[0][1 + axes], -weight, 1e-6 * weight);
    EXPECT_EQ(rows[0][1 + 2 * axes], fall.setting.planes[0].start.point[axes - 1]);
    EXPECT_EQ(rows[0].back(), 0);
    // Coulomb's law holds within rounding errors, and slides reach its bound.
    for (const auto& contact : contacts_of(simulation.setting(), simulation.state())) {
      const double bound = 0.3 * contact.solid_force;
      EXPECT_LE(norm(contact.tangential_force), bound * (1 + 1e-9));
      EXPECT_LE(contact.solid_force, std::max(contact.normal_force, 0.0) * (1 + 1e-9));
      if (contact.friction == ContactFriction::kSlides) {
        EXPECT_GE(norm(contact.tangential_force), bound * (1 - 1e-8));
      }
    }
  }
}

/// Two discs of the radius 1 and the masses 1 and 2 on each other in a box of the area 24.
Simulation column_in_box() {
  State state = no_particles(2);
  add_particle(state, {2, 1, 0}, 1, 1);
  add_particle(state, {2, 3, 0}, 1, 2);
  Setting setting;
  setting.domain = BoxDomain{{0, 0}, {4, 6}, {}};
  setting.gravity = {0, -1, 0};
  setting.time_step = 0.1;
  return {setting, state, 1};
}

TEST(ForcesOfContacts, OfImpactsAndLoadsOnWallsAreTheChangeOfTheMomentum) {
  // Discs and spheres, two of them one body, that rebound, rub, and come to rest in a box.
  for (const int dimension : {2, 3})
    for (const auto scheme : {Scheme::kEuler, Scheme::kLeapfrog}) {
      State state = no_particles(dimension);
      Random random(4);
      for (int k = 0; k < 8; ++k)
        add_particle(state, {1.5 * (k % 2) + 1, 1.5 * (k / 2 % 2) + 1, 1.5 * (k / 4) + 1}, 0.6,
                     random.uniform(0.5, 2), 3.0 * random.direction(dimension));
      if (dimension == 2)
        for (std::size_t k = 4; k < 8; ++k) state.particles.positions[2 * k] += 2.8;
      add_rotation(state.particles);
      add_rigid_body(state.particles, {.members = {0, 1}});
      Setting setting;
      for (std::size_t d = 0; d < static_cast<std::size_t>(dimension); ++d)
        for (const double side : {0.0, 6.0}) {
          Vector point{}, normal{};
          point[d] = side;
          normal[d] = side > 0 ? -1 : 1;
          setting.planes.push_back(plane_at_rest(point, normal));
        }
      setting.gravity = {0.3, -2, 0};
      setting.scheme = scheme;
      setting.time_step = 0.02;
      setting.laws.film.gamma_min = -0.05;
      setting.laws.friction = FrictionLaw{0.3};
      setting.laws.restitution.coefficient = 0.6;
      Simulation simulation(setting, state, 1);
      std::size_t impacts = 0;
      double mass = 0;
      for (const double m : state.particles.masses) mass += m;
      for (int n = 0; n < 400; ++n) {
        const Vector before = momentum(simulation.state().particles);
        simulation.step(100);
        impacts += simulation.rebounds().size();
        const double h = setting.time_step;
        const double impulse_time = scheme == Scheme::kLeapfrog && n == 0 ? h / 2 : h;
        Vector sum = (impulse_time * mass) * setting.gravity;
        for (const auto& row : rows_of("walls", simulation.setting(), simulation.state()))
          for (std::size_t d = 0; d < static_cast<std::size_t>(dimension); ++d)
            sum[d] -= h * row[2 + d];
        const Vector change = momentum(simulation.state().particles) - before;
        // Rounding errors of momenta up to 10 times the mass, after tens of impacts in the step.
        EXPECT_LE(norm(change - sum), 1e-12 * mass) << dimension << " step " << n;
      }
      EXPECT_GT(impacts, 30U);
    }
}

TEST(ForcesOfContacts, OfImpactsAreTheirStress) {
  // In the first step two discs hit each other along x and a third one the left wall. The impulses
  // are 2 * 0.75 * 3 and 2 * 2 * 1, at the distances 1.5 and 0.5, in an area of 24.
  State state = no_particles(2);
  add_particle(state, {1.5, 1, 0}, 1, 1, {2, 0, 0});
  add_particle(state, {3.05, 1, 0}, 0.5, 3, {-1, 0, 0});
  add_particle(state, {0.52, 4, 0}, 0.5, 2, {-1, 0, 0});
  Setting setting;
  setting.domain = BoxDomain{{0, 0}, {4, 6}, {}};
  setting.time_step = 0.1;
  setting.laws.film.gamma_min = 0;
  setting.laws.restitution.coefficient = 1;
  Simulation simulation(setting, state, 1);
  simulation.step(1);
  ASSERT_EQ(simulation.rebounds().size(), 2U);
  const auto stress = rows_of("stress", simulation.setting(), simulation.state())[0];
  // An impact is solved to 1e-13 of its velocity (kExact in impact_solution.cpp).
  EXPECT_NEAR(stress[1], -(4.5 * 1.5 + 4 * 0.5) / 0.1 / 24, 1e-11);
  EXPECT_EQ(stress[4], 0);
  // A plane that has come down to y = 5 leaves the area 20, and without a domain planes at the
  // walls bound the same region.
  setting.planes.resize(1);
  setting.planes[0].start = {{0, 5.05, 0}, {0, -1, 0}};
  setting.planes[0].velocity.pieces = {{1, {0, -0.5, 0}}};
  EXPECT_NEAR(rows_of("stress", setting, simulation.state())[0][1], stress[1] * 24 / 20, 1e-11);
  simulation.step(1);
  EXPECT_EQ(rows_of("stress", simulation.setting(), simulation.state())[0][1], 0);
}

TEST(ForcesOfContacts, OfAColumnAreItsStress) {
  auto simulation = column_in_box();
  run(simulation, 1);
  const auto rows = rows_of("stress", simulation.setting(), simulation.state());
  ASSERT_EQ(rows.size(), 1U);
  // The upper contact has the force 2 at the distance 2, the floor 3 at the distance 1.
  EXPECT_THAT(rows[0], testing::Pointwise(testing::DoubleNear(1e-9),
                                          std::vector{1.0, 0.0, 0.0, 0.0, -7.0 / 24}));
}

TEST(ForcesOfContacts, AreTheSameAfterARestart) {
  auto simulation = column_in_box();
  run(simulation, 1);
  const TemporaryFolder folder;
  auto state = read_restart(folder.file("restart.bin", write_restart(simulation.state())));
  const auto of = [&](const State& s) {
    return asked_tables(simulation.setting(), s.particles, std::vector<std::string>{"contacts"})
        .front()
        .rows(simulation.setting(), s, {});
  };
  EXPECT_EQ(of(state), of(simulation.state()));
  EXPECT_NE(of(state), "");
}

TEST(ContactFile, NamesIdsAndWalls) {
  auto p = no_particles(2).particles;
  p.ids = {7, 3};
  const std::vector<CurrentContact> contacts = {
      {.first = 0, .second = 1, .gap = 0.5, .gamma = -2, .normal_force = 4},
      {.first = -2, .second = 1, .gap = 0.25, .gamma = 0, .tangential_force = {1, -1, 0}}};
  const auto text = write_contacts(p, contacts);
  EXPECT_THAT(text, testing::StartsWith("# rows: 2\n"));
  EXPECT_THAT(text, testing::EndsWith("\n7,3,0.5,-2,0,4,0,0\n3,-2,0.25,0,0,0,1,-1\n"));
}

}  // namespace
}  // namespace viscontact::particles
