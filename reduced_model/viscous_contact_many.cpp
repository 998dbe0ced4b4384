#include "reduced_model/viscous_contact_many.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <limits>
#include <thread>

#include "common/error.hpp"
#include "reduced_model/motion.hpp"

#if defined(__x86_64__) && defined(__GNUC__)
#define VISCONTACT_X86_VECTORS 1
#else
#define VISCONTACT_X86_VECTORS 0
#endif

namespace viscontact {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// What is the same in a step of every sphere.
struct Step {
  double mean;  // of f_ext
  double length, per_length;
  double end;
};

// 11 arrays of 256 numbers are 22.5 kB: they stay in a first-level cache of 32 kB from step to step.
constexpr std::size_t kChunk = 256;
// A chunk is filled up to a multiple of it, so that no instruction set has a remainder to do one by one.
constexpr std::size_t kWidestVector = 8;
// Steps that are prepared at a time: 32 kB. Once in as many steps the chunks go to memory and back.
constexpr int kBlock = 1024;

/// Spheres at work.
struct Chunk {
  // Not 2 kB, so that what is stored to one array does not hold up loads from the next but one: processors compare the last 12 bits of addresses
  // first. 280 numbers spread the 11 arrays evenly over those 4 kB.
  using Numbers = std::array<double, kChunk + 24>;
  alignas(64) Numbers mass, per_mass, gamma_min, force_scale;
  alignas(64) Numbers gap, velocity, gamma;
  alignas(64) Numbers minimal_gap, minimal_gap_time, lowest_gamma, last_contact;
};

// A product and a sum must not be contracted to an FMA, which rounds once where contact_step rounds twice; AVX-512 F brings FMA with it.
// That both sides of a choice may be computed (no-trapping-math) is what lets GCC make vectors of the loop; no value depends on it.
#if defined(__clang__)
#pragma clang fp contract(off)
#elif defined(__GNUC__)
#pragma GCC push_options
#pragma GCC optimize("fp-contract=off", "no-trapping-math")
#endif

/// The steps for the first `size` spheres, a multiple of kWidestVector. The same bits as contact_step with NoDrag, without a branch; what makes
/// its branches one:
/// - Held (gamma < 0), the gap is 0, and the momentum that is left is gamma + momentum. -needed is that momentum, then, so that the branches of
///   impact and of being held have gamma = max(-needed, gamma_min) in common, and those of flight and of release the velocity momentum/m.
/// - Held with momentum 0 left is what release with velocity 0 makes of it: gap, velocity and gamma are +0 in both.
/// - The drag's impulse is 0: all it could change is the sign of a 0 in `needed`, which is then not asked for.
[[gnu::always_inline]] inline void advance_lanes(Chunk& c, std::size_t size,
                                                 std::span<const Step> steps) {
  for (const Step& step : steps) {
    const double mean = step.mean, length = step.length, per_length = step.per_length;
    const double end = step.end;
    for (std::size_t i = 0; i < size; ++i) {
      const double mass = c.mass[i], gamma_min = c.gamma_min[i];
      const double gap = c.gap[i], gamma = c.gamma[i];
      const bool held = gamma < 0;
      const double free_momentum = mass * c.velocity[i] + length * (c.force_scale[i] * mean);
      const double film_and_momentum = gamma + free_momentum;
      const double momentum = held ? film_and_momentum : free_momentum;
      const double fall = -gap * per_length;
      const double to_contact = held ? 0.0 : fall;
      const double needed = mass * to_contact - momentum;
      const bool contact = needed > 0;
      const double velocity = momentum * c.per_mass[i];
      const double moved = gap + length * velocity;
      const double above = 0.0 < moved ? moved : 0.0;
      const double pushed = -needed < gamma_min ? gamma_min : -needed;
      const double new_gap = contact ? 0.0 : above;
      const double new_gamma = contact ? pushed : 0.0;
      c.gap[i] = new_gap;
      c.velocity[i] = contact ? to_contact : velocity;
      c.gamma[i] = new_gamma;
      const double lowest_gamma = c.lowest_gamma[i], minimal_gap = c.minimal_gap[i];
      const double minimal_gap_time = c.minimal_gap_time[i], last_contact = c.last_contact[i];
      c.lowest_gamma[i] = new_gamma < lowest_gamma ? new_gamma : lowest_gamma;
      const bool lower = new_gap < minimal_gap;
      c.minimal_gap[i] = lower ? new_gap : minimal_gap;
      c.minimal_gap_time[i] = lower ? end : minimal_gap_time;
      c.last_contact[i] = new_gap == 0 ? end : last_contact;
    }
  }
}

void advance_baseline(Chunk& c, std::size_t size, std::span<const Step> steps) {
  advance_lanes(c, size, steps);
}

#if VISCONTACT_X86_VECTORS
// By name and not as target_clones: tests can run each, and no resolver runs before main (sanitizers, static programs).
[[gnu::target("avx2")]] void advance_avx2(Chunk& c, std::size_t size, std::span<const Step> steps) {
  advance_lanes(c, size, steps);
}
[[gnu::target("avx512f")]] void advance_avx512(Chunk& c, std::size_t size,
                                               std::span<const Step> steps) {
  advance_lanes(c, size, steps);
}
#endif

#if !defined(__clang__) && defined(__GNUC__)
#pragma GCC pop_options
#endif

using Advance = void (*)(Chunk&, std::size_t, std::span<const Step>);

Advance advance_with(InstructionSet set) {
#if VISCONTACT_X86_VECTORS
  if (set == InstructionSet::kAvx2) return advance_avx2;
  if (set == InstructionSet::kAvx512) return advance_avx512;
#endif
  return advance_baseline;
}

void check_lengths(const ManySpheres& spheres) {
  const auto check = [&](const char* name, const std::vector<double>& values) {
    if (values.size() != spheres.mass.size())
      throw Error(
          ExitCode::kBadInput,
          fmt::format("{} is given for {} spheres and mass for {}; both must be given for all",
                      name, values.size(), spheres.mass.size()));
  };
  check("initial_gap", spheres.initial_gap);
  check("initial_velocity", spheres.initial_velocity);
  check("gamma_min", spheres.gamma_min);
  check("force_scale", spheres.force_scale);
}

void check_values(const ManySpheres& spheres) {
  const auto check = [](const char* name, const std::vector<double>& values, const auto& allowed,
                        const char* what_is) {
    const auto bad = std::ranges::find_if_not(values, allowed);
    if (bad != values.end())
      throw Error(ExitCode::kBadInput, fmt::format("{}[{}] is {}; it must be {}", name,
                                                   bad - values.begin(), *bad, what_is));
  };
  const auto finite = [](double x) { return std::isfinite(x); };
  const auto positive = [](double x) { return x > 0 && std::isfinite(x); };
  check("mass", spheres.mass, positive, "> 0 and finite");
  check("initial_gap", spheres.initial_gap, positive, "> 0 and finite");
  check("initial_velocity", spheres.initial_velocity, finite, "finite");
  check(
      "gamma_min", spheres.gamma_min, [](double x) { return x <= 0; }, "<= 0 or -infinity");
  check("force_scale", spheres.force_scale, finite, "finite");
}

void check(const ManySpheresRun& run) {
  const auto check_time = [](const char* name, double value) {
    if (!(value > 0 && std::isfinite(value)))
      throw Error(ExitCode::kBadInput,
                  fmt::format("{} is {}; it must be > 0 and finite", name, value));
  };
  check_time("end_time", run.end_time);
  check_time("time_step", run.time_step);
  if (run.threads < 1)
    throw Error(ExitCode::kBadInput, fmt::format("threads is {}; it must be >= 1", run.threads));
  if (run.instruction_set &&
      std::ranges::count(runnable_instruction_sets(), *run.instruction_set) == 0)
    throw Error(ExitCode::kBadInput,
                fmt::format("this processor does not have the instruction set {}",
                            name_of(*run.instruction_set)));
}

/// Contacts as they stand at the start, states included.
ManyContacts at_start(const ManySpheres& spheres) {
  const std::size_t count = spheres.mass.size();
  const auto all = [count](double value) { return std::vector<double>(count, value); };
  return {spheres.initial_gap,      all(0), all(0), all(kNaN), all(kNaN), spheres.initial_gap,
          spheres.initial_velocity, all(0)};
}

/// Takes spheres `from`, `from` + 1, ... up to kChunk of them through the steps.
void advance_chunk(const ManySpheres& spheres, std::size_t from, std::span<const Step> steps,
                   Advance advance, ManyContacts& contacts) {
  const std::size_t size = std::min(kChunk, spheres.mass.size() - from);
  const std::size_t filled = (size + kWidestVector - 1) / kWidestVector * kWidestVector;
  Chunk chunk;
  const auto load = [&](const std::vector<double>& source, Chunk::Numbers& lanes) {
    const auto begin = source.begin() + static_cast<std::ptrdiff_t>(from);
    const auto end = std::copy_n(begin, size, lanes.begin());
    std::fill(end, lanes.begin() + static_cast<std::ptrdiff_t>(filled), lanes[size - 1]);
  };
  const auto save = [&](const Chunk::Numbers& lanes, std::vector<double>& target) {
    std::copy_n(lanes.begin(), size, target.begin() + static_cast<std::ptrdiff_t>(from));
  };
  load(spheres.mass, chunk.mass);
  for (std::size_t i = 0; i < filled; ++i) chunk.per_mass[i] = 1 / chunk.mass[i];
  load(spheres.gamma_min, chunk.gamma_min);
  load(spheres.force_scale, chunk.force_scale);
  load(contacts.gap, chunk.gap);
  load(contacts.velocity, chunk.velocity);
  load(contacts.gamma, chunk.gamma);
  load(contacts.minimal_gap, chunk.minimal_gap);
  load(contacts.minimal_gap_time, chunk.minimal_gap_time);
  load(contacts.lowest_gamma, chunk.lowest_gamma);
  load(contacts.last_contact, chunk.last_contact);
  advance(chunk, filled, steps);
  save(chunk.gap, contacts.gap);
  save(chunk.velocity, contacts.velocity);
  save(chunk.gamma, contacts.gamma);
  save(chunk.minimal_gap, contacts.minimal_gap);
  save(chunk.minimal_gap_time, contacts.minimal_gap_time);
  save(chunk.lowest_gamma, contacts.lowest_gamma);
  save(chunk.last_contact, contacts.last_contact);
  // No gap is less than 0: the first of 0 is the first of the least.
  for (std::size_t i = 0; i < size; ++i)
    contacts.first_contact[from + i] = chunk.minimal_gap[i] == 0 ? chunk.minimal_gap_time[i] : kNaN;
}

/// do_chunk(0), ..., do_chunk(chunks - 1), shared among threads.
template <class DoChunk>
void for_each_chunk(std::size_t chunks, int threads, const DoChunk& do_chunk) {
  std::atomic<std::size_t> next = 0;
  const auto work = [&] {
    for (std::size_t i = next++; i < chunks; i = next++) do_chunk(i);
  };
  const std::size_t workers = std::min(chunks, static_cast<std::size_t>(threads));
  std::vector<std::jthread> others;  // joined at the end of this scope
  for (std::size_t i = 1; i < workers; ++i) others.emplace_back(work);
  work();
}

}  // namespace

