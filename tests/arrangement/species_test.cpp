// Drawn radii: their moments, shares of species, masses, and bits.
#include "viscontact/arrangement/species.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "viscontact/common/hash/sha256.hpp"

namespace viscontact::particles {
namespace {

using ::testing::ElementsAre;
using Kind = RadiusDistribution::Kind;

constexpr std::size_t kDraws = 100000;

std::vector<double> radii_of(const RadiusDistribution& radius, std::size_t count = kDraws) {
  std::vector<double> radii;
  for (const auto& particle : drawn(DrawnSpecies({{.radius = radius, .mass = 1}}, 3, 1), count))
    radii.push_back(particle.radius);
  return radii;
}

/// Mean of f over the numbers.
template <class F>
double mean_of(const std::vector<double>& numbers, const F& f) {
  double sum = 0;
  for (const double x : numbers) sum += f(x);
  return sum / static_cast<double>(numbers.size());
}

// 1e5 draws have moments within 1 %: the standard error of the worst, the fourth moment about the
// mean, is about 0.5 % with these distributions.
TEST(Species, UniformRadiiHaveTheirMoments) {
  const auto radii = radii_of({.kind = Kind::kUniform, .from = 0.5, .to = 2});
  const double mean = 1.25, variance = 1.5 * 1.5 / 12, fourth = std::pow(1.5, 4) / 80;
  EXPECT_NEAR(mean_of(radii, [](double r) { return r; }) / mean, 1, 0.01);
  EXPECT_NEAR(mean_of(radii, [&](double r) { return std::pow(r - mean, 2); }) / variance, 1, 0.01);
  EXPECT_NEAR(mean_of(radii, [&](double r) { return std::pow(r - mean, 4); }) / fourth, 1, 0.01);
  for (const double r : radii) ASSERT_TRUE(0.5 <= r && r < 2);
}

TEST(Species, LognormalRadiiHaveTheirMoments) {
  const double median = 1.2, sigma = 0.1;
  const auto radii = radii_of({.kind = Kind::kLognormal, .median = median, .sigma = sigma});
  for (const int power : {1, 2, 3})
    EXPECT_NEAR(mean_of(radii, [&](double r) { return std::pow(r, power); }) /
                    (std::pow(median, power) * std::exp(0.5 * std::pow(power * sigma, 2))),
                1, 0.01)
        << power;
  const auto of_log = [&](double r) { return std::log(r / median) / sigma; };
  EXPECT_NEAR(mean_of(radii, of_log), 0, 0.01);
  EXPECT_NEAR(mean_of(radii, [&](double r) { return std::pow(of_log(r), 2); }), 1, 0.01);
  EXPECT_NEAR(mean_of(radii, [&](double r) { return std::pow(of_log(r), 3); }), 0, 0.03);
  // The standard error of the fourth moment of a normal distribution is sqrt(96/1e5) = 0.031.
  EXPECT_NEAR(mean_of(radii, [&](double r) { return std::pow(of_log(r), 4); }), 3, 0.1);
}

TEST(Species, RadiiHaveTheSameBitsOnEveryMachine) {
  const auto hash = [](const std::vector<double>& x) {
    return sha256({reinterpret_cast<const char*>(x.data()), x.size() * sizeof(double)});
  };
  EXPECT_EQ(hash(radii_of({.kind = Kind::kUniform, .from = 0.5, .to = 2}, 1000)),
            "b862260ac655869bda4de811a92fb3f94a80200ac8b09197a363ff6eb12cf380");
  EXPECT_EQ(hash(radii_of({.kind = Kind::kLognormal, .median = 1.2, .sigma = 0.4}, 1000)),
            "8ecdfa11a63e28164b74e8dca8f53aadbe815bd571415b88353840d14a09febb");
}

TEST(Species, RadiiOfAListAreTakenInTurn) {
  EXPECT_THAT(radii_of({.list = {1, 3, 2}}, 5), ElementsAre(1, 3, 2, 1, 3));
}

TEST(Species, HaveTheirSharesAmongTheFirstOnesToo) {
  const std::vector<Species> species = {{.radius = {.list = {1}}, .share = 3, .mass = 1},
                                        {.radius = {.list = {2}}, .share = 2, .mass = 1},
                                        {.radius = {.list = {3}}, .share = 1, .mass = 1}};
  DrawnSpecies all(species, 2, 1);
  std::array<int, 4> counts{};
  for (int n = 1; n <= 600; ++n) {
    ++counts[static_cast<std::size_t>(all.next().radius)];
    EXPECT_LT(std::abs(counts[1] - n / 2.0), 1) << n;
    EXPECT_LT(std::abs(counts[2] - n / 3.0), 1) << n;
    EXPECT_LT(std::abs(counts[3] - n / 6.0), 1) << n;
  }
}

TEST(Species, HaveTheirSharesRoundedUpOrDownWhateverTheyAre) {
  // The rule that takes the species with the largest lag fails with these, after 55 particles.
  for (const auto& shares : {std::vector<double>{29, 1, 7, 1, 27, 5, 27, 1},
                             {1, 1e-9, 0.3, 0.3, 1e3},
                             {1, 1, 1, 1, 1, 1, 1}}) {
    std::vector<Species> species;
    double sum = 0;
    for (const double share : shares) {
      const auto number = static_cast<double>(species.size() + 1);
      species.push_back({.radius = {.list = {number}}, .share = share, .mass = 1});
      sum += share;
    }
    DrawnSpecies all(species, 2, 1);
    std::vector<int> counts(shares.size());
    for (int n = 1; n <= 1000; ++n) {
      ++counts.at(static_cast<std::size_t>(all.next().radius) - 1);
      for (std::size_t s = 0; s < shares.size(); ++s)
        ASSERT_LT(std::abs(counts[s] - n * shares[s] / sum), 1) << n << " " << s;
    }
  }
}

TEST(Species, HashIsOfAllThatDecidesRadiiAndMasses) {
  const Species one = {.radius = {.list = {1, 2}}, .share = 2, .mass = 3};
  auto other = one;
  EXPECT_EQ(hash_of({one}), hash_of({other}));
  const auto differs = [&](const Species& species) {
    return hash_of({species}) != hash_of({one}) &&
           hash_of({one, species}) != hash_of({species, one});
  };
  other.radius.list = {1, 2.5};
  EXPECT_TRUE(differs(other));
  other = one;
  other.radius.sigma = 0.5;
  EXPECT_TRUE(differs(other));
  other = one;
  other.share = 1;
  EXPECT_TRUE(differs(other));
  other = one;
  other.density = 1;
  EXPECT_TRUE(differs(other));
  EXPECT_NE(hash_of({one, one}), hash_of({one}));
}

TEST(Species, DensityGivesTheMass) {
  const std::vector<Species> species = {{.radius = {.list = {2}}, .density = 3}};
  EXPECT_NEAR(DrawnSpecies(species, 2, 1).next().mass, 12 * std::numbers::pi, 1e-12);
  EXPECT_NEAR(DrawnSpecies(species, 3, 1).next().mass, 32 * std::numbers::pi, 1e-12);
}

TEST(Species, NumberIsTheNearestToTheSize) {
  const DrawnSpecies species({{.radius = {.list = {1}}}}, 2, 1);
  const auto count = [&](double size) { return drawn_to_size(species, 2, size, 1000).size(); };
  EXPECT_EQ(count(200), 64U);  // 63.66
  EXPECT_EQ(count(120), 38U);  // 38.20
  EXPECT_EQ(count(1e-6), 1U);
  EXPECT_EQ(count(1e9), 1000U);
}

}  // namespace
}  // namespace viscontact::particles
