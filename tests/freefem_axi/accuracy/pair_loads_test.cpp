// Loads by motions and strains, by FreeFEM, beside exact ones.
#include "viscontact/freefem_axi/pair_loads.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>

#include "tests/common/failure.hpp"
#include "tests/common/temporary_folder.hpp"
#include "tests/freefem_axi/tabulations.hpp"
#include "tests/oracles/bispherical/pair_loads.hpp"

namespace viscontact::freefem_axi {
namespace {

constexpr double kAccuracy = 1e-4;

Tabulation in_unbounded_fluid(const std::string& geometry, std::vector<double> parameters) {
  Tabulation tabulation = unit_tabulation({1}, 1, kAccuracy);
  tabulation.container.reset();
  tabulation.geometry = geometry;
  tabulation.geometry_parameters = std::move(parameters);
  return tabulation;
}

Eigen::MatrixXd exact_matrix(const viscontact::PairLoads& exact, MotionGroup group) {
  if (group == MotionGroup::kAcross) return exact.transverse;
  if (group == MotionGroup::kTwofold) return exact.twofold;
  if (group == MotionGroup::kAround) return exact.spin;
  const auto bodies = exact.trace.rows();
  Eigen::MatrixXd with_traces(3 * bodies, exact.axial.cols());
  for (Eigen::Index body = 0; body < bodies; ++body)
    with_traces.middleRows(3 * body, 3) << exact.axial.middleRows(2 * body, 2),
        exact.trace.row(body);
  return with_traces;
}

void expect_exact(const Tabulation& tabulation, double gap, const viscontact::PairLoads& exact) {
  for (const auto group :
       {MotionGroup::kAlong, MotionGroup::kAcross, MotionGroup::kAround, MotionGroup::kTwofold}) {
    SCOPED_TRACE(static_cast<int>(group));
    const auto loads = solve_pair_loads(default_freefem(), tabulation, group, gap);
    const auto matrix = exact_matrix(exact, group);
    ASSERT_EQ(static_cast<std::size_t>(matrix.size()), loads.loads.size());
    // Residuals of a symmetric matrix obey the reciprocal theorem to rounding, tractions do not.
    EXPECT_LE(loads.asymmetry, 1e-11);
    EXPECT_GT(loads.traction_mismatch, 1e-8);
    EXPECT_LE(loads.traction_mismatch, 0.01);
    for (std::size_t of = 0; of < loads.bodies; ++of)
      for (std::size_t source = 0; source < loads.sources_of_body; ++source)
        for (std::size_t body = 0; body < loads.bodies; ++body)
          for (std::size_t load = 0; load < loads.loads_of_body; ++load) {
            const auto here = loads.place(body, load, of, source);
            const auto row = static_cast<Eigen::Index>(body * loads.loads_of_body + load),
                       column = static_cast<Eigen::Index>(of * loads.sources_of_body + source);
            EXPECT_NEAR(loads.loads[here], matrix(row, column), loads.errors[here])
                << row << " " << column;
            // The size of the row's own load, that of the moment for a trace.
            const auto size = [&](std::size_t of_body, std::size_t which) {
              const auto own = std::min(which, loads.sources_of_body - 1);
              return std::abs(loads.loads[loads.place(of_body, own, of_body, own)]);
            };
            EXPECT_LE(loads.errors[here],
                      kAccuracy * std::sqrt(size(body, load) * size(of, source)));
          }
  }
}

TEST(PairLoadsOfFreeFem, AreThoseOfTwoSpheres) {
  expect_exact(in_unbounded_fluid("sphere", {2, 0, 0}), 0.02, exact_pair_loads(1, 2, 0.02));
}

TEST(PairLoadsOfFreeFem, AreThoseOfASphereAboveAPlane) {
  expect_exact(in_unbounded_fluid("plane", {}), 0.05, exact_loads_above_plane(1, 0.05));
}

TEST(PairLoadsOfFreeFem, HaveTheUnitsOfTheCase) {
  auto unit = in_unbounded_fluid("sphere", {2, 0, 0});
  unit.relative_accuracy = 1e-2;
  auto other = unit;
  other.viscosity = 3;
  other.radius = 0.5;
  other.geometry_parameters[0] = 1;
  const auto one = solve_pair_loads(default_freefem(), unit, MotionGroup::kAcross, 0.5);
  const auto two = solve_pair_loads(default_freefem(), other, MotionGroup::kAcross, 0.25);
  // Powers of the length in F, T, S by U, W, E.
  for (std::size_t load = 0; load < 3; ++load)
    for (std::size_t source = 0; source < 3; ++source) {
      const double unit_of = 3 * std::pow(0.5, 1 + (load > 0 ? 1 : 0) + (source > 0 ? 1 : 0));
      const auto here = one.place(1, load, 0, source);
      EXPECT_NEAR(two.loads[here], unit_of * one.loads[here], 1e-12 * std::abs(two.loads[here]));
      EXPECT_NEAR(two.errors[here], unit_of * one.errors[here], 1e-6 * two.errors[here]);
    }
}

TEST(PairLoadsOfFreeFem, HaveNoTraceInAContainer) {
  auto enclosed = in_unbounded_fluid("plane", {});
  enclosed.relative_accuracy = 1e-2;
  enclosed.container = Container{4, 8};
  const auto loads = solve_pair_loads(default_freefem(), enclosed, MotionGroup::kAlong, 0.5);
  EXPECT_TRUE(std::isnan(loads.loads[loads.place(0, 2, 0, 0)]));
  // The stresslet does not depend on the constant of the pressure: side and lid hardly change it.
  const auto open = exact_loads_above_plane(1, 0.5);
  EXPECT_NEAR(loads.loads[loads.place(0, 1, 0, 1)] / open.axial(1, 1), 1, 0.1);
}

/// The neighbour moves at -0.5 and turns at 2 times the velocity of the sphere.
TEST(RowsOfPairLoads, AreThoseOfTwoSpheresThatMove) {
  constexpr double kPi = std::numbers::pi, kGap = 0.3, kMoves = -0.5, kTurns = 2;
  const auto exact = exact_pair_loads(1, 2, kGap);
  auto pair = in_unbounded_fluid("sphere", {2, kMoves, kTurns});
  pair.relative_accuracy = 1e-3;
  const auto rows = [&](MotionGroup group) {
    return rows_of(pair, solve_pair_loads(default_freefem(), pair, group, kGap), kGap);
  };
  // Errors of factors are relative to the sphere's own, `own`.
  const auto expect = [](const lubrication::MotionRow& row, double own, double factor,
                         double estimate, double load, double unit) {
    EXPECT_NEAR(factor, load / unit, estimate * std::abs(own));
    EXPECT_LE(row.largest_error_estimate, 1e-3);
    EXPECT_GT(estimate, 0);
  };
  const auto along = rows(MotionGroup::kAlong);
  ASSERT_EQ(along.size(), 2U);
  const Eigen::VectorXd approach = exact.axial.col(0) + kMoves * exact.axial.col(2);
  const Eigen::VectorXd traces = exact.trace.col(0) + kMoves * exact.trace.col(2);
  const auto& away = along[0];
  expect(away, away.force_factor, away.force_factor, away.relative_error_estimate, -approach(0),
         6 * kPi);
  expect(away, away.force_factor, away.stresslet_factor, away.stresslet_error_estimate, approach(1),
         20 * kPi / 3);
  expect(away, away.force_factor, away.trace_factor, away.trace_error_estimate, traces(0),
         20 * kPi / 3);
  expect(away, away.force_factor, away.neighbour->trace_factor,
         away.neighbour->trace_error_estimate, traces(1), 20 * kPi / 3);
  // E_zz = 1 is 1.5 times zz - 1/3, and the neighbour feels no strain.
  const auto& axial = along[1];
  expect(axial, axial.stresslet_factor, axial.neighbour->force_factor,
         axial.neighbour->relative_error_estimate, -1.5 * exact.axial(2, 1), 6 * kPi);
  expect(axial, axial.stresslet_factor, axial.stresslet_factor, axial.stresslet_error_estimate,
         1.5 * exact.axial(1, 1), 20 * kPi / 3);
  const auto across = rows(MotionGroup::kAcross);
  ASSERT_EQ(across.size(), 3U);
  const Eigen::VectorXd roll = exact.transverse.col(1) + kTurns * exact.transverse.col(4);
  expect(across[1], across[1].torque_factor, across[1].force_factor,
         across[1].relative_error_estimate, -roll(0), 6 * kPi);
  expect(across[1], across[1].torque_factor, across[1].neighbour->torque_factor,
         across[1].neighbour->torque_error_estimate, -roll(4), 8 * kPi);
  expect(across[2], across[2].stresslet_factor, across[2].neighbour->stresslet_factor,
         across[2].neighbour->stresslet_error_estimate, exact.transverse(5, 2), 20 * kPi / 3);
  EXPECT_FALSE(across[2].has_traces);
  const auto twofold = rows(MotionGroup::kTwofold);
  ASSERT_EQ(twofold.size(), 1U);
  expect(twofold[0], twofold[0].stresslet_factor, twofold[0].stresslet_factor,
         twofold[0].stresslet_error_estimate, exact.twofold(0, 0), 20 * kPi / 3);
  const auto spin = rows(MotionGroup::kAround);
  ASSERT_EQ(spin.size(), 1U);
  expect(spin[0], spin[0].torque_factor, spin[0].torque_factor, spin[0].torque_error_estimate,
         -exact.spin(0, 0) - kTurns * exact.spin(0, 1), 8 * kPi);
}

/// The plan of a table with strains is another one, and a table without them keeps its hash.
TEST(TablesWithStrains, AreOnePlanForEachGroup) {
  auto plane = in_unbounded_fluid("plane", {});
  const auto path_of = [](lubrication::MotionKind motion) {
    return std::filesystem::path(to_string(motion));
  };
  const auto hash = motion_table_plan(plane, MotionGroup::kAlong, path_of).hash;
  plane.motions = parse_motions({"approach", "slide", "spin", "roll"}, "plane");
  EXPECT_EQ(motion_table_plan(plane, MotionGroup::kAlong, path_of).hash, hash);
  EXPECT_EQ(motion_groups(plane).size(), 3U);
  plane.motions = parse_motions({"all"}, "plane");
  EXPECT_EQ(plane.motions.size(), lubrication::all_motions().size());
  ASSERT_EQ(motion_groups(plane).size(), 4U);
  const auto along = motion_table_plan(plane, MotionGroup::kAlong, path_of);
  EXPECT_NE(along.hash, hash);
  ASSERT_EQ(along.companions.size(), 1U);
  EXPECT_EQ(along.companions[0].path, "axial_strain");
  EXPECT_EQ(motion_table_plan(plane, MotionGroup::kAcross, path_of).companions.size(), 2U);
  // Without the strain of its group a table has stresslets, too.
  plane.motions = parse_motions({"slide", "twofold_strain"}, "plane");
  const auto slide = motion_table_plan(plane, MotionGroup::kAcross, path_of);
  EXPECT_TRUE(slide.companions.empty());
  EXPECT_EQ(slide.hash, [&] {
    plane.motions = parse_motions({"all"}, "plane");
    return motion_table_plan(plane, MotionGroup::kAcross, path_of).hash;
  }());
}

/// A shell script in FreeFEM's place: loads across the axis above a plane whose force by turning
/// exceeds the torque by moving by `difference`. The diagonal is -20. Errors are 1e-6, but that of the
/// force by the strain is 3e-6.
FreeFem asymmetric(const TemporaryFolder& folder, const std::string& difference) {
  const auto file =
      folder.file("freefem", R"sh(#!/bin/sh
awk "BEGIN { for (m = 0; m < 3; m++) for (k = 0; k < 3; k++)
  printf \"viscontact-entry %d 0 %d %.17g %s 4\\n\", m, k,
    m == k ? -20 : m == 1 && k == 0 ? 3 + )sh" +
                                 difference + R"sh( : 3, m == 2 && k == 0 ? \"3e-6\" : \"1e-6\"
  print \"viscontact-result -20 1e-6 1000 4 1e-4\" }"
)sh");
  make_executable(file);
  return {file.string(), folder.path()};
}

TEST(PairLoadsOfFreeFem, ObeyTheReciprocalTheorem) {
  const TemporaryFolder folder;
  const auto plane = in_unbounded_fluid("plane", {});
  const auto solve = [&](const std::string& difference) {
    return solve_pair_loads(asymmetric(folder, difference), plane, MotionGroup::kAcross, 0.5);
  };
  EXPECT_THAT(failure(ErrorKind::kExternalProgram, [&] { (void)solve("1e-6"); }),
              Names("0.5", "reciprocal", "5e-08", "1e-08"));
  EXPECT_EQ(solve("0").asymmetry, 0);
  // What rounding may cause is part of the error estimates of both loads.
  const auto loads = solve("1e-7");
  EXPECT_NEAR(loads.asymmetry, 1e-7 / 20, 1e-15);
  for (const auto& [load, source] : {std::pair(0, 1), std::pair(1, 0)})
    EXPECT_NEAR(loads.errors[loads.place(0, load, 0, source)], 1.1e-6, 1e-14);
  EXPECT_EQ(loads.errors[loads.place(0, 0, 0, 0)], 1e-6);
  // Two estimates of one number: the larger one counts (forces and torques have no factor, S_xz is
  // half of what the script gives).
  EXPECT_DOUBLE_EQ(loads.errors[loads.place(0, 0, 0, 2)], 3e-6);
  EXPECT_DOUBLE_EQ(loads.errors[loads.place(0, 2, 0, 0)], 1.5e-6);
}

TEST(PairLoadsOfFreeFem, AreOfASphereOrAPlane) {
  EXPECT_THAT(bad_input([] {
                (void)solve_pair_loads(default_freefem(), in_unbounded_fluid("free_surface", {}),
                                       MotionGroup::kAlong, 0.5);
              }),
              Names("plane", "sphere"));
}

}  // namespace
}  // namespace viscontact::freefem_axi
