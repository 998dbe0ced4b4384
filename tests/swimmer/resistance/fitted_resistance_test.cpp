// The parts of a fit of resistance matrices: lubrication of pairs, polynomials on a grid, the fit's
// file and its evaluation.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <numbers>

#include "tests/common/failure.hpp"
#include "tests/common/temporary_folder.hpp"
#include "tests/oracles/bispherical/bispherical.hpp"
#include "tests/oracles/exact_resistance_table.hpp"
#include "viscontact/swimmer/fit/fit_resistance.hpp"
#include "viscontact/swimmer/resistance/resistance_fit.hpp"
#include "viscontact/swimmer/resistance/resistance_table.hpp"

namespace viscontact::swimmer {
namespace {

TEST(PairLubrication, IsTheSingularPartOfTheExactResistance) {
  // What is left of X11A has a limit at contact: from one gap to the next the change is that of
  // gap ln(gap) without the third term, and smaller with it.
  const double stokes = 6 * std::numbers::pi;
  for (const double ratio : {1.0, 2.0, 0.3}) {
    const auto rest = [&](double gap, int terms) {
      return stokes * two_sphere_drag_factor(gap, ratio, 0) -
             pair_lubrication(1, ratio, gap, terms);
    };
    EXPECT_NEAR(rest(1e-5, 2), rest(1e-6, 2), 5e-3) << ratio;
    EXPECT_NEAR(rest(1e-5, 3), rest(1e-6, 3), 5e-4) << ratio;
    EXPECT_GT(std::abs(rest(1e-5, 1) - rest(1e-6, 1)), 0.1) << ratio;
  }
}

TEST(PairLubrication, IsSymmetricInTheSpheresAndHasItsSlope) {
  for (const int terms : {1, 2, 3}) {
    EXPECT_NEAR(pair_lubrication(1, 3, 0.2, terms) / pair_lubrication(3, 1, 0.2, terms), 1, 1e-14);
    constexpr double kStep = 1e-6;  // rounding 1e-10, curvature 1e-9
    const double difference =
        (pair_lubrication(1, 3, 0.2 + kStep, terms) - pair_lubrication(1, 3, 0.2 - kStep, terms)) /
        (2 * kStep);
    EXPECT_NEAR(pair_lubrication_slope(1, 3, 0.2, terms) / difference, 1, 1e-7);
  }
}

TEST(TensorPolynomial, ReproducesPolynomialsWithTheirDerivatives) {
  const std::vector<Eigen::VectorXd> nodes = {Eigen::Vector3d(0, 0.3, 1),
                                              Eigen::Vector4d(-1, 0, 0.7, 2)};
  const auto f = [](double x, double y) { return (1 + x - 2 * x * x) * (y * y * y - y + 0.5); };
  Eigen::MatrixXd values(1, 12);
  for (Eigen::Index i = 0; i < 3; ++i)
    for (Eigen::Index j = 0; j < 4; ++j) values(0, 4 * i + j) = f(nodes[0][i], nodes[1][j]);
  const TensorPolynomial polynomial(nodes, values);
  for (const auto& [x, y] : {std::pair(0.2, 1.1), std::pair(0.3, 0.7), std::pair(1.0, -1.0)}) {
    const auto at = polynomial(std::array{x, y});
    EXPECT_NEAR(at(0, 0), f(x, y), 1e-14);
    EXPECT_NEAR(at(0, 1), (1 - 4 * x) * (y * y * y - y + 0.5), 1e-13);
    EXPECT_NEAR(at(0, 2), (1 + x - 2 * x * x) * (3 * y * y - 1), 1e-13);
  }
}

TEST(FittedResistance, IsPositiveDefiniteEvenBetweenRowsThatContradictEachOther) {
  // Matrices whose logarithms jump from row to row: polynomials through them overshoot.
  ResistanceTable table;
  table.viscosity = 1;
  table.radii = {1, 1, 1};
  const auto arms = chebyshev_arms(2.1, 9, 5);
  int number = 0;
  for (const double x1 : arms)
    for (const double x2 : arms) {
      const double jump = number++ % 2 == 0 ? 1 : 1000;
      table.rows.push_back({{x1 - 2, x2 - 2}, {jump, 0, 0, 1, 0, 1 / jump}, {}, 0, 0, 0});
      table.rows.back().relative_error_estimates.assign(6, 0);
    }
  const auto fit = fit_resistance(table);
  const FittedResistance resistance(fit);
  for (double x1 = 0.1; x1 < 7; x1 += 0.37)
    for (double x2 = 0.1; x2 < 7; x2 += 0.37) {
      const auto r = resistance(std::array{x1, x2}).value;
      EXPECT_LT((r - r.transpose()).norm(), 1e-9 * r.norm());
      EXPECT_GT(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(r).eigenvalues().minCoeff(), 0);
    }
}

TEST(FittedResistance, FileReadsBackBitForBit) {
  const TemporaryFolder scratch;
  const auto fit = fit_resistance(exact_table({1, 2, 0.5}, 3.5, 9, 4));
  const auto path = scratch.path() / "fit.json";
  put_text(path, write_resistance_fit(fit));
  const auto again = read_resistance_fit(path);
  EXPECT_EQ(again.radii, fit.radii);
  EXPECT_EQ(again.gaps, fit.gaps);
  EXPECT_EQ(again.lubrication_terms, fit.lubrication_terms);
  EXPECT_EQ(again.largest_left_one_out_error, fit.largest_left_one_out_error);
  const std::array gaps = {1.0, 2.0};
  EXPECT_EQ(FittedResistance(again)(gaps).value, FittedResistance(fit)(gaps).value);
}

TEST(ScaledResistanceFit, HasTheResistancesOfTheSameGapsInRadii) {
  auto fit = fit_resistance(exact_table({1, 2, 0.5}, 3.5, 9, 4));
  fit.container = "closed cylinder, radius 40, height 80";
  const double ratio = 3e-6, viscosity = 1e-3;
  const auto scaled = scaled_to(fit, viscosity, {ratio, 2 * ratio, 0.5 * ratio});
  const auto expected = FittedResistance(fit)(std::array{1.0, 2.0}).value;
  const auto value = FittedResistance(scaled)(std::array{ratio, 2 * ratio}).value;
  EXPECT_LT((value / (viscosity / fit.viscosity * ratio) - expected).norm(),
            1e-12 * expected.norm());
  EXPECT_EQ(scaled.container,
            fmt::format("closed cylinder, radius {}, height {}", 40 * ratio, 80 * ratio));
  EXPECT_EQ(write_resistance_fit(scaled_to(fit, fit.viscosity, fit.radii)),
            write_resistance_fit(fit));
  EXPECT_THAT(bad_input([&] { (void)scaled_to(fit, 1, {1, 2, 0.6}); }), Names("1", "2", "0.5"));
}

TEST(FittedResistance, DamagedFileIsBadInputWithItsPlace) {
  const TemporaryFolder scratch;
  const auto path = scratch.path() / "fit.json";
  const auto text = write_resistance_fit(fit_resistance(exact_table({1, 1, 1}, 3, 9, 3)));
  const auto refusal = [&](const std::string& from, const std::string& to) {
    auto changed = text;
    changed.replace(changed.find(from), from.size(), to);
    put_text(path, changed);
    return bad_input([&] { (void)read_resistance_fit(path); });
  };
  EXPECT_THAT(refusal("\"viscosity\": 1.0", "\"viscosity\": -1.0"),
              IsAt("fit.json:3", "viscosity"));
  EXPECT_THAT(refusal("\"lubrication_terms\": ", "\"lubrication_terms\": 9"),
              IsAt("fit.json:10", "lubrication_terms"));
  EXPECT_THAT(refusal("\"gaps\"", "\"gabs\""), IsAt("fit.json:1", "gaps"));
  EXPECT_THAT(refusal("\"logarithms\": [\n  [", "\"logarithms\": [\n  [1,"),
              IsAt("fit.json:28", "logarithms"));
}

TEST(FittedResistance, OutsideTheTableIsAnErrorThatSaysWhatTheTableHas) {
  const FittedResistance resistance(fit_resistance(exact_table({1, 1, 1}, 3, 9, 3)));
  EXPECT_THAT(bad_input([&] {
                (void)resistance(std::array{2.0, 7.5});
              }),
              Names("2", "3", "7.5", "1"));
}

}  // namespace
}  // namespace viscontact::swimmer
