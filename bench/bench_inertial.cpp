// The model `inertial` on the lecture's case with the shipped fit: computing time, and relative
// error of the gap against an oracle in long double.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/oracles/inertial_motion.hpp"
#include "viscontact/lubrication/fit.hpp"
#include "viscontact/lubrication/lubrication_force.hpp"
#include "viscontact/reduced_model/models/inertial.hpp"

namespace viscontact {
namespace {

const std::string kSource = VISCONTACT_SOURCE_FOLDER;

/// The motion of the lecture's case (data/cases/lecture.toml), with the relative tolerance of
/// CVODE.
reduced_model::Motion lecture_motion(double tolerance) {
  reduced_model::Motion motion{20, 1, 0, 4, reduced_model::ExternalForce({{2, -200}, {4, 200}})};
  motion.set(reduced_model::kReferenceTimeStep, 1e-3);
  motion.set(reduced_model::kRelativeTolerance, tolerance);
  return motion;
}

/// The resistance R(q) [M/T] of a fit in the lecture's basis, in long double.
InertialProblem::Function resistance(const lubrication::Fit& fit) {
  return [fit](long double q) {
    long double force = 0;
    const auto add = [&](const lubrication::FitTerm& term) -> long double {
      if (term.name == "1/q") return 1 / q;
      if (term.name == "1") return 1;
      if (term.name == "q") return q;
      if (term.name == "q^2") return q * q;
      if (term.name == "q^3") return q * q * q;
      throw std::invalid_argument(term.name);
    };
    for (const auto& term : fit.terms) force += term.coefficient * add(term);
    return -force / fit.reference_velocity;
  };
}

int run(const std::vector<std::string>& arguments) {
  const auto fit = lubrication::read_fit(kSource + "/data/fits/lecture.json");
  const lubrication::LubricationForce force(fit);
  InertialMotion oracle(
      {20, 1, 0, resistance(fit), {{2, [](long double) { return -200.0L; }}, {4, [](long double) {
                                                                                return 200.0L;
                                                                              }}}});
  constexpr int kTimes = 400;  // times at which gaps are compared
  std::vector<double> times, exact;
  for (int i = 1; i <= kTimes; ++i) {
    times.push_back(i == kTimes ? 4.0 : 10 * i * 1e-3);  // every tenth output time
    oracle.advance(times.back());
    exact.push_back(static_cast<double>(oracle.gap()));
  }

  for (const double tolerance : {1e-7, 1e-9, 1e-11}) {
    const reduced_model::Motion motion = lecture_motion(tolerance);
    std::vector<double> milliseconds;
    reduced_model::Trajectory trajectory;
    for (int i = 0; i < 101; ++i) {
      const auto start = std::chrono::steady_clock::now();
      trajectory = reduced_model::simulate_inertial(motion, force);
      milliseconds.push_back(
          std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start)
              .count());
    }
    std::ranges::nth_element(milliseconds, milliseconds.begin() + 50);
    double error = 0;
    std::size_t compared = 0;
    for (const auto& row : trajectory.rows) {
      // The time of a row may differ from this time by rounding.
      if (compared < times.size() && std::abs(row.time - times[compared]) < 1e-12)
        error = std::max(error, std::abs(row.gap / exact[compared++] - 1));
    }
    if (compared != times.size()) throw std::logic_error("a time has no row");
    fmt::print(
        "inertial at {:.0e}: {:.3f} ms (median of 101, least {:.3f}), {} steps, {} rows, "
        "error of the gap {:.2g}\n",
        tolerance, milliseconds[50], std::ranges::min(milliseconds), trajectory.steps,
        trajectory.rows.size(), error);
    if (tolerance != 1e-9 || arguments.empty()) continue;
    std::ofstream file(arguments[0]);
    file << fmt::format("# gap_error: {:.6g}\n# milliseconds: {:.6g}\ntime,gap\n", error,
                        milliseconds[50]);
    for (std::size_t i = 0; i < times.size(); ++i)
      file << fmt::format("{:.17g},{:.17g}\n", times[i], exact[i]);
  }
  return 0;
}

}  // namespace
}  // namespace viscontact

// bench_inertial [STATES.csv]: a file with which radau.py compares SciPy's Radau.
int main(int argc, char** argv) { return viscontact::run({argv + 1, argv + argc}); }
