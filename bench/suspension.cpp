// Time, iterations and memory of steps of a dense suspension that has been sheared, and what their
// parts take. bench/lf_dem_suspension runs LF_DEM from the same arrangement.
#include <fmt/format.h>
#include <fmt/os.h>
#include <malloc.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "viscontact/arrangement/arrangement.hpp"
#include "viscontact/common/system/memory.hpp"
#include "viscontact/particle_runs/io/restart.hpp"
#include "viscontact/suspensions/cell/pair_search.hpp"
#include "viscontact/suspensions/linear/conjugate_gradients.hpp"
#include "viscontact/suspensions/pairs/pair_system.hpp"
#include "viscontact/suspensions/step/sphere_order.hpp"
#include "viscontact/suspensions/suspension_simulation.hpp"

namespace {

using namespace viscontact;
using namespace viscontact::particles;

struct Seconds {
  double cpu = 0, elapsed = 0;
};

Seconds now() {
  const auto of = [](clockid_t clock) {
    timespec t{};
    clock_gettime(clock, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
  };
  return {of(CLOCK_PROCESS_CPUTIME_ID), of(CLOCK_MONOTONIC)};
}

/// Mean CPU seconds of a call of work().
template <class Work>
double seconds_of(const Work& work) {
  const double start = now().cpu;
  int calls = 0;
  do {
    work();
    ++calls;
  } while (now().cpu - start < 0.3);
  return (now().cpu - start) / calls;
}

/// A line of /proc/self/status in bytes.
double memory(const std::string& key) {
  std::ifstream file("/proc/self/status");
  for (std::string line; std::getline(file, line);)
    if (line.starts_with(key + ":")) return 1024 * std::stod(line.substr(key.size() + 1));
  return 0;
}

/// The least memory that the process has now. Its peak is counted from now on.
double start_of_memory() {
  malloc_trim(0);
  std::ofstream("/proc/self/clear_refs") << "5";
  return memory("VmRSS");
}

struct Options {
  std::map<std::string, std::string> texts;
  double number(const std::string& name) const { return std::stod(texts.at("--" + name)); }
  std::size_t count() const { return std::stoul(texts.at("--count")); }
};

// Calls in a step of a part that is timed alone. Pairs are sought for the step, and for overlaps at
// its start and end; they are placed at its start and again after some linear problems, each time
// with a new order of the strong pairs. Factors are those of each linear problem at most.
constexpr double kSearches = 3, kPlacements = 2;

/// A cube with the volume fraction of spheres of radii 1 and 1.4, half of the volume each.
std::vector<double> radii_of(const Options& options) {
  const auto large =
      static_cast<std::size_t>(std::round(options.number("count") / (1 + std::pow(1.4, 3))));
  std::vector<double> radii;
  for (std::size_t k = 0; k < options.count(); ++k) radii.push_back(k < large ? 1.4 : 1);
  return radii;
}

Setting setting_of(const Options& options) {
  const double volume = size_of({.radii = radii_of(options)}, 3) / options.number("fraction");
  const double length = std::cbrt(volume);
  Setting setting;
  setting.domain = BoxDomain{{0, 0, 0}, {length, length, length}, {true, true, true}};
  PairLubrication lubrication;
  lubrication.viscosity = 1;
  lubrication.pairs =
      options.texts.at("--pairs") == "tables" ? PairTerms::kTables : PairTerms::kNearContact;
  lubrication.regularisation = options.number("delta");
  lubrication.roughness = options.number("roughness");
  lubrication.drag = options.number("drag");
  lubrication.range = options.number("range");
  lubrication.gradient[0][1] = 1;
  setting.lubrication = lubrication;
  setting.time_step = options.number("strain-step");
  if (options.number("friction") > 0)
    setting.laws.friction = FrictionLaw{options.number("friction")};
  return setting;
}

/// The spheres after the strain at which measurements begin: those of a file, or new ones.
State sheared(const Options& options, const Setting& setting) {
  std::string name = "suspension";
  for (const auto* option : {"count", "fraction", "pairs", "delta", "roughness", "drag", "friction",
                             "range", "seed", "strain"})
    name += "-" + options.texts.at(std::string("--") + option);
  const auto file = std::filesystem::path(options.texts.at("--states")) / (name + ".bin");
  if (std::filesystem::exists(file)) return read_restart(file);
  State state;
  auto& p = state.particles;
  p.dimension = 3;
  p.radii = radii_of(options);
  const auto start = now();
  p.positions = arrange({p.radii, 0, std::stoull(options.texts.at("--seed"))}, setting.domain, {});
  fmt::print("arrangement: {:.2f} s\n", now().cpu - start.cpu);
  p.velocities.assign(p.positions.size(), 0);
  p.masses.assign(p.radii.size(), 1);
  add_rotation(p);
  SuspensionSimulation simulation(setting, std::move(state), 1);
  while (simulation.step(options.number("strain")).parts > 0) {
  }
  fmt::print("sheared: {:.2f} s\n", now().cpu - start.cpu);
  if (!options.texts.at("--states").empty())
    fmt::output_file(file.string()).print("{}", write_restart(simulation.state()));
  return simulation.state();
}

/// The state as LF_DEM reads it.
void write_for_lf_dem(const std::string& file, const Options& options, const Setting& setting,
                      const State& state) {
  const auto& p = state.particles;
  const double length = std::get<BoxDomain>(setting.domain).to[0];
  const auto large = static_cast<std::size_t>(std::ranges::count(p.radii, 1.4));
  auto out = fmt::output_file(file);
  // LF_DEM has the gradient along z, and the vorticity along -y.
  out.print("# np1 np2 vf lx ly lz vf1 vf2 dispx dispy\n# {} {} {} {} {} {} {} {} {} 0\n",
            p.count() - large, large, options.texts.at("--fraction"), length, length, length,
            options.number("fraction") / 2, options.number("fraction") / 2,
            state.shear.offset < 0 ? state.shear.offset + length : state.shear.offset);
  for (const double radius : {1.0, 1.4})
    for (std::size_t k = 0; k < p.count(); ++k) {
      const Vector x = p.position(k);
      if (p.radii[k] == radius)
        out.print("{} {} {} {}\n", x[0], x[2] > 0 ? length - x[2] : 0, x[1], radius);
    }
}

}  // namespace

// suspension [OPTION VALUE]..., with the options and values below. Spheres are sheared to --strain,
// and then --steps more steps are timed. With --states FOLDER the sheared states are kept there;
// --write FILE writes the state as LF_DEM reads it.
int main(int argc, char** argv) {
  keep_freed_memory();  // as the program does
  Options options;
  std::istringstream defaults(
      "--count 1000 --fraction 0.55 --pairs near_contact --delta 1e-3 --roughness 0 --drag 1 "
      "--friction 0 --range 0.5 --seed 1 --strain-step 0.01 --strain 0.5 --steps 20 --threads 1 "
      "--states . --write -");
  for (std::string name, value; defaults >> name >> value;) options.texts[name] = value;
  for (int i = 1; i < argc; i += 2) {
    if (!options.texts.contains(argv[i]) || i + 1 >= argc) {
      fmt::print(stderr, "suspension: no option '{}', or no value\n", argv[i]);
      return 2;
    }
    options.texts[argv[i]] = argv[i + 1];
  }
  const auto setting = setting_of(options);
  auto first = sheared(options, setting);
  if (options.texts["--write"] != "-")
    write_for_lf_dem(options.texts["--write"], options, setting, first);
  const auto count = static_cast<double>(options.count());
  const int threads = std::stoi(options.texts["--threads"]),
            steps = std::stoi(options.texts["--steps"]);

  const double before = start_of_memory();
  SuspensionSimulation simulation(setting, std::move(first), threads);
  int iterations = 0, taken = 0, halved = 0, unconverged = 0;
  double solutions = 0, contacts = 0, viscosity = 0, overlap = 0, longest = 0;
  const auto start = now();
  for (; taken < steps; ++taken) {
    const double from = now().cpu;
    const auto report = simulation.step(1e300);
    longest = std::max(longest, now().cpu - from);
    iterations += report.iterations;
    overlap = std::max(overlap, report.largest_overlap);
    if (!report.converged) ++unconverged;
    if (simulation.state().earlier_step < 0.99 * setting.time_step) ++halved;
    const auto& rheology = simulation.rheology();
    solutions += rheology.solutions;
    contacts += static_cast<double>(rheology.contacts);
    viscosity += rheology.viscosity;
  }
  const auto end = now();
  const double cpu = (end.cpu - start.cpu) / taken, elapsed = (end.elapsed - start.elapsed) / taken;
  const double peak = memory("VmHWM") - before;
  solutions /= taken;
  const double products = static_cast<double>(iterations) / taken;

  // The parts alone, at the last state.
  ThreadPool pool(1);
  const auto& state = simulation.state();
  Particles p;
  for (const auto k : suspensions::spatial_order(state.particles.positions)) {
    const Vector x = state.particles.position(static_cast<std::size_t>(k));
    p.positions.insert(p.positions.end(), x.begin(), x.end());
    p.radii.push_back(state.particles.radii[static_cast<std::size_t>(k)]);
  }
  suspensions::ShearedCell cell;
  cell.lengths = periods_of(setting.domain);
  cell.offset = state.shear.offset;
  std::vector<suspensions::NearPair> pairs;
  const double search = seconds_of([&] {
    pairs = suspensions::near_pairs(cell, p.positions, p.radii, setting.lubrication->range);
  });
  const auto placed = suspensions::placed(pairs, p.radii, 1e-12);
  const double terms =
      seconds_of([&] { suspensions::PairSystem(*setting.lubrication, p.radii, placed, pool); });
  const suspensions::PairSystem system(*setting.lubrication, p.radii, placed, pool);
  const auto& resistance = system.resistance();
  std::vector<suspensions::Motion> motions(p.count()), loads(p.count());
  std::ranges::fill(motions, suspensions::Motion{{1, 2, 3, 0}, {1, 2, 3, 0}});
  const double product = seconds_of([&] { resistance.multiply(motions, loads); });
  const double order = seconds_of([&] { suspensions::StrongPairs(resistance, pool); });
  suspensions::BlockPreconditioner preconditioner;
  preconditioner.set(resistance, pool);
  const double blocks = seconds_of([&] { preconditioner.set(resistance, pool); });
  suspensions::ConjugateGradients gradients(pool);
  system.subtract_strain_loads(suspensions::strain_rate_of(setting.lubrication->gradient), loads);
  const double per_iteration =
      seconds_of([&] {
        std::ranges::fill(motions, suspensions::Motion{});
        gradients.solve(resistance, preconditioner, loads, motions, {}, 20);
      }) /
      20;

  fmt::print(
      "N={} pairs={} threads={} fraction={} friction={}: s/step cpu={:.4f} elapsed={:.4f} "
      "longest={:.4f} "
      "solutions={:.2f} iterations={:.1f} pairs/sphere={:.2f} contacts/sphere={:.3f} "
      "viscosity={:.12f} "
      "overlap={:.1e} unconverged={} halved={} strain={:.3f} B/sphere={:.0f}\n",
      p.count(), options.texts["--pairs"], threads, options.texts["--fraction"],
      options.texts["--friction"], cpu, elapsed, longest, solutions, products,
      static_cast<double>(pairs.size()) / count, contacts / taken / count, viscosity / taken,
      overlap, unconverged, halved, state.shear.strain, peak / count);
  const auto share = [&](double seconds, double times) { return 100 * seconds * times / cpu; };
  fmt::print(
      "one call, ms: search={:.3f} terms={:.3f} order={:.3f} blocks={:.3f} product={:.4f} ({:.1f} "
      "ns a pair) iteration={:.4f}; shares of a step: search {:.0f} %, terms {:.0f} %, order "
      "{:.0f} %, blocks {:.0f} % at most, products {:.0f} %, rest of iterations {:.0f} %\n",
      1e3 * search, 1e3 * terms, 1e3 * order, 1e3 * blocks, 1e3 * product,
      1e9 * product / static_cast<double>(pairs.size()), 1e3 * per_iteration,
      share(search, kSearches), share(terms, kPlacements), share(order, kPlacements),
      share(blocks, solutions), share(product, products), share(per_iteration - product, products));
}
