// Times of viscous contact: very many spheres at once, and single motions per step and row. Run by bench/run.
#include <benchmark/benchmark.h>
#include <sys/resource.h>

#include <cmath>
#include <limits>
#include <random>
#include <string>

#include "fitting/lubrication_force.hpp"
#include "reduced_model/contact_step.hpp"
#include "reduced_model/motion.hpp"
#include "reduced_model/reference_exact.hpp"
#include "reduced_model/viscous_contact.hpp"
#include "reduced_model/viscous_contact_many.hpp"

namespace viscontact {
namespace {

const std::filesystem::path kData = std::filesystem::path(VISCONTACT_SOURCE_FOLDER) / "data";

/// The lecture's motion (data/cases/lecture.toml), rows and steps every `step`.
Motion lecture_motion(double step) {
  Motion motion{20, 1, 0, 4, ExternalForce({{2, -200}, {4, 200}})};
  motion.reference_time_step = step;
  motion.contact_time_step = step;
  return motion;
}

/// About the lecture's sphere: most land, half of them on solids, and most of these are released.
ManySpheres spheres_about_the_lecture(std::size_t count) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform(0, 1);
  ManySpheres spheres;
  for (std::size_t i = 0; i < count; ++i) {
    spheres.mass.push_back(std::pow(10, 2 * uniform(random)));
    spheres.initial_gap.push_back(0.5 + uniform(random));
    spheres.initial_velocity.push_back(uniform(random) - 0.5);
    spheres.gamma_min.push_back(i % 2 == 0 ? -std::numeric_limits<double>::infinity()
                                           : -400 * uniform(random));
    spheres.force_scale.push_back(2 * uniform(random));
  }
  return spheres;
}

/// Peak of the process so far.
double peak_megabytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;
}

void count_steps(benchmark::State& state, double steps) {
  state.counters["steps"] = steps;
  state.counters["per_step"] = benchmark::Counter(
      steps, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

/// Arguments: threads, place among runnable_instruction_sets().
void many_spheres(benchmark::State& state) {
  constexpr std::size_t kSpheres = 1'000'000;
  constexpr int kSteps = 1000;
  const auto spheres = spheres_about_the_lecture(kSpheres);
  const auto motion = lecture_motion(4.0 / kSteps);
  const auto set = runnable_instruction_sets()[static_cast<std::size_t>(state.range(1))];
  const ManySpheresRun run{motion.end_time, motion.contact_time_step,
                           static_cast<int>(state.range(0)), set};
  for (auto _ : state) {
    const auto contacts = simulate_viscous_contact_many(spheres, motion.external_force, run);
    benchmark::DoNotOptimize(contacts.gap.data());
  }
  state.counters["sphere_steps"] = benchmark::Counter(
      static_cast<double>(kSpheres) * kSteps, benchmark::Counter::kIsIterationInvariantRate);
  state.counters["peak_MB"] = peak_megabytes();
  state.SetLabel(std::string(name_of(set)) + ", threads: " + std::to_string(state.range(0)));
}

/// First of all, before any trajectory weighs on the peak of memory.
const bool kManyRegistered = [] {
  auto* many = benchmark::RegisterBenchmark("many_spheres", many_spheres)
                   ->Unit(benchmark::kMillisecond)
                   ->UseRealTime()
                   ->MeasureProcessCPUTime();
  const auto sets = static_cast<long>(runnable_instruction_sets().size());
  for (long set = sets; set-- > 0;)
    for (const long threads : {1, 2}) many->Args({threads, set});
  return true;
}();

/// Argument: steps.
void single_sphere(benchmark::State& state) {
  const auto steps = static_cast<double>(state.range(0));
  const auto motion = lecture_motion(4 / steps);
  const LubricationForce force(read_fit(kData / "fits/lecture.json"));
  for (auto _ : state)
    benchmark::DoNotOptimize(simulate_viscous_contact(motion, force).rows.data());
  count_steps(state, steps);
}
BENCHMARK(single_sphere)->Arg(4000)->Arg(400000)->Unit(benchmark::kMicrosecond);

/// The same steps without rows: what the scheme and the means of the force cost.
void single_sphere_without_rows(benchmark::State& state) {
  const int steps = static_cast<int>(state.range(0));
  const auto motion = lecture_motion(4.0 / steps);
  const double h = motion.contact_time_step;
  const ContactSetting setting(motion.mass, -std::numeric_limits<double>::infinity(), h);
  for (auto _ : state) {
    ContactState sphere{motion.initial_gap, motion.initial_velocity, 0};
    for (int n = 0; n < steps; ++n) {
      const double push =
          h * motion.external_force.mean(n * h, step_time(n + 1, steps, motion.end_time, h));
      sphere = contact_step(sphere, push, setting, NoDrag()).state;
    }
    benchmark::DoNotOptimize(sphere.gap);
  }
  count_steps(state, steps);
}
BENCHMARK(single_sphere_without_rows)->Arg(4000)->Arg(400000)->Unit(benchmark::kMicrosecond);

/// Per requested time.
void reference_exact(benchmark::State& state) {
  const auto times = static_cast<double>(state.range(0));
  const auto motion = lecture_motion(4 / times);
  const LubricationForce force(read_fit(kData / "fits/lecture.json"));
  for (auto _ : state)
    benchmark::DoNotOptimize(simulate_reference_exact(motion, force).rows.data());
  count_steps(state, times);
}
BENCHMARK(reference_exact)->Arg(4000)->Arg(400000)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace viscontact
