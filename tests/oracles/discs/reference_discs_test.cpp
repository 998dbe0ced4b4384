// data/reference/discs.csv: a third of it is computed anew by both methods, and its values are
// compared with closed forms and published ones.
#include "tests/oracles/discs/reference_discs.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <string>
#include <vector>

namespace viscontact {
namespace {

using std::numbers::pi;

/// A case has n digits if the two methods differ by less than 10^-n. A third of this lies between
/// what another compiler rounds to; the file was written by one of the two.
double bound(const ReferenceDiscs& found) { return 3 * std::pow(10, -found.digits); }

/// Every third case of a domain is solved again. The program discs_reference solves all.
void expect_both_methods(DiscDomain2d domain, int at_least) {
  int cases = 0;
  for (const auto& found : read_reference_discs(VISCONTACT_SOURCE_FOLDER)) {
    if (found.problem.domain != domain) continue;
    EXPECT_GE(found.digits, 10) << found.name;
    if (cases++ % 3 != 0) continue;
    EXPECT_LT(difference(found.problem, found.answer, solved_by_collocation(found.problem)),
              bound(found))
        << found.name;
    EXPECT_LT(difference(found.problem, found.answer, solved_by_boundary_integral(found.problem)),
              bound(found))
        << found.name;
  }
  EXPECT_GE(cases, at_least);
}

double added(const std::string& name) {
  return reference_discs(VISCONTACT_SOURCE_FOLDER, name).answer.added_dissipation;
}
std::complex<double> velocity(const std::string& name) {
  return reference_discs(VISCONTACT_SOURCE_FOLDER, name).answer.velocities.at(0);
}

TEST(ReferenceDiscs, AreThoseOfBothMethodsInARoundContainer) {
  expect_both_methods(DiscDomain2d::kRoundContainer, 14);
}

TEST(ReferenceDiscs, AreThoseOfBothMethodsInAChannel) {
  expect_both_methods(DiscDomain2d::kChannel, 11);
}

TEST(ReferenceDiscs, AreThoseOfBothMethodsInASquareCell) {
  expect_both_methods(DiscDomain2d::kSquareCell, 18);
}

TEST(ReferenceDiscs, AtTheCentreOfAContainerAreTheClosedForms) {
  constexpr double kRounding = 1e-13;
  EXPECT_NEAR(velocity("centre, force").real(), (std::log(5.0) - 24.0 / 26) / (4 * pi), kRounding);
  EXPECT_NEAR(reference_discs(VISCONTACT_SOURCE_FOLDER, "centre, torque").answer.spins.at(0),
              (1 - 1.0 / 25) / (4 * pi), kRounding);
  const double phi = 1.0 / 16;
  EXPECT_NEAR(added("centre, strained"), 2 * phi * (1 + phi + phi * phi) / std::pow(1 - phi, 3),
              kRounding);
}

// One disc in a cell of the lattice: drag over viscosity and mean velocity of Sangani & Acrivos
// 1982, Int. J. Multiphase Flow 8, 193, which has four digits.
TEST(ReferenceDiscs, OfALatticeHaveThePublishedDrag) {
  EXPECT_NEAR(1 / velocity("lattice 0.1, force").real(), 24.83, 5e-3);
  EXPECT_NEAR(1 / velocity("lattice 0.3, force").real(), 102.90, 2e-4 * 102.90);
}

TEST(ReferenceDiscs, OfADiluteLatticeAddTwiceTheAreaFraction) {
  // What differs is of second order in phi = 0.05 with opposite signs for the two strains.
  EXPECT_NEAR((added("lattice 0.05, axes") + added("lattice 0.05, diagonals")) / 2, 0.1, 7e-3);
}

// By symmetry a moved domain, and other units, give the same.
TEST(ReferenceDiscs, DoNotDependOnUnitsAndOrientation) {
  auto found = reference_discs(VISCONTACT_SOURCE_FOLDER, "off the centre, across");
  const double unit = 2.5;
  const std::complex<double> turn = std::polar(1.0, 0.7);
  auto turned = found.problem;
  turned.size *= unit;
  for (auto& disc : turned.discs) {
    disc.centre *= unit * turn;
    disc.radius *= unit;
    disc.force *= turn;
  }
  for (const auto& answer : {solved_by_collocation(turned), solved_by_boundary_integral(turned)}) {
    EXPECT_LT(std::abs(answer.velocities[0] - turn * found.answer.velocities[0]), 1e-13);
    EXPECT_NEAR(answer.spins[0], found.answer.spins[0] / unit, 1e-13);
  }
}

}  // namespace
}  // namespace viscontact
