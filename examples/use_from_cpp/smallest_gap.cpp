// Reads a table of forces, fits a formula to it, and computes the motion of the sphere of the
// lecture's case by two models (docs/physics.md (4.1), (4.4)).
#include <algorithm>
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "viscontact/fitting/fit_force_table.hpp"
#include "viscontact/lubrication/fit.hpp"
#include "viscontact/lubrication/lubrication_force.hpp"
#include "viscontact/lubrication/motion_table.hpp"
#include "viscontact/reduced_model/models/inertial.hpp"
#include "viscontact/reduced_model/models/models.hpp"

namespace {

/// A sphere of mass 20 [M], at rest at the gap 1 [L], is pushed towards the plane with the force
/// 200 [M L/T^2] until t = 2 [T], and then pulled back with the same force until t = 4. Units are
/// those of the table.
viscontact::reduced_model::Motion lecture_motion() {
  const std::vector<viscontact::reduced_model::ExternalForce::Piece> pieces = {
      {.until = 2, .value = -200}, {.until = 4, .value = 200}};
  viscontact::reduced_model::Motion motion{
      .mass = 20,
      .initial_gap = 1,
      .initial_velocity = 0,
      .end_time = 4,
      .external_force = viscontact::reduced_model::ExternalForce(pieces)};
  motion.set(viscontact::reduced_model::kReferenceTimeStep,
             1e-3);  // also the time between the rows of `inertial`
  motion.set(viscontact::reduced_model::kRelativeTolerance, 1e-9);
  motion.set(viscontact::reduced_model::kContactTimeStep, 1e-3);
  return motion;
}

void print_smallest_gaps(const std::string& table_file) {
  // The table has one row for each gap and velocity. Your own table needs only the columns gap [L],
  // reference_velocity [L/T] and force [M L/T^2], and the lines "# viscosity: NUMBER" [M/(L T)] and
  // "# radius: NUMBER" [L]. A wrong table throws Error(kBadInput).
  const viscontact::lubrication::MotionTable table =
      viscontact::lubrication::read_force_table(table_file);

  // The fit has the coefficients of the basis "lecture", a list of functions of the gap, and
  // diagnostics that say how far to trust them. Weights::kRelative minimises relative residuals.
  const viscontact::lubrication::Fit fit = viscontact::fitting::fit_force_table(
      table, "lecture", viscontact::lubrication::Weights::kRelative);
  std::printf("%zu rows, fitted by", table.rows.size());
  for (const auto& term : fit.terms)
    std::printf("%s %s", &term == &fit.terms.front() ? "" : ",", term.name.c_str());
  std::printf(": largest residual %.2g %%\n", 100 * fit.largest_relative_residual);

  // The force [M L/T^2] as a function of the gap q and the velocity u is F_lub(q, u) = -R(q) u. At
  // a gap outside the interval of the fit, LubricationForce throws an Error.
  const viscontact::lubrication::LubricationForce force(fit);
  std::printf("R(q = 0.01) = %.6g\n\n", force.resistance(0.01));

  // Two models of motion are compared; all_models() lists the names of all models.
  const viscontact::reduced_model::Motion motion = lecture_motion();
  std::printf("%-16s %12s %10s\n", "model", "q_min", "at time");
  for (const char* name : {"inertial", "viscous_contact"}) {
    const viscontact::reduced_model::Trajectory trajectory = viscontact::reduced_model::simulate(
        viscontact::reduced_model::find_model(name), motion, force);
    const viscontact::reduced_model::TrajectoryRow lowest = *std::ranges::min_element(
        trajectory.rows, {}, &viscontact::reduced_model::TrajectoryRow::gap);
    std::printf("%-16s %12.6g %10.6g\n", name, lowest.gap, lowest.time);
  }
}

}  // namespace

// Type these commands in the source folder of Viscontact, after scripts/build has built it (PREFIX
// is any folder; without --prefix it is /usr/local):
//
//   cmake --install build/release --prefix PREFIX
//   cmake -S examples/use_from_cpp -B out/use_from_cpp -D CMAKE_PREFIX_PATH=PREFIX -D CMAKE_BUILD_TYPE=Release
//   cmake --build out/use_from_cpp
//   out/use_from_cpp/smallest_gap PREFIX/share/viscontact/data/tables/lecture.csv
//
// The program prints the following lines, with which tests/package/use_installed compares its
// output. R [M/T] is the resistance (minus the force over the velocity) at the gap q [L], q_min [L]
// is the smallest gap of the motion, and the last digits depend on the table and the compiler.
//
//   40 rows, fitted by 1/q, 1, q, q^2, q^3: largest residual 0.46 %
//   R(q = 0.01) = 5761.06
//
//   model                   q_min    at time
//   inertial           0.00296729    2.00072
//   viscous_contact             0      0.447

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: %s TABLE\n", argv[0]);
    return 2;
  }
  // Every error that a user can cause is a viscontact::Error (common/error.hpp), which is a
  // std::runtime_error and whose message says what to do.
  try {
    print_smallest_gaps(argv[1]);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
