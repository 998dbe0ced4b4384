// Many spheres at once against the same spheres one by one, to the bit.
#include "reduced_model/viscous_contact_many.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <random>

#include "common/error.hpp"
#include "reduced_model/contact_model.hpp"
#include "reduced_model/contact_step.hpp"
#include "reduced_model/motion.hpp"
#include "tests/reduced_model/cases.hpp"

namespace viscontact {
namespace {

using testing::HasSubstr;

constexpr double kSmooth = -std::numeric_limits<double>::infinity();
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// The vectors of the results, named.
struct Column {
  const char* name;
  std::vector<double> ManyContacts::*values;
};
constexpr Column kColumns[] = {{"minimal_gap", &ManyContacts::minimal_gap},
                               {"minimal_gap_time", &ManyContacts::minimal_gap_time},
                               {"lowest_gamma", &ManyContacts::lowest_gamma},
                               {"first_contact", &ManyContacts::first_contact},
                               {"last_contact", &ManyContacts::last_contact},
                               {"gap", &ManyContacts::gap},
                               {"velocity", &ManyContacts::velocity},
                               {"gamma", &ManyContacts::gamma}};

void add(ManySpheres& spheres, double mass, double gap, double velocity, double gamma_min,
         double force_scale) {
  spheres.mass.push_back(mass);
  spheres.initial_gap.push_back(gap);
  spheres.initial_velocity.push_back(velocity);
  spheres.gamma_min.push_back(gamma_min);
  spheres.force_scale.push_back(force_scale);
}

/// What happens in the steps of one_by_one, so that a test can say that everything does.
struct Events {
  int landings = 0, releases = 0, on_solid = 0, held_at_zero_force = 0;
};

/// The loop of contact_model.cpp, sphere by sphere, with what ManyContacts holds.
ManyContacts one_by_one(const ManySpheres& spheres, const ExternalForce& force,
                        const ManySpheresRun& run, Events* events = nullptr) {
  ManyContacts all;
  const double end = run.end_time, h = run.time_step;
  const int steps = step_count(end, h);
  for (std::size_t i = 0; i < spheres.mass.size(); ++i) {
    const double mass = spheres.mass[i], gamma_min = spheres.gamma_min[i];
    ContactSetting setting(mass, gamma_min, h);
    ContactState state{spheres.initial_gap[i], spheres.initial_velocity[i], 0};
    double minimal_gap = state.gap, minimal_gap_time = 0, lowest_gamma = 0;
    double from = kNaN, until = kNaN;
    for (int n = 0; n < steps; ++n) {
      const double t = step_time(n, steps, end, h);
      const double next = step_time(n + 1, steps, end, h);
      if (n + 1 == steps) setting = ContactSetting(mass, gamma_min, next - t);
      const double push = setting.step * (spheres.force_scale[i] * force.mean(t, next));
      const auto before = state;
      const auto step = contact_step(state, push, setting, NoDrag());
      state = step.state;
      if (state.gap < minimal_gap) {
        minimal_gap = state.gap;
        minimal_gap_time = next;
      }
      if (state.gap == 0) {
        if (std::isnan(from)) from = next;
        until = next;
      }
      lowest_gamma = std::min(lowest_gamma, state.gamma);
      if (events) {
        events->landings += before.gap > 0 && state.gap == 0;
        events->releases += before.gamma < 0 && state.gamma == 0;
        events->on_solid += step.solid > 0;
        events->held_at_zero_force += before.gamma < 0 && push == 0;
      }
    }
    const double values[] = {minimal_gap, minimal_gap_time, lowest_gamma,   from,
                             until,       state.gap,        state.velocity, state.gamma};
    for (std::size_t c = 0; c < std::size(kColumns); ++c)
      (all.*kColumns[c].values).push_back(values[c]);
  }
  return all;
}

/// A NaN is "none", whatever its bits; the sign of a 0 counts.
bool same(double a, double b) {
  return std::isnan(a) ? std::isnan(b)
                       : std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

void expect_same(const ManyContacts& got, const ManyContacts& expected) {
  for (const auto& column : kColumns) {
    SCOPED_TRACE(column.name);
    const auto& a = got.*column.values;
    const auto& b = expected.*column.values;
    ASSERT_EQ(a.size(), b.size());
    int different = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
      if (!same(a[i], b[i]) && ++different <= 3)
        ADD_FAILURE() << "sphere " << i << ": " << a[i] << " instead of " << b[i];
    EXPECT_EQ(different, 0);
  }
}

/// Every instruction set that runs here.
void expect_same_as_one_by_one(const ManySpheres& spheres, const ExternalForce& force,
                               ManySpheresRun run, Events* events = nullptr) {
  const auto expected = one_by_one(spheres, force, run, events);
  for (const auto set : runnable_instruction_sets()) {
    SCOPED_TRACE(name_of(set));
    run.instruction_set = set;
    expect_same(simulate_viscous_contact_many(spheres, force, run), expected);
  }
}

/// Masses over ten decades, gaps and velocities that let a sphere land in a few units of time under a force of about 1 per mass; smooth, rough,
/// barely rough, without film.
ManySpheres random_spheres(std::size_t count, unsigned seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> uniform(0, 1);
  ManySpheres spheres;
  for (std::size_t i = 0; i < count; ++i) {
    const double mass = std::pow(10, 10 * uniform(random) - 5);
    const double gamma_mins[] = {kSmooth, -mass * uniform(random), -1e-9 * mass, 0.0};
    const double scales[] = {mass * (0.2 + 2 * uniform(random)), mass, -mass, 1.0, 0.0};
    add(spheres, mass, std::pow(10, 3 * uniform(random) - 3), 2 * uniform(random) - 1.2,
        gamma_mins[i % 4], scales[random() % 5]);
  }
  return spheres;
}

/// Pushes and pulls, with jumps, slopes and a stretch of exactly 0.
ExternalForce jumping_force() {
  return ExternalForce(
      {{0.73, -1}, {1.1, 0}, {1.6, -2, {1.5, -0.3}}, {2.4, 3}, {3.1, -1.5}, {5, 2}});
}

ExternalForce shaking_force() {
  auto force = ExternalForce::sinusoidal({2, 7.3, 0.4});
  force += ExternalForce::sinusoidal({0.7, 31, 2});
  force += ExternalForce({{1.5, -0.5}, {4, 0.25}});
  return force;
}

TEST(ManySpheres, AreThoseOneByOneToTheBit) {
  const auto spheres = random_spheres(4000, 1);
  // A last step that is shorter, one that is not but for round-off, and a step longer than the whole.
  const ManySpheresRun runs[] = {{4, 0.0137, 2}, {3.3, 0.01, 2}, {0.9, 2, 1}};
  Events events;
  for (const auto& force : {jumping_force(), shaking_force()})
    for (const auto& run : runs) {
      SCOPED_TRACE(run.time_step);
      expect_same_as_one_by_one(spheres, force, run, &events);
    }
  EXPECT_GT(events.landings, 1000);
  EXPECT_GT(events.releases, 1000);
  EXPECT_GT(events.on_solid, 1000);
  EXPECT_GT(events.held_at_zero_force, 1000);
}

TEST(ManySpheres, AreTheSameHoweverManyThereAre) {
  const auto force = jumping_force();
  for (std::size_t count = 0; count <= 40; ++count) {
    SCOPED_TRACE(count);
    expect_same_as_one_by_one(random_spheres(count, static_cast<unsigned>(count)), force,
                              {4, 0.05, 1});
  }
  // Around the ends of chunks.
  for (const std::size_t count : {255U, 256U, 257U, 511U, 513U}) {
    SCOPED_TRACE(count);
    expect_same_as_one_by_one(random_spheres(count, 7), force, {4, 0.05, 2});
  }
}

TEST(ManySpheres, AreTheSameHoweverManyThreadsThereAre) {
  const auto spheres = random_spheres(3000, 2);
  const auto force = shaking_force();
  const auto expected = simulate_viscous_contact_many(spheres, force, {4, 0.01, 1});
  for (const int threads : {2, 3, 8, 100}) {
    SCOPED_TRACE(threads);
    expect_same(simulate_viscous_contact_many(spheres, force, {4, 0.01, threads}), expected);
  }
}

TEST(ManySpheres, GoOnWhereABlockOfStepsEnds) {
  // Steps are prepared some thousand at a time: numbers of steps around multiples of 1024.
  const auto spheres = random_spheres(300, 3);
  const auto force = jumping_force();
  for (const int steps : {1023, 1024, 1025, 2048, 5000}) {
    SCOPED_TRACE(steps);
    expect_same_as_one_by_one(spheres, force, {4, 4.0 / steps, 2});
  }
}

TEST(ManySpheres, KeepTheSignOfZero) {
  ManySpheres spheres;
  for (const double gamma_min : {kSmooth, -0.125, 0.0, -0.0})
    for (const double velocity : {0.0, -0.0, -1.0, -4.0, 1.0})
      for (const double scale : {0.0, -0.0, 1.0, -1.0})
        for (const double gap : {0.5, 1.0}) add(spheres, 1, gap, velocity, gamma_min, scale);
  // Dyadic numbers: gaps, momenta and gammas meet 0 exactly, with forces of 0 and of -0.
  for (const auto& force :
       {ExternalForce({{1, 0}}), ExternalForce({{1, -0.0}}), ExternalForce({{2, -1}, {3, 1}}),
        ExternalForce({{1, -1}, {2, 0}, {3, 1}, {4, 0}}),
        ExternalForce({{1, -1}, {2, 1}, {3, -0.0}, {4, -1}})})
    for (const double end : {0.25, 1.5, 2.0, 2.25, 4.0}) {
      SCOPED_TRACE(end);
      expect_same_as_one_by_one(spheres, force, {end, 0.25, 1});
    }
}

TEST(ManySpheres, AreTheSameWhereRoundOffDecidesOnContact) {
  // They arrive at the end of the first step, give or take some last digits: there, contact by the momentum and a gap above 0 go together.
  // (h times 1/h is less than 1 for this h.)
  constexpr double kStep = 49.0 / 512;
  const auto random = random_spheres(1000, 5);
  ManySpheres spheres;
  int both = 0;
  for (std::size_t i = 0; i < random.mass.size(); ++i) {
    const double mass = random.mass[i], gap = random.initial_gap[i];
    double velocity = -gap / kStep;
    for (int digit = 0; digit < 3; ++digit) velocity = std::nextafter(velocity, 0);
    for (int digit = -3; digit <= 3; ++digit, velocity = std::nextafter(velocity, kSmooth)) {
      add(spheres, mass, gap, velocity, random.gamma_min[i], 0);
      const ContactSetting setting(mass, kSmooth, kStep);
      const auto state = contact_step({gap, velocity, 0}, 0, setting, NoDrag()).state;
      both += state.gamma < 0 && gap + kStep * (mass * velocity * setting.per_mass) > 0;
    }
  }
  EXPECT_GT(both, 30);
  expect_same_as_one_by_one(spheres, jumping_force(), {3 * kStep, kStep, 1});
}

TEST(ManySpheres, KeepSubnormalNumbers) {
  ManySpheres spheres;
  for (const double gap : {1e-310, 1e-300, 1e-160})
    for (const double velocity : {0.0, -1e-300, -1e-310, 1e-315})
      for (const double gamma_min : {kSmooth, -1e-312, 0.0})
        add(spheres, 1, gap, velocity, gamma_min, 1e-305);
  expect_same_as_one_by_one(spheres, jumping_force(), {4, 0.01, 1});
}

TEST(ManySpheres, AreThoseOfTheModelOfOne) {
  for (auto motion : {lecture_motion(), limit_motion()})
    for (const double gamma_min : {kSmooth, -40.0, -0.5, 0.0}) {
      motion.contact_time_step = 1.7e-3;
      ContactModel model;
      model.gamma_min = gamma_min;
      const auto one = run_contact_model(motion, model);
      ManySpheres spheres;
      add(spheres, motion.mass, motion.initial_gap, motion.initial_velocity, gamma_min, 1);
      const auto many = simulate_viscous_contact_many(
          spheres, motion.external_force, {motion.end_time, motion.contact_time_step, 1});
      const auto& last = one.rows.back();
      EXPECT_TRUE(same(many.gap[0], last.gap));
      EXPECT_TRUE(same(many.velocity[0], last.velocity));
      EXPECT_TRUE(same(many.gamma[0], *last.gamma));
      const auto& lowest = lowest_row(one);
      EXPECT_EQ(many.minimal_gap[0], lowest.gap);
      EXPECT_EQ(many.minimal_gap_time[0], lowest.time);
      // One looks into the steps of impact and release, the other does not.
      ASSERT_TRUE(one.contact_interval);
      const double h = motion.contact_time_step;
      EXPECT_GE(many.first_contact[0], (*one.contact_interval)[0]);
      EXPECT_LE(many.first_contact[0], (*one.contact_interval)[0] + h);
      EXPECT_LE(many.last_contact[0], (*one.contact_interval)[1]);
      EXPECT_GE(many.last_contact[0], (*one.contact_interval)[1] - h);
    }
}

TEST(ManySpheres, SayWhenThereIsNoContact) {
  ManySpheres spheres;
  add(spheres, 1, 0.5, 0.25, kSmooth, 1);  // away from the start: the start is the lowest
  add(spheres, 1, 8, -1, kSmooth, 1);      // turns at 6 at time 2
  const auto contacts =
      simulate_viscous_contact_many(spheres, ExternalForce({{4, 0}, {5, 1}}), {6, 0.5, 1});
  EXPECT_EQ(contacts.minimal_gap[0], 0.5);
  EXPECT_EQ(contacts.minimal_gap_time[0], 0);
  EXPECT_GT(contacts.minimal_gap[1], 3);
  for (const std::size_t i : {0U, 1U}) {
    EXPECT_TRUE(std::isnan(contacts.first_contact[i]));
    EXPECT_TRUE(std::isnan(contacts.last_contact[i]));
    EXPECT_EQ(contacts.lowest_gamma[i], 0);
  }
}

TEST(ManySpheres, CanBeNone) {
  EXPECT_TRUE(simulate_viscous_contact_many({}, jumping_force(), {1, 0.1, 2}).gap.empty());
}

void expect_refused(const ManySpheres& spheres, const ManySpheresRun& run, const char* message) {
  try {
    simulate_viscous_contact_many(spheres, jumping_force(), run);
    ADD_FAILURE() << "nothing thrown instead of: " << message;
  } catch (const Error& error) {
    EXPECT_EQ(error.exit_code(), ExitCode::kBadInput);
    EXPECT_THAT(error.what(), HasSubstr(message));
  }
}

TEST(ManySpheres, RefuseVectorsOfOtherLengths) {
  using Member = std::vector<double> ManySpheres::*;
  for (const Member member : {&ManySpheres::initial_gap, &ManySpheres::initial_velocity,
                              &ManySpheres::gamma_min, &ManySpheres::force_scale}) {
    auto spheres = random_spheres(5, 4);
    (spheres.*member).pop_back();
    expect_refused(spheres, {1, 0.1, 1}, "is given for 4 spheres and mass for 5");
  }
}

TEST(ManySpheres, RefuseValuesOutOfRange) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const auto refused = [](std::vector<double> ManySpheres::*member, double value,
                          const char* message) {
    auto spheres = random_spheres(5, 4);
    (spheres.*member)[3] = value;
    expect_refused(spheres, {1, 0.1, 1}, message);
  };
  refused(&ManySpheres::mass, 0, "mass[3] is 0; it must be > 0");
  refused(&ManySpheres::mass, kNaN, "mass[3] is nan");
  refused(&ManySpheres::mass, kInfinity, "mass[3] is inf");
  refused(&ManySpheres::initial_gap, 0, "initial_gap[3] is 0; it must be > 0");
  refused(&ManySpheres::initial_gap, kInfinity, "initial_gap[3] is inf");
  refused(&ManySpheres::initial_velocity, kNaN, "initial_velocity[3] is nan; it must be finite");
  refused(&ManySpheres::gamma_min, 0.5, "gamma_min[3] is 0.5; it must be <= 0");
  refused(&ManySpheres::gamma_min, kNaN, "gamma_min[3] is nan");
  refused(&ManySpheres::force_scale, -kInfinity, "force_scale[3] is -inf; it must be finite");
}

TEST(ManySpheres, RefuseARunOutOfRange) {
  const auto spheres = random_spheres(5, 4);
  expect_refused(spheres, {0, 0.1, 1}, "end_time is 0");
  expect_refused(spheres, {kNaN, 0.1, 1}, "end_time is nan");
  expect_refused(spheres, {1, -0.1, 1}, "time_step is -0.1");
  expect_refused(spheres, {1, 0.1, 0}, "threads is 0; it must be >= 1");
  expect_refused(spheres, {1, 1e-9, 1}, "steps");
}

}  // namespace
}  // namespace viscontact
