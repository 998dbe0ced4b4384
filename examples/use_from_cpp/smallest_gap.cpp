// Viscontact from C++: reads a table of forces, fits it, and lets two models move the sphere of the
// lecture's case with that fit: `inertial`, which resolves the film between sphere and plane, and
// `viscous_contact`, which does not.
//
// In the folder of Viscontact, after scripts/build (PREFIX: any folder, /usr/local without
// --prefix):
//
//   cmake --install build/release --prefix PREFIX
//   cmake -S examples/use_from_cpp -B out/use_from_cpp -D CMAKE_PREFIX_PATH=PREFIX -D CMAKE_BUILD_TYPE=Release
//   cmake --build out/use_from_cpp
//   out/use_from_cpp/smallest_gap PREFIX/share/viscontact/data/tables/lecture.csv
//
// It prints (q_min: the smallest gap; the last digits are the table's and the compiler's):
//
//   40 rows, fitted by 1/q, 1, q, q^2, q^3: largest residual 0.46 %
//   R(q = 0.01) = 5761.06
//
//   model                   q_min    at time
//   inertial           0.00296729    2.00072
//   viscous_contact             0      0.447
#include <algorithm>
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "viscontact/fitting/fit_force_table.hpp"
#include "viscontact/lubrication/fit/fit.hpp"
#include "viscontact/lubrication/force_table.hpp"
#include "viscontact/lubrication/lubrication_force.hpp"
#include "viscontact/reduced_model/models/inertial.hpp"
#include "viscontact/reduced_model/models/models.hpp"

namespace {

/// A sphere of mass 20, at rest at gap 1, is pushed towards the plane until t = 2, then pulled
/// back. Viscontact has no units of its own: those of the table.
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
             1e-3);  // the rows of `inertial` are as far apart
  motion.set(viscontact::reduced_model::kRelativeTolerance, 1e-9);
  motion.set(viscontact::reduced_model::kContactTimeStep, 1e-3);
  return motion;
}

void print_smallest_gaps(const std::string& table_file) {
  // The table: one row for each gap and velocity. A user's own needs the columns gap,
  // reference_velocity and force only.
  const viscontact::lubrication::ForceTable table =
      viscontact::lubrication::read_force_table(table_file);

  // The fit: coefficients of a basis, and how far to trust them.
  const viscontact::lubrication::Fit fit = viscontact::fitting::fit_force_table(
      table, "lecture", viscontact::lubrication::Weights::kRelative);
  std::printf("%zu rows, fitted by", table.rows.size());
  for (const auto& term : fit.terms)
    std::printf("%s %s", &term == &fit.terms.front() ? "" : ",", term.name.c_str());
  std::printf(": largest residual %.2g %%\n", 100 * fit.largest_relative_residual);

  // The force as a function: F_lub(q, u) = -R(q) u in the interval of the gaps that were fitted;
  // outside, asking is an error.
  const viscontact::lubrication::LubricationForce force(fit);
  std::printf("R(q = 0.01) = %.6g\n\n", force.resistance(0.01));

  // The models of motion. all_models() has every one.
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

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: %s TABLE\n", argv[0]);
    return 2;
  }
  // Every error that a user can cause is a viscontact::Error (common/error.hpp), a
  // std::runtime_error that says what to do.
  try {
    print_smallest_gaps(argv[1]);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
