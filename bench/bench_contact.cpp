// Computing time of viscous contact, per step and per row of motions of one sphere, in the units of
// the lecture's case; `per_step` is in seconds.
#include <benchmark/benchmark.h>

#include <cmath>
#include <limits>
#include <string>

#include "viscontact/lubrication/lubrication_force.hpp"
#include "viscontact/reduced_model/models/contact/contact_step.hpp"
#include "viscontact/reduced_model/models/contact/viscous_contact.hpp"
#include "viscontact/reduced_model/models/reference.hpp"
#include "viscontact/reduced_model/motion.hpp"

namespace viscontact {
namespace {

const std::filesystem::path kData = std::filesystem::path(VISCONTACT_SOURCE_FOLDER) / "data";

/// The motion of the lecture's case (data/cases/lecture.toml) with rows and time steps `step` [T].
reduced_model::Motion lecture_motion(double step) {
  reduced_model::Motion motion{20, 1, 0, 4, reduced_model::ExternalForce({{2, -200}, {4, 200}})};
  motion.set(reduced_model::kReferenceTimeStep, step);
  motion.set(reduced_model::kContactTimeStep, step);
  return motion;
}

void count_steps(benchmark::State& state, double steps) {
  state.counters["steps"] = steps;
  state.counters["per_step"] = benchmark::Counter(
      steps, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

/// Motion with rows; the benchmark's argument is the number of steps.
void single_sphere(benchmark::State& state) {
  const auto steps = static_cast<double>(state.range(0));
  const auto motion = lecture_motion(4 / steps);
  const lubrication::LubricationForce force(lubrication::read_fit(kData / "fits/lecture.json"));
  for (auto _ : state)
    benchmark::DoNotOptimize(
        reduced_model::run_contact_model(reduced_model::viscous_contact, motion, force)
            .rows.data());
  count_steps(state, steps);
}
BENCHMARK(single_sphere)->Arg(4000)->Arg(400000)->Unit(benchmark::kMicrosecond);

/// The same steps without rows: the scheme and the mean forces alone.
void single_sphere_without_rows(benchmark::State& state) {
  const int steps = static_cast<int>(state.range(0));
  const auto motion = lecture_motion(4.0 / steps);
  const double h = motion.parameter(reduced_model::kContactTimeStep);
  const reduced_model::ContactSetting setting(motion.mass, -std::numeric_limits<double>::infinity(),
                                              h);
  for (auto _ : state) {
    reduced_model::ContactState sphere{motion.initial_gap, motion.initial_velocity, 0};
    for (int n = 0; n < steps; ++n) {
      const double push =
          h * motion.external_force.mean(
                  n * h, reduced_model::step_time(n + 1, steps, motion.end_time, h));
      sphere = reduced_model::contact_step(sphere, push, setting, reduced_model::NoDrag()).state;
    }
    benchmark::DoNotOptimize(sphere.gap);
  }
  count_steps(state, steps);
}
BENCHMARK(single_sphere_without_rows)->Arg(4000)->Arg(400000)->Unit(benchmark::kMicrosecond);

/// reference_exact for each output time; the argument is the number of output times.
void reference_exact(benchmark::State& state) {
  const auto times = static_cast<double>(state.range(0));
  const auto motion = lecture_motion(4 / times);
  const lubrication::LubricationForce force(lubrication::read_fit(kData / "fits/lecture.json"));
  for (auto _ : state)
    benchmark::DoNotOptimize(reduced_model::simulate_reference_exact(motion, force).rows.data());
  count_steps(state, times);
}
BENCHMARK(reference_exact)->Arg(4000)->Arg(400000)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace viscontact
