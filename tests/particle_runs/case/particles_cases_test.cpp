// The shipped cases of many particles show what their titles and docs/particles.md say.
#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "viscontact/contact_dynamics/simulation.hpp"
#include "viscontact/particle_runs/case/particles_case.hpp"
#include "viscontact/particles/steps/current_contacts.hpp"

namespace viscontact::particles {
namespace {

using particles::operator-;  // NOLINT(misc-unused-using-decls): clang-tidy overlooks operators
using ::testing::ElementsAre;

/// A shipped case, run step by step; no step may miss the tolerance.
class ShippedRun {
 public:
  explicit ShippedRun(const std::string& name)
      : case_(read_particles_case(std::filesystem::path(VISCONTACT_SOURCE_FOLDER) /
                                  "data/cases/particles" / (name + ".toml"))),
        simulation_(case_.setting, start(case_), 1) {}

  /// Calls `look` after each step.
  template <class Look>
  void to(double time, const Look& look) {
    while (simulation_.state().time < time - 1e-6 * case_.setting.time_step) {
      const auto report = simulation_.step(time);
      ASSERT_TRUE(report.converged) << "t = " << report.time;
      look();
    }
  }
  void to(double time) {
    to(time, [] {});
  }
  template <class Look>
  void to_end(const Look& look) {
    to(case_.end_time, look);
  }
  void to_end() { to(case_.end_time); }

  const ParticlesCase& of() const { return case_; }
  double time() const { return simulation_.state().time; }
  const Particles& now() const { return simulation_.state().particles; }
  std::vector<CurrentContact> contacts() const {
    return contacts_of(case_.setting, simulation_.state());
  }
  double overlap() const { return largest_overlap(case_.setting, simulation_.state()); }
  double kinetic_energy() const {
    double energy = 0;
    for (std::size_t k = 0; k < now().count(); ++k)
      energy += 0.5 * now().masses[k] * dot(now().velocity(k), now().velocity(k));
    return energy;
  }
  auto films() const {
    // Films whose gamma is not the rounding errors that a spent film may leave between particles
    // that move on together: the impulses that they have taken here are about 1.
    constexpr double kRounding = 1e-12;
    return std::ranges::count_if(contacts(),
                                 [](const CurrentContact& c) { return c.gamma < -kRounding; });
  }

 private:
  static State start(const ParticlesCase& c) {
    State state;
    state.particles = c.particles;
    return state;
  }