std::span<const InstructionSet> runnable_instruction_sets() {
  static const std::vector<InstructionSet> sets = [] {
    std::vector<InstructionSet> found = {InstructionSet::kBaseline};
#if VISCONTACT_X86_VECTORS
    // Also asks whether the system saves the registers.
    if (__builtin_cpu_supports("avx2")) found.push_back(InstructionSet::kAvx2);
    if (__builtin_cpu_supports("avx512f")) found.push_back(InstructionSet::kAvx512);
#endif
    return found;
  }();
  return sets;
}

std::string_view name_of(InstructionSet set) {
  switch (set) {
    case InstructionSet::kAvx2:
      return "AVX2";
    case InstructionSet::kAvx512:
      return "AVX-512";
    case InstructionSet::kBaseline:
      break;
  }
  return "baseline";
}

ManyContacts simulate_viscous_contact_many(const ManySpheres& spheres, const ExternalForce& force,
                                           const ManySpheresRun& run) {
  check_lengths(spheres);
  check_values(spheres);
  check(run);
  const int count = step_count(run.end_time, run.time_step);
  const Advance advance =
      advance_with(run.instruction_set.value_or(runnable_instruction_sets().back()));
  ManyContacts contacts = at_start(spheres);
  const std::size_t chunks = (spheres.mass.size() + kChunk - 1) / kChunk;
  std::vector<Step> steps;
  for (int done = 0; done < count; done += static_cast<int>(steps.size())) {
    steps.clear();
    for (int n = done; n < std::min(count, done + kBlock); ++n) {
      const double begin = step_time(n, count, run.end_time, run.time_step);
      const double end = step_time(n + 1, count, run.end_time, run.time_step);
      const double length = n + 1 == count ? end - begin : run.time_step;
      steps.push_back({force.mean(begin, end), length, 1 / length, end});
    }
    for_each_chunk(chunks, run.threads, [&](std::size_t i) {
      advance_chunk(spheres, i * kChunk, steps, advance, contacts);
    });
  }
  return contacts;
}

}  // namespace viscontact
