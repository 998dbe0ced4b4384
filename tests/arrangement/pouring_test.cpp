// Particles that are poured in: their times, places, and bits after a restart; and those that wait.
#include "viscontact/arrangement/pouring.hpp"

#include <gmock/gmock.h>

#include <algorithm>

#include "tests/common/temporary_folder.hpp"
#include "tests/particles/systems.hpp"
#include "viscontact/particle_runs/io/restart.hpp"
#include "viscontact/particles/steps/current_contacts.hpp"

namespace viscontact::particles {
namespace {

using ::testing::ElementsAre;

TEST(Source, ParticlesAreDueAtARateFromBeginToEnd) {
  Source source{.species = {}, .rate = 5, .begin = 1, .end = 3, .largest_count = 100};
  EXPECT_EQ(source.due(0.99), 0U);
  EXPECT_EQ(source.due(1), 1U);
  EXPECT_EQ(source.due(1.19), 1U);
  EXPECT_EQ(source.due(1 + 0.1 + 0.1), 2U);  // 1.2000000000000002, and below for other sums
  EXPECT_EQ(source.due(1.9999999999999998), 6U);
  EXPECT_EQ(source.due(3), 11U);
  EXPECT_EQ(source.due(9), 11U);
  source.largest_count = 4;
  EXPECT_EQ(source.due(9), 4U);
}

/// Discs or spheres of two species that fall on a floor in a box that is periodic along x.
Setting poured(int dimension, bool has_friction) {
  Setting setting;
  setting.domain = dimension == 2 ? BoxDomain{{0, 0}, {8, 30}, {true, false}}
                                  : BoxDomain{{0, 0, 0}, {6, 6, 30}, {true, true, false}};
  setting.gravity[dimension == 2 ? 1 : 2] = -1;
  setting.laws.film.gamma_min = -0.2;
  setting.time_step = 0.02;
  if (has_friction) setting.laws.friction = {.coefficient = 0.3};
  const Species small{
      .radius = {.kind = RadiusDistribution::Kind::kUniform, .from = 0.4, .to = 0.6},
      .share = 2,
      .density = 1};
  const Species large{.radius = {.list = {0.9}}, .share = 1, .density = 3};
  Source source{
      .species = {small, large}, .rate = 8, .begin = 0.5, .end = 4, .largest_count = 1000};
  source.from = dimension == 2 ? Vector{0, 20, 0} : Vector{0, 0, 20};
  source.to = dimension == 2 ? Vector{8, 25, 0} : Vector{6, 6, 25};
  source.velocity[dimension == 2 ? 1 : 2] = -2;
  setting.sources = {source};
  return setting;
}

State one_particle(int dimension) {
  State state = no_particles(dimension);
  add_particle(state, {3, 3, 1}, 0.5, 1);
  return state;
}

TEST(Source, PoursInWhatIsDueWithoutOverlap) {
  for (const int dimension : {2, 3})
    for (const bool has_friction : {false, true}) {
      Simulation simulation(poured(dimension, has_friction), one_particle(dimension), 1);
      const auto& p = simulation.state().particles;
      const double* places = p.positions.data();
      std::size_t before = p.count();
      run(simulation, 5, [&](const StepReport&) {
        ASSERT_EQ(p.count(), 1 + simulation.setting().sources[0].due(simulation.state().time));
        ASSERT_LT(largest_overlap(simulation.setting(), simulation.state()), 2e-6);
        const auto axis = static_cast<std::size_t>(dimension - 1);
        for (; before < p.count(); ++before) {
          EXPECT_GE(p.position(before)[axis], 20);
          EXPECT_LE(p.position(before)[axis], 25);
          EXPECT_EQ(p.velocity(before)[axis], -2);
        }
      });
      EXPECT_EQ(p.count(), 30U);  // and 29 = 8 * 3.5 + 1 poured in
      EXPECT_EQ(std::ranges::count(p.radii, 0.9), 10);
      EXPECT_EQ(p.positions.data(), places);
      EXPECT_EQ(p.turn(), has_friction);
      EXPECT_EQ(p.inertias.size(), has_friction ? p.count() : 0U);
    }
}

TEST(Source, ContinuesFromARestartWithTheSameBits) {
  for (const int dimension : {2, 3}) {
    const auto setting = poured(dimension, true);
    State start = one_particle(dimension);
    start.particles.ids = {17};
    Simulation whole(setting, start, 1);
    run(whole, 5);
    EXPECT_THAT(
        std::vector(whole.state().particles.ids.begin(), whole.state().particles.ids.begin() + 3),
        ElementsAre(17, 18, 19));
    Simulation half(setting, start, 1);
    run(half, 2.5);
    const TemporaryFolder folder;
    auto state = read_restart(folder.file("restart.bin", write_restart(half.state())));
    EXPECT_EQ(state.sources.at(0).poured, 17);
    state.particles.ids = start.particles.ids;
    add_missing_ids(state.particles);
    Simulation rest(setting, state, 1);
    run(rest, 5);
    EXPECT_EQ(write_restart(rest.state()), write_restart(whole.state()));
    EXPECT_EQ(rest.state().particles.ids, whole.state().particles.ids);
  }
}

TEST(Source, WaitsWhileItsRegionIsFull) {
  auto setting = poured(2, false);
  setting.gravity = {};
  auto& source = setting.sources[0];
  source.velocity = {};
  source.to = {8, 22, 0};
  source.rate = 1000;
  Simulation simulation(setting, one_particle(2), 1);
  run(simulation, 1);
  const auto& p = simulation.state().particles;
  // The region of 8 x 2 and the discs that reach out of it cover at most 8 x 3.8.
  double area = 0;
  for (const double radius : p.radii) area += round_shape(2, radius).measure();
  EXPECT_GT(p.count(), 6U);
  EXPECT_LT(area, 0.91 * 8 * 3.8);
  const auto poured = p.count() - 1;
  EXPECT_EQ(static_cast<std::size_t>(simulation.state().sources[0].poured), poured);
  const auto waiting = waiting_particles(setting.sources, simulation.state());
  ASSERT_EQ(waiting.size(), 1U);
  EXPECT_EQ(waiting[0].source, 0U);
  EXPECT_EQ(waiting[0].count, 501 - poured);  // 1000 * 0.5 + 1 are due
  const auto radii = drawn(DrawnSpecies(source.species, 2, source.seed), poured + 1);
  EXPECT_EQ(waiting[0].radius, radii.back().radius);
  EXPECT_LT(largest_overlap(simulation.setting(), simulation.state()), 1e-12);
}

TEST(Source, MayBeginWithoutParticles) {
  for (const double begin : {0.0, 0.5}) {
    auto setting = poured(2, true);
    setting.sources[0].begin = begin;
    Simulation simulation(setting, no_particles(2), 1);
    EXPECT_EQ(simulation.state().particles.count(), begin == 0 ? 1U : 0U);
    run(simulation, 1);
    EXPECT_EQ(simulation.state().particles.count(), begin == 0 ? 9U : 5U);
    EXPECT_TRUE(waiting_particles(setting.sources, simulation.state()).empty());
  }
}

TEST(Source, ThatIsNewInARunThatContinuesHasNoArrears) {
  auto setting = poured(2, false);
  const auto sources = std::move(setting.sources);
  setting.sources.clear();
  Simulation first(setting, one_particle(2), 1);
  run(first, 2);
  setting.sources = sources;  // from 0.5 on, at the rate 8
  Simulation whole(setting, first.state(), 1);
  run(whole, 3);
  EXPECT_EQ(whole.state().sources.at(0).begin, 2);
  EXPECT_EQ(whole.state().sources.at(0).begin_of_case, 0.5);
  EXPECT_EQ(whole.state().particles.count(), 1U + 9U);
  // The same if the second run is interrupted.
  Simulation half(setting, first.state(), 1);
  run(half, 2.5);
  const TemporaryFolder folder;
  Simulation rest(setting, read_restart(folder.file("r.bin", write_restart(half.state()))), 1);
  run(rest, 3);
  EXPECT_EQ(write_restart(rest.state()), write_restart(whole.state()));
}

}  // namespace
}  // namespace viscontact::particles