  ParticlesCase case_;
  Simulation simulation_;
};

/// The particles that films join to a particle, it included.
std::set<std::int32_t> glued_to(std::int32_t particle,
                                const std::vector<CurrentContact>& contacts) {
  std::set<std::int32_t> group = {particle};
  for (std::size_t before = 0; before != group.size();) {
    before = group.size();
    for (const auto& c : contacts)
      if (c.gamma < 0 && c.first >= 0 && (group.contains(c.first) || group.contains(c.second)))
        group.insert({c.first, c.second});
  }
  return group;
}

/// Energy of discs under gravity 1.
double fallen(const Particles& from, const Particles& to) {
  double energy = 0;
  for (std::size_t k = 0; k < to.count(); ++k)
    energy += to.masses[k] * (from.positions[2 * k + 1] - to.positions[2 * k + 1]);
  return energy;
}

TEST(Raft, RemembersThePushAndComesApartWhenThePullHasGivenItBack) {
  constexpr std::size_t kRows = 5, kColumns = 8;
  ShippedRun raft("raft");
  const auto start = raft.now().positions;
  const double tolerance = raft.of().setting.solver.tolerance;
  raft.to(4);
  auto films = raft.contacts();
  std::erase_if(films, [](const CurrentContact& c) { return !(c.gamma < 0); });
  ASSERT_EQ(films.size(), kRows * (kColumns - 1));
  // A film's impulse is solved for to the tolerance over h, with masses and mean radius 1; 200
  // steps of it may add up.
  for (const auto& film : films) EXPECT_NEAR(film.gamma, -4, 200 * tolerance / 0.02);
  raft.to(7.9);
  EXPECT_EQ(raft.films(), static_cast<std::ptrdiff_t>(films.size()));
  raft.to_end();
  EXPECT_EQ(raft.films(), 0);
  // Columns first close the gaps of 0.05 between them, towards the middle; the ends leave at t = 8
  // with acceleration 1, which the scheme, of the first order, integrates to t (t + h)/2.
  const double h = raft.of().setting.time_step, t = 11 - 8, left = t * (t + h) / 2;
  for (std::size_t k = 0; k < kRows * kColumns; ++k) {
    const auto column = k % kColumns;
    double moved = 0.05 * (3.5 - static_cast<double>(column));
    if (column == 0) moved -= left;
    if (column == kColumns - 1) moved += left;
    // The push holds gaps at the tolerance, in any of 7 films.
    EXPECT_NEAR(raft.now().positions[2 * k] - start[2 * k], moved, 10 * tolerance) << "disc " << k;
  }
}

TEST(Billiards, BallCollectsSevenOthersAndCarriesThemToTheCushion) {
  ShippedRun billiards("billiards");
  billiards.to_end();
  EXPECT_THAT(glued_to(0, billiards.contacts()), ElementsAre(0, 5, 9, 12, 22, 30, 31, 35));
  // Along the cushion at the right they glide.
  EXPECT_TRUE(std::ranges::any_of(billiards.contacts(), [](const CurrentContact& c) {
    return c.first == -2 && c.second == 9 && c.gamma < 0;
  }));
  EXPECT_NEAR(billiards.now().velocity(9)[0], 0, 1e-5);
}

TEST(BilliardBreak, FilmsHoldTheRackTogetherAndWithoutThemItParts) {
  ShippedRun viscous("billiard_break_viscous"), inelastic("billiard_break_inelastic");
  EXPECT_EQ(viscous.now().positions, inelastic.now().positions);
  EXPECT_EQ(viscous.now().velocities, inelastic.now().velocities);
  std::ptrdiff_t most = 0;
  inelastic.to_end([&] { most = std::max(most, inelastic.films()); });
  EXPECT_EQ(most, 0);
  viscous.to_end();
  EXPECT_GT(viscous.films(), 0);
}

TEST(Lottery, BallsHangFromTheWallsThatPressedThem) {
  ShippedRun lottery("lottery");
  bool overhead = false;
  lottery.to_end([&] {
    const auto& planes = lottery.of().setting.planes;
    for (const auto& c : lottery.contacts())
      overhead =
          overhead ||
          (c.first < 0 && c.gamma < 0 &&
           planes[static_cast<std::size_t>(-1 - c.first)].at(lottery.time()).normal[2] < -0.5);
  });
  EXPECT_TRUE(overhead);
  EXPECT_LE(lottery.overlap(), lottery.of().setting.solver.tolerance);
}

TEST(LotteryWithFriction, WallsTurnTheBallsAndCarryThemUp) {
  ShippedRun lottery("lottery_friction");
  bool slides = false, sticks = false;
  // In a quarter of the runs with slightly different starts a step is solved only at a second try.
  lottery.to_end([&] {
    for (const auto& c : lottery.contacts()) {
      slides = slides || c.friction == ContactFriction::kSlides;
      sticks = sticks || c.friction == ContactFriction::kSticks;
    }
  });
  EXPECT_TRUE(slides && sticks);
  EXPECT_LE(lottery.overlap(), lottery.of().setting.solver.tolerance);
  const auto& spins = lottery.now().angular_velocities;
  EXPECT_TRUE(std::ranges::any_of(spins, [](double w) { return std::abs(w) > 0.1; }));
}

TEST(Heap, RoughDiscsComeToRestInAHeapOnTheFloorThatHingesHold) {
  ShippedRun heap("heap");
  const auto start = heap.now();
  heap.to(14);
  const auto now = heap.now();
  double highest = 0;
  for (std::size_t k = 0; k < now.count(); ++k) {
    if (k < 100)
      EXPECT_LT(norm(now.position(k) - start.position(k)), 1e-5) << k;
    else
      highest = std::max(highest, now.position(k)[1]);
  }
  // A heap of slope 0, 300 discs of area pi/4 on a length of 100, would be 3 high.
  EXPECT_GT(highest, 6);
  // Single discs still roll down the slopes. Rounding errors decide which ones: 20 heaps with
  // starts that differ by 1e-9 have 0.011 to 0.021 of the energy of their fall.
  EXPECT_LT(heap.kinetic_energy(), 3e-2 * fallen(start, now));
}

TEST(Catapult, ThrowsADiscAndTheHoistLiftsItsLoad) {
  ShippedRun catapult("catapult");
  double highest = 0;
  catapult.to_end([&] {
    const auto& p = catapult.now();
    highest = std::max(highest, p.position(8)[1]);
    EXPECT_NEAR(norm(p.position(3) - Vector{0, 4, 0}), 0, 1e-9) << catapult.time();
    const double length =
        catapult.time() < 2 ? 10 : std::max(4.0, 10 - 1.5 * (catapult.time() - 2));
    EXPECT_NEAR(norm(p.position(10) - p.position(9)), length, 1e-9) << catapult.time();
  });
  EXPECT_GT(highest, 9);
  // The load hangs about the length 3.5 + m g/k below the end of the arm.
  EXPECT_NEAR(catapult.now().position(11)[1], 16 - 4 - (3.5 + 2.0 / 4), 1);
}

TEST(Shapes, ComeToRestInTheBox) {
  ShippedRun run("shapes");
  run.to_end();
  // Of a potential energy of 50 at the start; its tolerances let a load creep.
  EXPECT_LT(run.kinetic_energy(), 1e-6);
  EXPECT_LT(run.overlap(), run.of().setting.solver.tolerance);
  double on_floor = 0, weight = 0;
  for (const double mass : run.now().masses) weight += mass;  // gravity is 1
  for (const auto& contact : run.contacts())
    if (contact.first < 0)
      on_floor += contact.normal_force * contact.normal[1] + contact.tangential_force[1];
  EXPECT_NEAR(on_floor, weight, 1e-4 * weight);
}

TEST(RockingEllipses, HaveTheirPeriods) {
  ShippedRun run("rocking_ellipses");
  std::array<std::vector<double>, 2> passages;
  std::array<double, 2> before{0.1, 0.1};
  run.to_end([&] {
    for (std::size_t k = 0; k < 2; ++k) {
      const double now = run.now().angles[2 * k];
      if (now * before[k] < 0) passages[k].push_back(run.time());
      before[k] = now;
    }
  });
  // Found to a step of 0.01.
  ASSERT_GE(passages[0].size(), 3U);
  ASSERT_GE(passages[1].size(), 3U);
  EXPECT_NEAR(passages[0][2] - passages[0][0], 5.56, 0.02);
  EXPECT_NEAR(passages[1][2] - passages[1][0], 9.50, 0.02);
}

TEST(Settling, DiscsLoseTheEnergyOfTheirFallInTheBox) {
  ShippedRun settling("settling");
  const auto start = settling.now();
  settling.to_end();
  EXPECT_LE(settling.overlap(), settling.of().setting.solver.tolerance);
  // Without friction small ones roll on for long: 0.001 to 0.1 were seen, of 1577.
  EXPECT_LT(settling.kinetic_energy(), 1e-3 * fallen(start, settling.now()));
}

}  // namespace
}  // namespace viscontact::particles
