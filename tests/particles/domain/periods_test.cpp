// Periodic domains: images of particles, positions in the cell, pairs across the sides and their
// memory, and restarts.
#include "viscontact/particles/domain/periods.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>
#include <vector>

#include "tests/common/failure.hpp"
#include "tests/common/temporary_folder.hpp"
#include "tests/particles/systems.hpp"
#include "viscontact/particle_runs/io/restart.hpp"
#include "viscontact/particles/contact/contact.hpp"
#include "viscontact/particles/neighbours/close_pairs.hpp"
#include "viscontact/particles/neighbours/neighbour_list.hpp"
#include "viscontact/particles/steps/current_contacts.hpp"

namespace viscontact::particles {
namespace {

BoxDomain box(double width, double height, bool along_x, bool along_y) {
  return {{-1, 2}, {-1 + width, 2 + height}, {along_x, along_y}};
}

TEST(Periods, NumbersOfImagesGiveTheirShifts) {
  const auto cell = cell_of(box(4, 3, true, true));
  EXPECT_EQ(shift_of(cell, 0), (Vector{0, 0, 0}));
  std::set<std::int32_t> numbers;
  for (int y = -1; y <= 1; ++y)
    for (int x = -1; x <= 1; ++x) {
      const auto image = image_number(x, y);
      EXPECT_EQ(image, (x + 1) + 3 * (y + 1) - 4);  // the number in restart files
      EXPECT_EQ(shift_of(cell, image), (Vector{4.0 * x, 3.0 * y, 0}));
      numbers.insert(image);
    }
  EXPECT_EQ(numbers.size(), 9U);
  const auto cuboid = cell_of(BoxDomain{{1, 2, 3}, {5, 8, 5}, {true, true, true}});
  numbers.clear();
  for (std::int32_t image = -kLargestImage; image <= kLargestImage; ++image) {
    const auto [x, y, z] = periods_of_image(image);
    EXPECT_EQ(image_number(x, y, z), image);
    EXPECT_EQ(shift_of(cuboid, image), (Vector{4.0 * x, 6.0 * y, 2.0 * z}));
    EXPECT_TRUE(has_image(cuboid, image));
    EXPECT_EQ(has_image(cell, image), z == 0);
    numbers.insert(image);
  }
  EXPECT_EQ(numbers.size(), 27U);
}

TEST(Periods, BringACoordinateIntoTheCell) {
  const auto cell = cell_of(box(4, 3, true, false));
  EXPECT_EQ(periods_beyond(cell, 0, -1), 0);
  EXPECT_EQ(periods_beyond(cell, 0, 3), 1);
  EXPECT_EQ(periods_beyond(cell, 0, -1.5), -1);
  EXPECT_EQ(periods_beyond(cell, 0, 11.5), 3);
  EXPECT_EQ(periods_beyond(cell, 0, std::nextafter(-1.0, -2.0)), 0);  // but for rounding inside
  EXPECT_EQ(periods_beyond(cell, 1, 100), 0);
}

/// All close pairs by definition, for every image.
std::vector<ClosePair> all_close_pairs(const PeriodicCell& cell, const std::vector<double>& x,
                                       const std::vector<double>& extents) {
  std::vector<ClosePair> pairs;
  const auto count = static_cast<std::int32_t>(extents.size());
  for (std::int32_t i = 0; i < count; ++i)
    for (std::int32_t j = i + 1; j < count; ++j)
      for (std::int32_t image = -kLargestImage; image <= kLargestImage; ++image) {
        const Vector shift = shift_of(cell, image);
        const auto a = index_of(i), b = index_of(j);
        if (!has_image(cell, image)) continue;
        const auto dimension = x.size() / extents.size();
        Vector apart = shift;
        for (std::size_t d = 0; d < dimension; ++d)
          apart[d] += x[dimension * b + d] - x[dimension * a + d];
        if (norm(apart) < extents[a] + extents[b]) pairs.push_back({i, j, image});
      }
  return pairs;
}

TEST(ClosePairsInPeriod, AreThoseOfTheDefinition) {
  Random random(3);
  ThreadPool pool(1);
  for (const auto& [along_x, along_y] : {std::pair(true, true), {true, false}, {false, true}}) {
    const auto cell = cell_of(box(7, 5, along_x, along_y));
    std::vector<double> x, extents;
    for (int k = 0; k < 60; ++k) {
      // Up to a tenth of a period outside the cell.
      x.push_back(random.uniform(-1.7, 6.7));
      x.push_back(random.uniform(1.5, 7.5));
      extents.push_back(random.decades(-1.5, 0.3));
    }
    const auto expected = all_close_pairs(cell, x, extents);
    EXPECT_EQ(close_pairs_in_period(cell, x, extents, pool), expected);
    EXPECT_GT(std::ranges::count_if(expected, [](const auto& pair) { return pair.image != 0; }),
              10);
  }
}

TEST(ClosePairsInPeriod, AreThoseOfTheDefinitionInThreeDimensions) {
  Random random(4);
  ThreadPool pool(1);
  for (int periods = 1; periods < 8; ++periods) {
    const auto cell = cell_of(BoxDomain{
        {-1, 2, 0}, {6, 7, 6}, {(periods & 1) != 0, (periods & 2) != 0, (periods & 4) != 0}});
    std::vector<double> x, extents;
    for (int k = 0; k < 80; ++k) {
      x.insert(x.end(),
               {random.uniform(-1.7, 6.7), random.uniform(1.5, 7.5), random.uniform(-0.6, 6.6)});
      extents.push_back(random.decades(-1.5, 0.3));
    }
    const auto expected = all_close_pairs(cell, x, extents);
    EXPECT_EQ(close_pairs_in_period(cell, x, extents, pool), expected);
    EXPECT_GT(std::ranges::count_if(expected, [](const auto& pair) { return pair.image != 0; }),
              10);
  }
}

TEST(ClosePairsInPeriod, ListTwoImagesOfOneParticle) {
  ThreadPool pool(1);
  const auto cell = cell_of(box(4, 100, true, false));
  EXPECT_EQ(close_pairs_in_period(cell, std::vector<double>{0, 3, 2, 3},
                                  std::vector<double>{1.1, 1.1}, pool),
            (std::vector<ClosePair>{{0, 1, -1}, {0, 1, 0}}));
}

/// One simulation of the motion with a period and one in which all is shifted by `shift`: the
/// sides of the cell are nothing that the motion sees.
Simulation lively_discs(const Vector& shift) {
  Setting setting;
  setting.domain = box(12, 11, true, true);
  setting.laws.film.gamma_min = -0.5;
  setting.time_step = 0.02;
  Random random(11);
  State state = random_cloud(
      2, 30, 8, [&] { return random.uniform(0.4, 0.6); }, random);
  auto& p = state.particles;
  for (std::size_t k = 0; k < p.count(); ++k)
    for (std::size_t d = 0; d < 2; ++d) {
      p.positions[2 * k + d] += 4 + shift[d];
      p.velocities[2 * k + d] = random.uniform(-1, 1);
    }
  return {setting, state, 1};
}

TEST(PeriodicSimulation, DoesNotSeeTheSidesOfTheCell) {
  auto here = lively_discs({});
  auto there = lively_discs({5.5, 3.25, 0});
  run(here, 2);
  run(there, 2);
  const auto &p = here.state().particles, &q = there.state().particles;
  std::size_t across = 0;
  for (std::size_t k = 0; k < p.count(); ++k) {
    for (std::size_t d = 0; d < 2; ++d) {
      const double x = q.positions[2 * k + d] - (d == 0 ? 5.5 : 3.25) - p.positions[2 * k + d];
      const double period = d == 0 ? 12 : 11;
      // Collisions make rounding errors grow.
      EXPECT_NEAR(std::remainder(x, period), 0, 1e-8) << k;
      EXPECT_NEAR(q.velocities[2 * k + d], p.velocities[2 * k + d], 1e-7) << k;
      if (std::abs(x) > period / 2) ++across;
    }
    EXPECT_GE(p.positions[2 * k], -1);
    EXPECT_LT(p.positions[2 * k], 11);
    EXPECT_GE(p.positions[2 * k + 1], 2);
    EXPECT_LT(p.positions[2 * k + 1], 13);
  }
  EXPECT_GT(across, 5U);
}

TEST(PeriodicSimulation, KeepsMomentumAndGapsAcrossTheSides) {
  auto simulation = lively_discs({});
  const Vector before = momentum(simulation.state().particles);
  std::size_t glued_across = 0;
  run(simulation, 4, [&](const StepReport& report) {
    ASSERT_TRUE(report.converged);
    ASSERT_LT(largest_overlap(simulation.setting(), simulation.state()), 2e-6);
    for (const auto& pair : simulation.state().pairs)
      if (pair.gamma < 0 && pair.image != 0) ++glued_across;
  });
  EXPECT_LT(norm(momentum(simulation.state().particles) - before), 1e-12);
  EXPECT_GT(glued_across, 10U);
}

/// lively_discs() in three dimensions.
Simulation lively_spheres(const Vector& shift, const std::array<bool, 3>& periodic) {
  Setting setting;
  setting.domain = BoxDomain{shift, Vector{7, 8, 7.5} + shift, periodic};
  setting.laws.film.gamma_min = -0.5;
  setting.time_step = 0.02;
  Random random(12);
  State state = random_cloud(
      3, 120, 5, [&] { return random.uniform(0.4, 0.6); }, random);
  auto& p = state.particles;
  for (std::size_t k = 0; k < p.count(); ++k)
    for (std::size_t d = 0; d < 3; ++d) {
      p.positions[3 * k + d] += 3.5 + shift[d];
      p.velocities[3 * k + d] = random.uniform(-1, 1);
    }
  return {setting, state, 2};
}

TEST(PeriodicSimulation, DoesNotSeeTheSidesOfACuboid) {
  const Vector shift = {2.5, 3.25, 1.75}, periods = {7, 8, 7.5};
  auto here = lively_spheres({}, {true, true, true});
  // The same places in a cell that begins elsewhere: other particles are at its sides.
  auto setting = here.setting();
  setting.domain = BoxDomain{shift, periods + shift, {true, true, true}};
  Simulation there(setting, here.state(), 1);
  const Vector momentum_before = momentum(here.state().particles);
  std::set<std::int32_t> glued_across;
  run(here, 1, [&](const StepReport& report) {
    ASSERT_TRUE(report.converged);
    ASSERT_LT(largest_overlap(here.setting(), here.state()), 2e-6);
    for (const auto& pair : here.state().pairs)
      if (pair.gamma < 0 && pair.image != 0) glued_across.insert(pair.image);
  });
  run(there, 1);
  const auto &p = here.state().particles, &q = there.state().particles;
  std::array<std::size_t, 3> across{};
  for (std::size_t i = 0; i < p.positions.size(); ++i) {
    const auto d = i % 3;
    const double x = q.positions[i] - p.positions[i];
    EXPECT_NEAR(std::remainder(x, periods[d]), 0, 1e-12);
    EXPECT_NEAR(q.velocities[i], p.velocities[i], 1e-12);
    if (std::abs(x) > periods[d] / 2) ++across[d];
    EXPECT_GE(p.positions[i], 0);
    EXPECT_LT(p.positions[i], periods[d]);
  }
  for (const auto count : across) EXPECT_GT(count, 5U);
  EXPECT_GE(glued_across.size(), 2U);
  EXPECT_LT(norm(momentum(p) - momentum_before), 1e-12);
}

TEST(PeriodicSimulation, SpheresStayBetweenTheWallsOfACuboid) {
  auto simulation = lively_spheres({1, 2, 3}, {true, false, true});
  run(simulation, 4, [&](const StepReport& report) { ASSERT_TRUE(report.converged); });
  const auto& p = simulation.state().particles;
  std::size_t at_walls = 0;
  for (std::size_t k = 0; k < p.count(); ++k) {
    const double below = p.positions[3 * k + 1] - p.radii[k] - 2;
    const double above = 10 - p.positions[3 * k + 1] - p.radii[k];
    EXPECT_GT(std::min(below, above), -1e-6);
    at_walls += std::min(below, above) < 1e-6 ? 1U : 0U;
  }
  EXPECT_GT(at_walls, 5U);
}

/// Two discs that are pressed together, fly across a side and are pulled apart there: the film
/// keeps its gamma when the positions are wrapped, first those of one disc, then of the other.
TEST(PeriodicSimulation, KeepsGammaWithThePair) {
  Setting setting;
  setting.domain = box(20, 20, true, false);
  setting.laws.film.gamma_min = -100;
  setting.time_step = 0.25;
  State state = no_particles(2);
  add_particle(state, {15, 10, 0}, 1, 1, {2, 0, 0});
  add_particle(state, {17.5, 10, 0}, 1, 1, {1, 0, 0});
  Simulation simulation(setting, state, 1);
  std::set<std::int32_t> images;
  run(simulation, 6, [&](const StepReport&) {
    const auto& pairs = simulation.state().pairs;
    ASSERT_EQ(pairs.size(), 1U);
    if (simulation.state().time < 0.6) return;
    images.insert(pairs[0].image);
    EXPECT_NEAR(pairs[0].gamma, -0.5, 1e-9);  // half of the relative momentum
    EXPECT_NEAR(contacts_of(simulation.setting(), simulation.state()).at(0).gap, 0, 1e-12);
  });
  EXPECT_THAT(images, ::testing::ElementsAre(0, 1));
  EXPECT_NEAR(simulation.state().particles.positions[0], 15 + 1.5 * 6 - 20 + 0.25, 0.3);
}

TEST(PeriodicSimulation, TwoImagesOfOneParticleTouchAnother) {
  // A disc lies on the floor, and another one falls between it and its image.
  Setting setting;
  setting.domain = box(4.2, 50, true, false);
  setting.laws.film.gamma_min = 0;
  setting.gravity = {0, -1, 0};
  setting.time_step = 0.05;
  State state = no_particles(2);
  add_particle(state, {0, 3.2, 0}, 1.2, 1);
  add_particle(state, {2.1, 6, 0}, 1.2, 1);
  Simulation simulation(setting, state, 1);
  run(simulation, 20, [&](const StepReport& report) { ASSERT_TRUE(report.converged); });
  const auto& s = simulation.state();
  ASSERT_EQ(std::ranges::count_if(s.pairs, [](const Pair& pair) { return pair.impulse > 0; }), 2);
  // Each of the two contacts carries half of the weight h m g of the upper disc along the vertical.
  const double height = std::sqrt(2.4 * 2.4 - 2.1 * 2.1);
  EXPECT_NEAR(s.particles.positions[3] - s.particles.positions[1], height, 1e-5);
  for (const auto& pair : s.pairs) {
    if (pair.impulse > 0) {
      EXPECT_NEAR(pair.impulse, 0.05 / 2 * 2.4 / height, 1e-6);
    }
  }
}

TEST(PeriodicSimulation, ContinuesFromARestartWithTheSameBits) {
  auto whole = lively_discs({});
  run(whole, 2);
  auto half = lively_discs({});
  run(half, 1);
  TemporaryFolder folder;
  const auto file = folder.file("restart.bin", write_restart(half.state()));
  const auto state = read_restart(file);
  EXPECT_EQ(state.pairs, half.state().pairs);
  EXPECT_TRUE(std::ranges::any_of(state.pairs, [](const Pair& pair) { return pair.image != 0; }));
  Simulation rest(whole.setting(), state, 1);
  run(rest, 2);
  EXPECT_EQ(write_restart(rest.state()), write_restart(whole.state()));
}

TEST(PeriodicSimulation, RefusesStepsOfHalfAPeriod) {
  auto simulation = lively_discs({});
  auto setting = simulation.setting();
  setting.time_step = 10;
  Simulation fast(setting, simulation.state(), 1);
  EXPECT_THAT(failure(ErrorKind::kNotConverged, [&] { fast.step(1e300); }), Names("period of 11"));
}

TEST(Wrapping, ChangesImagesSoThatSeparationsStay) {
  State state = no_particles(2);
  add_particle(state, {10.75, 5, 0}, 1, 1);
  add_particle(state, {-0.75, 5, 0}, 1, 1);
  state.particles.cell = cell_of(box(12, 9, true, true));
  state.pairs = {{0, 1, -2, 0.5, 1e-3, 1}};
  state.positions_at_listing = {10, 5, -1, 5};
  const auto before = separation<2>(state.particles, 0, 1, 1);
  state.particles.positions[0] += 0.5;
  state.particles.positions[2] += 0.5;
  wrap_into_cell(state);
  EXPECT_EQ(state.particles.positions[0], -0.75);
  EXPECT_EQ(state.positions_at_listing, (std::vector<double>{-2, 5, -1, 5}));
  EXPECT_EQ(state.pairs[0], (Pair{0, 1, -2, 0.5, 1e-3, 0}));
  EXPECT_EQ(separation<2>(state.particles, 0, 1, 0), before);
}

}  // namespace
}  // namespace viscontact::particles
