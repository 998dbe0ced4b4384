// Computing times of the C++ parts on the shipped tables and fits: reading, fitting, simulating and
// comparing; `per_step` is in seconds.
#include <benchmark/benchmark.h>

#include "viscontact/case_file/case_file.hpp"
#include "viscontact/fitting/fit_force_table.hpp"
#include "viscontact/lubrication/lubrication_force.hpp"
#include "viscontact/reduced_model/comparison.hpp"
#include "viscontact/reduced_model/fit_uncertainty.hpp"
#include "viscontact/reduced_model/models/models.hpp"

namespace viscontact {
namespace {

const std::filesystem::path kData = std::filesystem::path(VISCONTACT_SOURCE_FOLDER) / "data";

void read_table(benchmark::State& state) {
  for (auto _ : state)
    benchmark::DoNotOptimize(lubrication::read_force_table(kData / "tables/lecture.csv"));
}
BENCHMARK(read_table)->Unit(benchmark::kMicrosecond);

/// The name of the basis; the benchmark's argument is its index in all_bases().
std::string basis_of(const benchmark::State& state) {
  return std::string(lubrication::all_bases().at(static_cast<std::size_t>(state.range(0))).name);
}

lubrication::Fit fit_of_plane(const std::string& basis) {
  return fitting::fit_force_table(lubrication::read_force_table(kData / "tables/plane.csv"), basis,
                                  lubrication::Weights::kRelative);
}

/// Time of a fit of 60 rows with its covariance and diagnostics.
void fit_60_rows(benchmark::State& state) {
  const auto table = lubrication::read_force_table(kData / "tables/plane.csv");
  for (auto _ : state)
    benchmark::DoNotOptimize(
        fitting::fit_force_table(table, basis_of(state), lubrication::Weights::kRelative));
  state.SetLabel(basis_of(state));
}
BENCHMARK(fit_60_rows)->DenseRange(0, 2)->Unit(benchmark::kMicrosecond);

lubrication::LubricationForce lecture_force() {
  return lubrication::LubricationForce(lubrication::read_fit(kData / "fits/lecture.json"));
}

/// The next gap in [3e-3, 1]. It differs from the last gap, so that the compiler cannot compute the
/// result once for all calls.
double next_gap(double gap) { return gap < 0.9 ? gap * 1.07 : 3e-3; }

void measure_function(benchmark::State& state,
                      double (lubrication::LubricationForce::*function)(double) const) {
  const lubrication::LubricationForce force(fit_of_plane(basis_of(state)));
  double gap = 3e-3;
  for (auto _ : state) benchmark::DoNotOptimize((force.*function)(gap = next_gap(gap)));
  state.SetLabel(basis_of(state));
}

void resistance(benchmark::State& state) {
  measure_function(state, &lubrication::LubricationForce::resistance);
}
BENCHMARK(resistance)->DenseRange(0, 2);

void impulse(benchmark::State& state) {
  measure_function(state, &lubrication::LubricationForce::impulse);
}
BENCHMARK(impulse)->DenseRange(0, 2);

/// Time of 10^4 random draws of the smallest gap in the lecture's case.
void monte_carlo_minimal_gap(benchmark::State& state) {
  const auto c = case_file::read_case(kData / "cases/lecture.toml");
  const auto fit = lubrication::read_fit(kData / "fits/lecture.json");
  for (auto _ : state)
    benchmark::DoNotOptimize(reduced_model::propagate_fit(case_file::required_motion(c), fit, 0));
}
BENCHMARK(monte_carlo_minimal_gap)->Unit(benchmark::kMillisecond);

void gap_of_impulse(benchmark::State& state) {
  const auto force = lecture_force();
  double wanted = 0;
  for (auto _ : state) {
    wanted = wanted > -390 ? wanted - 7 : -1;
    benchmark::DoNotOptimize(force.gap_of_impulse(wanted));
  }
}
BENCHMARK(gap_of_impulse);

void simulate_model(benchmark::State& state, const reduced_model::Model& model) {
  const auto c = case_file::read_case(kData / "cases/lecture.toml");
  const auto force = lecture_force();
  long steps = 0;
  for (auto _ : state) {
    const auto trajectory = reduced_model::simulate(reduced_model::find_model(model.name),
                                                    case_file::required_motion(c), force);
    steps = trajectory.steps;
    benchmark::DoNotOptimize(trajectory.rows.data());
  }
  state.counters["steps"] = static_cast<double>(steps);
  state.counters["per_step"] =
      benchmark::Counter(static_cast<double>(steps), benchmark::Counter::kIsIterationInvariantRate |
                                                         benchmark::Counter::kInvert);
}

void compare_all(benchmark::State& state) {
  const auto c = case_file::read_case(kData / "cases/lecture.toml");
  const auto force = lecture_force();
  std::vector<reduced_model::Trajectory> trajectories;
  for (const auto& model : reduced_model::all_models())
    trajectories.push_back(reduced_model::simulate(reduced_model::find_model(model.name),
                                                   case_file::required_motion(c), force));
  for (auto _ : state)
    benchmark::DoNotOptimize(reduced_model::compare_trajectories(trajectories, "inertial"));
}
BENCHMARK(compare_all)->Unit(benchmark::kMicrosecond);

const bool kRegistered = [] {
  for (const auto& model : reduced_model::all_models())
    benchmark::RegisterBenchmark(std::string(model.name).c_str(), simulate_model, model)
        ->Unit(benchmark::kMicrosecond);
  return true;
}();

}  // namespace
}  // namespace viscontact
