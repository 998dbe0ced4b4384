// What holds of every motion without a time step, whatever the sphere, the fluid and the force.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "tests/common/failure.hpp"
#include "tests/reduced_model/cases.hpp"
#include "viscontact/reduced_model/models/contact/viscous_contact_exact.hpp"
#include "viscontact/reduced_model/models/inertial.hpp"
#include "viscontact/reduced_model/models/reference.hpp"

namespace viscontact::reduced_model {
namespace {

constexpr int kCases = 10'000;
constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

/// Drag k/q in every other case, the exact drag of a sphere of radius 1 in the others.
lubrication::LubricationForce force_of(int i, double k) {
  return i % 2 == 0 ? lubrication::LubricationForce(leading_term_fit(k))
                    : lubrication::LubricationForce::exact_plane(k / (6 * std::numbers::pi), 1);
}

TEST(RandomMotions, OfTheEventDrivenContactObeyTheContactLaw) {
  std::mt19937_64 generator(1);
  int contacts = 0, solids = 0;
  for (int i = 0; i < kCases; ++i) {
    const auto [motion, k] = random_case(generator);
    SCOPED_TRACE(i);
    const double solid_gap = motion.roughness[0] + motion.roughness[1];
    const double gamma_min = solid_gap > 0
                                 ? std::min(0.0, k * std::log(solid_gap / motion.initial_gap))
                                 : -std::numeric_limits<double>::infinity();
    const auto trajectory =
        simulate_viscous_contact_exact(motion, lubrication::LubricationForce(leading_term_fit(k)));
    double impulse_scale = motion.mass * std::abs(motion.initial_velocity);
    for (std::size_t n = 0; n < trajectory.rows.size(); ++n) {
      const auto& row = trajectory.rows[n];
      EXPECT_TRUE(std::isfinite(row.gap) && std::isfinite(row.velocity) &&
                  std::isfinite(*row.gamma));
      EXPECT_GE(row.gap, 0);
      EXPECT_LE(*row.gamma, 0);
      EXPECT_GE(*row.gamma, gamma_min);
      EXPECT_EQ(row.gap * *row.gamma, 0);
      if (n > 0) {
        EXPECT_GT(row.time, trajectory.rows[n - 1].time);
      }
      impulse_scale = std::max(impulse_scale, std::abs(motion.external_force.impulse(row.time)));
    }
    const auto& budget = trajectory.budget.value();
    const double gained = motion.mass * (trajectory.rows.back().velocity - motion.initial_velocity);
    // A few roundings of the largest impulse for each event.
    const double round_off =
        kEpsilon * 64 * impulse_scale * static_cast<double>(trajectory.steps + 1);
    EXPECT_NEAR(budget.external_impulse + budget.film_impulse + budget.solid_impulse, gained,
                round_off);
    EXPECT_GE(budget.solid_impulse, -round_off);
    contacts += trajectory.contact_interval ? 1 : 0;
    solids += budget.solid_impulse > round_off ? 1 : 0;
    if (HasFailure()) return;
  }
  EXPECT_GT(contacts, kCases / 2);
  EXPECT_GT(solids, kCases / 10);
}

/// Masses and viscosities over ten decades each; pushes and a start that the film can absorb within
/// the numbers of a double, 200 k at most.
RandomCase resolvable_case(std::mt19937_64& generator) {
  auto [motion, k] = random_case(generator);
  const auto uniform = [&](double from, double to) {
    return std::uniform_real_distribution(from, to)(generator);
  };
  std::vector<ExternalForce::Piece> pieces;
  const int count = std::uniform_int_distribution(1, 6)(generator);
  for (int j = 1; j <= count; ++j)
    pieces.push_back(
        {10.0 * j / count, k * std::pow(10, uniform(-2, 1.3)) * (uniform(0, 1) < 0.6 ? -1 : 1)});
  motion.external_force = ExternalForce(pieces);
  if (uniform(0, 3) < 1)
    motion.external_force += ExternalForce::sinusoidal(
        {k * uniform(0, 20), std::pow(10, uniform(-1, 1)), uniform(0, 6)});
  motion.initial_velocity = uniform(-1, 1) * std::min(3.0, 20 * k / motion.mass);
  return {motion, k};
}

TEST(RandomMotions, WithInertiaKeepTheFirstIntegralAndNeverTouch) {
  constexpr int kMotions = kCases / 10;  // far slower than the other models
  std::mt19937_64 generator(2);
  int thin = 0;
  for (int i = 0; i < kMotions; ++i) {
    const auto [motion, k] = resolvable_case(generator);
    SCOPED_TRACE(::testing::Message() << i << ": m = " << motion.mass << ", k = " << k);
    const lubrication::LubricationForce force = force_of(i, k);
    const Trajectory trajectory = simulate_inertial(motion, force);
    const double start = motion.mass * motion.initial_velocity + force.impulse(motion.initial_gap);
    for (std::size_t n = 0; n < trajectory.rows.size(); ++n) {
      const auto& row = trajectory.rows[n];
      EXPECT_TRUE(std::isfinite(row.gap) && std::isfinite(row.velocity));
      EXPECT_GT(row.gap, 0);
      if (n > 0) {
        EXPECT_GT(row.time, trajectory.rows[n - 1].time);
      }
      const double momentum = start + motion.external_force.impulse(row.time);
      // ln q to ten times its tolerance moves Gamma by R q times that; the rest is rounding.
      const double allowed =
          1e-8 * force.resistance(row.gap) * row.gap +
          64 * kEpsilon * (std::abs(momentum) + std::abs(force.impulse(row.gap)));
      EXPECT_NEAR(motion.mass * row.velocity + force.impulse(row.gap), momentum, allowed)
          << row.time;
      thin += row.gap < 1e-6 ? 1 : 0;
    }
    if (HasFailure()) return;
  }
  EXPECT_GT(thin, kMotions);
}

TEST(RandomMotions, WithoutInertiaAreReversible) {
  // The force backwards and with the other sign brings the sphere back the way it came: q(2T - t) =
  // q(t).
  std::mt19937_64 generator(3);
  std::uniform_real_distribution uniform(0.0, 1.0);
  for (int i = 0; i < kCases; ++i) {
    const double k = std::pow(10, 10 * uniform(generator) - 5);
    const lubrication::LubricationForce force = force_of(i, k);
    std::vector<ExternalForce::Piece> there, back;
    const int count = 1 + i % 6;
    for (int j = 0; j < count; ++j)
      there.push_back({static_cast<double>(j + 1), k * 20 * (uniform(generator) - 0.5)});
    auto both = there;
    for (int j = 0; j < count; ++j)
      both.push_back({static_cast<double>(count + j + 1),
                      -there[static_cast<std::size_t>(count - 1 - j)].value});
    Motion motion{1, std::pow(10, 2 * uniform(generator) - 1), 0, 2.0 * count, ExternalForce(both)};
    motion.set(kReferenceTimeStep, 0.25);
    const auto rows = simulate_reference_exact(motion, force).rows;
    ASSERT_EQ(rows.size() % 2, 1U);
    for (std::size_t n = 0; n < rows.size() / 2; ++n) {
      const auto& mirrored = rows[rows.size() - 1 - n];
      // Impulses of up to 60 k are off by some roundings; over R q >= k that is the relative error
      // of the gap. So is the rounding of ln q, up to 60.
      EXPECT_NEAR(mirrored.gap / rows[n].gap, 1, 2e-13) << i << ", t = " << rows[n].time;
    }
    if (HasFailure()) return;
  }
}

}  // namespace
}  // namespace viscontact::reduced_model
