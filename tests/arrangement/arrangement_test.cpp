// Random arrangements: their gaps, their count, their bits, and what does not fit.
#include "viscontact/arrangement/arrangement.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <cstddef>
#include <numbers>
#include <tuple>
#include <vector>

#include "tests/common/failure.hpp"
#include "viscontact/arrangement/species.hpp"
#include "viscontact/common/hash/sha256.hpp"

namespace viscontact::particles {
namespace {

constexpr double kGap = 0.05;

std::vector<double> equal(std::size_t count) { return std::vector<double>(count, 1); }

/// As many radii of 1 as cover about this fraction of the domain.
std::vector<double> covering(double fraction, const Domain& domain) {
  return equal(static_cast<std::size_t>(
      std::max(1.0, std::round(fraction * measure(domain) / std::numbers::pi))));
}

double shortest(double difference, double period) {
  return period > 0 ? std::remainder(difference, period) : difference;
}

/// The smallest gap of two discs of radius 1, across periodic sides too.
double smallest_gap(const std::vector<double>& x, const Domain& domain) {
  const auto periods = periods_of(domain);
  double gap = 1e300;
  for (std::size_t i = 0; i < x.size(); i += 2)
    for (std::size_t j = 0; j < i; j += 2)
      gap = std::min(gap, std::hypot(shortest(x[i] - x[j], periods[0]),
                                     shortest(x[i + 1] - x[j + 1], periods[1])) -
                              2);
  return gap;
}

/// The smallest gap of a disc of radius 1 and a wall; large if there is no wall.
double smallest_gap_to_walls(const std::vector<double>& x, const Domain& domain) {
  double gap = 1e300;
  for (std::size_t i = 0; i < x.size(); i += 2) {
    if (const auto* disc = std::get_if<DiscDomain>(&domain)) {
      gap = std::min(
          gap, disc->radius - 1 - std::hypot(x[i] - disc->centre[0], x[i + 1] - disc->centre[1]));
      continue;
    }
    const auto& box = std::get<BoxDomain>(domain);
    for (const std::size_t d : {0U, 1U}) {
      EXPECT_GE(x[i + d], box.from[d]);
      EXPECT_LE(x[i + d], box.to[d]);
      if (!box.periodic[d])
        gap = std::min({gap, x[i + d] - box.from[d] - 1, box.to[d] - x[i + d] - 1});
    }
  }
  return gap;
}

const std::vector<Domain>& domains() {
  static const std::vector<Domain> all = {
      BoxDomain{{-3, 5}, {17, 25}, {true, true}}, BoxDomain{{0, 0}, {30, 14}, {true, false}},
      BoxDomain{{0, 0}, {20, 20}, {false, false}}, DiscDomain{{2, -1}, 10},
      BoxDomain{{0, 0}, {5, 5}, {true, true}}};
  return all;
}

TEST(Arrangement, HasItsGapsInEachDomainUpToTheAreaFraction06) {
  for (const auto& domain : domains())
    for (const double fraction : {0.02, 0.3, 0.5, 0.6})
      for (const std::uint64_t seed : {1U, 2U, 3U}) {
        const auto radii = covering(fraction, domain);
        const auto x = arrange({radii, kGap, seed}, domain, {});
        ASSERT_EQ(x.size(), 2 * radii.size());
        // The test computes distances in another order, with other rounding errors.
        EXPECT_GE(smallest_gap(x, domain), kGap - 1e-13) << fraction << " " << seed;
        EXPECT_GE(smallest_gap_to_walls(x, domain), kGap - 1e-13) << fraction << " " << seed;
      }
}

// In these dense cells the last push of a round moved a disc too close to one whose turn was over.
TEST(Arrangement, HasItsGapsAfterTheLastPush) {
  for (const auto& [width, height, count] : {std::tuple{3.508, 13.461, 11}, {3.832, 13.517, 13}}) {
    const BoxDomain cell{{0, 0}, {width, height}, {true, true}};
    const auto x = arrange({equal(static_cast<std::size_t>(count)), kGap, 1}, cell, {});
    EXPECT_GE(smallest_gap(x, cell), kGap - 1e-13) << count;
  }
}

TEST(Arrangement, IsDecidedByItsSeed) {
  const auto& domain = domains()[0];
  const auto one = arrange({equal(64), kGap, 1}, domain, {});
  EXPECT_EQ(arrange({equal(64), kGap, 1}, domain, {}), one);
  EXPECT_NE(arrange({equal(64), kGap, 2}, domain, {}), one);
}

TEST(Arrangement, HasTheSameBitsOnEveryMachine) {
  const auto x = arrange({equal(64), kGap, 1}, domains()[0], {});
  EXPECT_EQ(sha256({reinterpret_cast<const char*>(x.data()), x.size() * sizeof(double)}),
            "e66ec1fb135deca48cf7587e436930724ff0e6af2557178f6d13409944d9390f");
}

TEST(Arrangement, LeavesTheGapsToPresentParticles) {
  const auto& domain = domains()[3];
  Particles present;
  present.positions = {2, -1};
  present.radii = {5};
  const auto x = arrange({equal(25), kGap, 1}, domain, present);
  for (std::size_t i = 0; i < x.size(); i += 2)
    EXPECT_GE(std::hypot(x[i] - 2, x[i + 1] + 1), 6 + kGap - 1e-13);
  EXPECT_GE(smallest_gap(x, domain), kGap - 1e-13);
}

/// The smallest gap of two spheres or discs of these radii, across periodic sides too, and of one
/// and a wall of the box.
double smallest_gap_in_box(const std::vector<double>& x, const std::vector<double>& radii,
                           const BoxDomain& box) {
  const auto n = box.dimension();
  const auto periods = periods_of(box);
  double gap = 1e300;
  for (std::size_t i = 0; i < radii.size(); ++i)
    for (std::size_t d = 0; d < n; ++d)
      if (!box.periodic[d])
        gap = std::min(
            {gap, x[n * i + d] - box.from[d] - radii[i], box.to[d] - x[n * i + d] - radii[i]});
  for (std::size_t i = 0; i < radii.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      Vector apart{};
      for (std::size_t d = 0; d < n; ++d)
        apart[d] = shortest(x[n * i + d] - x[n * j + d], periods[d]);
      gap = std::min(gap, norm(apart) - radii[i] - radii[j]);
    }
  return gap;
}

TEST(Arrangement, OfSeveralSizesHasItsGapsInTwoAndThreeDimensions) {
  const DrawnSpecies species(
      {{.radius = {.kind = RadiusDistribution::Kind::kLognormal, .median = 1, .sigma = 0.3}},
       {.radius = {.list = {0.5, 2}}, .share = 0.5}},
      3, 7);
  for (const auto& box : {BoxDomain{{-3, 5}, {40, 45}, {true, true}},
                          BoxDomain{{0, 0, 1}, {20, 18, 24}, {true, true, false}},
                          BoxDomain{{0, 0, 0}, {18, 18, 18}, {true, true, true}},
                          BoxDomain{{0, 0, 0}, {18, 19, 20}, {}}}) {
    const bool is_flat = box.dimension() == 2;
    Arrangement asked{.radii = {}, .smallest_gap = kGap, .seed = 3};
    for (const auto& particle :
         drawn_to_size(species, is_flat ? 2 : 3, (is_flat ? 0.6 : 0.4) * measure(box), 10000))
      asked.radii.push_back(particle.radius);
    const auto x = arrange(asked, box, {});
    ASSERT_EQ(x.size(), box.dimension() * asked.radii.size());
    EXPECT_GE(smallest_gap_in_box(x, asked.radii, box), kGap - 1e-13);
    const double share = size_of(asked, is_flat ? 2 : 3) / measure(box);
    EXPECT_NEAR(share, is_flat ? 0.6 : 0.4, 0.01);
  }
}

TEST(Arrangement, OfSpheresHasTheSameBitsOnEveryMachine) {
  const BoxDomain box{{0, 0, 0}, {10, 10, 10}, {true, true, false}};
  Arrangement asked{.radii = {}, .smallest_gap = kGap, .seed = 1};
  const DrawnSpecies species(
      {{.radius = {.kind = RadiusDistribution::Kind::kLognormal, .median = 1, .sigma = 0.1}}}, 3,
      1);
  for (const auto& particle : drawn(species, 50)) asked.radii.push_back(particle.radius);
  const auto x = arrange(asked, box, {});
  EXPECT_EQ(sha256({reinterpret_cast<const char*>(x.data()), x.size() * sizeof(double)}),
            "ccb48cd13deaa444664b26d251939807acea6a6c137edacd21627a74276fb909");
}

BoxDomain periodic_cube(double length) {
  return {{0, 0, 0}, {length, length, length}, {true, true, true}};
}

// Pushes do not find these arrangements.
TEST(Arrangement, OfDenseSpheresHasItsGapsAndTheSameBitsOnEveryMachine) {
  const auto dense = periodic_cube(9.967);  // a fraction of 0.6346
  const auto x = arrange({equal(150), 0, 1}, dense, {});
  EXPECT_GE(smallest_gap_in_box(x, equal(150), dense), -1e-13);
  EXPECT_EQ(sha256({reinterpret_cast<const char*>(x.data()), x.size() * sizeof(double)}),
            "d515311828d49007d2e3396a9ac738bf5c9102892e0329076a9c5398d2d677f6");
  // The gap makes spheres of 0.62 as dense as ones without gaps of 0.63.
  const auto looser = periodic_cube(10.045);
  EXPECT_GE(smallest_gap_in_box(arrange({equal(150), 0.01, 1}, looser, {}), equal(150), looser),
            0.01 - 1e-13);
}

TEST(Arrangement, OfTooManySpheresNamesTheFractionThatIsReached) {
  const auto error = bad_input([] { arrange({equal(100), 0, 1}, periodic_cube(8.425), {}); });
  EXPECT_THAT(error, AllOf(Names("0.7005"), Names("0.6362")));
}

TEST(Arrangement, IsUniformInAPeriodicBox) {
  // Each quarter of a periodic box has a quarter of all centres on average. The number of 64 discs
  // in a quarter varies by less than that of independent points, sqrt(64 * 3/16) = 3.5; the mean
  // over 100 seeds is therefore within 4 * 0.35 of 16.
  const Domain box = BoxDomain{{0, 0}, {20, 20}, {true, true}};
  double first = 0;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    const auto x = arrange({equal(64), kGap, seed}, box, {});
    for (std::size_t i = 0; i < x.size(); i += 2) first += x[i] < 10 && x[i + 1] < 10 ? 1 : 0;
  }
  EXPECT_NEAR(first / 100, 16, 1.4);
}

TEST(Arrangement, OfTwoDiscsHasAllPlacesEquallyOften) {
  // Two discs in a periodic box: all places with a gap are equally likely, so the share of seeds in
  // which the centres are closer than s is (s^2 - d^2) pi/(A - pi d^2), d = 2.05. At s = 4, A = 100
  // it is 0.427; 1000 seeds give it with the standard deviation 0.016.
  const Domain box = BoxDomain{{0, 0}, {10, 10}, {true, true}};
  int close = 0;
  for (std::uint64_t seed = 0; seed < 1000; ++seed)
    close += smallest_gap(arrange({equal(2), kGap, seed}, box, {}), box) < 2 ? 1 : 0;
  const double pi = std::numbers::pi;
  EXPECT_NEAR(close / 1000.0, (16 - 2.05 * 2.05) * pi / (100 - pi * 2.05 * 2.05), 4 * 0.016);
}

TEST(Arrangement, WhatDoesNotFitIsRefused) {
  const auto refused = [](const Arrangement& asked, const Domain& domain) {
    return bad_input([&] { arrange(asked, domain, {}); });
  };
  const Domain box = BoxDomain{{0, 0}, {20, 20}, {}};
  EXPECT_THAT(refused({equal(110), kGap, 1}, box), Names("110"));
  EXPECT_THAT(refused({equal(95), 0, 1}, BoxDomain{{0, 0}, {2.1, 180}, {}}), Names("95"));
  EXPECT_THAT(refused({equal(1), kGap, 1}, DiscDomain{{}, 1.04}), Names("domain"));
  EXPECT_THAT(refused({equal(1), kGap, 1}, BoxDomain{{0, 0}, {2.04, 9}, {true, true}}),
              Names("period"));
}

TEST(Arrangement, TheDefaultGapLeavesRoomForRandomPackings) {
  const auto covered = [](double gap) {
    return 500 * 4 * std::numbers::pi / 3 * std::pow(1 + gap / 2, 3);
  };
  const auto spheres = equal(500);
  EXPECT_EQ(default_gap(spheres, 3, covered(0) / 0.5), kGap);
  for (const double fraction : {0.56, 0.6, 0.62, 0.634}) {
    const double size = covered(0) / fraction, gap = default_gap(spheres, 3, size);
    // Radii and gap are of order one, so that rounding errors are some 1e-16.
    EXPECT_NEAR(covered(gap) / size, (fraction + 0.635) / 2, 1e-14) << fraction;
    EXPECT_LT(gap, kGap);
  }
  EXPECT_EQ(default_gap(spheres, 3, covered(0) / 0.64), 0);
}

}  // namespace
}  // namespace viscontact::particles
