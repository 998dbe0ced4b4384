// Spheres or discs with friction are poured into a box until they rest: CPU time, accuracy and the
// packing that results. bench/liggghts_packing runs LIGGGHTS from the same start.
#include <fmt/format.h>
#include <fmt/os.h>
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <map>
#include <numbers>
#include <random>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "viscontact/common/system/memory.hpp"
#include "viscontact/contact_dynamics/simulation.hpp"
#include "viscontact/particles/steps/current_contacts.hpp"

namespace {

using namespace viscontact::particles;

constexpr double kGravity = 9.81;  // [m/s^2]

/// In kg/m^3 or, of discs, in kg/m^2: a disc of radius 1.2 mm is as heavy as such a sphere.
double density(const Particles& p) { return p.dimension == 2 ? 4 : 2500; }

double cpu_seconds() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

double height(const Particles& p, std::size_t k) {
  return p.position(k)[static_cast<std::size_t>(p.dimension - 1)];
}

/// Area of a disc, volume of a sphere.
double solid(const Particles& p, std::size_t k) {
  const double r = p.radii[k];
  return std::numbers::pi * r * r * (p.dimension == 2 ? 1 : 4 * r / 3);
}

/// Particles at rest on a jittered lattice between the walls. Radii are uniform.
Particles start(int count, int dimension, std::uint64_t seed, double least, double largest,
                double width) {
  std::mt19937_64 random(seed);
  const auto uniform = [&](double from, double to) {
    return from + (to - from) * static_cast<double>(random() >> 11) * 0x1p-53;
  };
  const int columns = std::max(1, static_cast<int>(width / (2.1 * largest)));
  const double spacing = width / columns;
  const double jitter = 0.98 * std::max(spacing / 2 - largest, 0.0);
  Particles p;
  p.dimension = dimension;
  for (int k = 0; k < count; ++k) {
    p.radii.push_back(uniform(least, largest));
    p.masses.push_back(density(p) * solid(p, p.radii.size() - 1));
    int place = k;
    for (int d = 0; d + 1 < dimension; ++d, place /= columns)
      p.positions.push_back((place % columns + 0.5) * spacing + uniform(-jitter, jitter));
    p.positions.push_back((place + 0.5) * std::max(spacing, 2.15 * largest) +
                          uniform(-0.035, 0.035) * largest);
  }
  p.velocities.assign(p.positions.size(), 0.0);
  return p;
}

/// A floor and two or four walls, and gravity.
Setting box(int dimension, double width) {
  Setting setting;
  const auto up = static_cast<std::size_t>(dimension - 1);
  const auto add_plane = [&](std::size_t axis, double at, double inwards) {
    Vector point{}, normal{};
    point[axis] = at;
    normal[axis] = inwards;
    setting.planes.emplace_back().start = {point, normal};
  };
  add_plane(up, 0, 1);
  for (std::size_t axis = 0; axis < up; ++axis)
    for (const double at : {0.0, width}) add_plane(axis, at, at > 0 ? -1 : 1);
  setting.gravity[up] = -kGravity;
  return setting;
}

/// The sum of value(k) over all particles.
double sum(const Particles& p, const auto& value) {
  double result = 0;
  for (std::size_t k = 0; k < p.count(); ++k) result += value(k);
  return result;
}

/// The sum of m g r [J], the unit of energies.
double unit_energy(const Particles& p) {
  return sum(p, [&](std::size_t k) { return p.masses[k] * kGravity * p.radii[k]; });
}

/// The translational energy, in units of unit_energy().
double energy(const Particles& p) {
  const auto of = [&](std::size_t k) { return p.masses[k] * std::pow(norm(p.velocity(k)), 2) / 2; };
  return sum(p, of) / unit_energy(p);
}

/// Solids over the area of the floor and twice the height of their centre of mass.
double packing_fraction(const Particles& p, double width) {
  const double solids = sum(p, [&](std::size_t k) { return solid(p, k); });
  const double moment = sum(p, [&](std::size_t k) { return solid(p, k) * height(p, k); });
  return solids * solids / ((p.dimension == 2 ? width : width * width) * 2 * moment);
}

/// Writes the start as LIGGGHTS reads it. The first line, a comment, has the width of the box [m]
/// and the mean of m g r [J].
void write_data(const std::string& file, const Particles& p, double width) {
  auto out = fmt::output_file(file);
  const double room = 2 * *std::ranges::max_element(p.radii);  // because atoms may overlap walls
  const double top = height(p, p.count() - 1);
  out.print("width {} energy {}\n\n{} atoms\n1 atom types\n", width,
            unit_energy(p) / static_cast<double>(p.count()), p.count());
  for (int d = 0; d < 3; ++d) {
    const double end = d + 1 < p.dimension ? width : d + 1 == p.dimension ? top : 0;
    out.print("{0} {1} {2}lo {2}hi\n", -room, end + room, "xyz"[d]);
  }
  out.print("\nAtoms\n\n");
  for (std::size_t k = 0; k < p.count(); ++k)
    out.print("{} 1 {} {} {}\n", k + 1, 2 * p.radii[k], density(p), fmt::join(p.position(k), " "));
}

/// Vertical forces over the weight of all particles; other forces are over that of their particle.
struct Forces {
  double on_floor = 0, on_walls = 0;  // floor included
  double momentum = 0;                // rate of change of the vertical momentum of all particles
  double balance = 0;                 // largest mass x acceleration - contacts - weight
  double net = 0, largest_net = 0;    // mass x acceleration: mean, largest
  double coordination = 0;            // mean number of contacts that push, with walls
};

/// Of the last step. `before` are the particles before it, whose places give its normals.
Forces forces(const Setting& setting, const State& state, const Particles& before) {
  const auto& p = state.particles;
  const auto count = static_cast<double>(p.count());
  const Vector upwards = -1 / kGravity * setting.gravity;
  std::vector<Vector> left(p.count());  // net force - weight - contacts
  Forces result;
  double weight = 0;
  for (std::size_t k = 0; k < p.count(); ++k) {
    const Vector net = p.masses[k] / state.earlier_step * (p.velocity(k) - before.velocity(k));
    const double own = kGravity * p.masses[k], over_own = norm(net) / own;
    left[k] = net + own * upwards;
    weight += own;
    result.momentum += dot(net, upwards);
    result.net += over_own / count;
    result.largest_net = std::max(result.largest_net, over_own);
  }
  for (const auto& contact : contacts_of(setting, state)) {
    const bool at_wall = contact.first < 0;
    const auto i = static_cast<std::size_t>(std::max(contact.first, 0));
    const auto j = static_cast<std::size_t>(contact.second);
    const Vector apart = before.position(j) - before.position(i);
    const Vector normal = at_wall ? contact.normal : 1 / norm(apart) * apart;
    const Vector force = contact.normal_force * normal + contact.tangential_force;
    left[j] = left[j] - force;
    if (!at_wall) left[i] = left[i] + force;
    if (at_wall) result.on_walls += dot(force, upwards);
    if (contact.first == -1) result.on_floor += dot(force, upwards);
    if (contact.normal_force > 0) result.coordination += (at_wall ? 1 : 2) / count;
  }
  for (std::size_t k = 0; k < p.count(); ++k)
    result.balance = std::max(result.balance, norm(left[k]) / (kGravity * p.masses[k]));
  for (double* sum : {&result.on_floor, &result.on_walls, &result.momentum}) *sum /= weight;
  return result;
}

struct Tally {  // of steps
  int steps = 0, unconverged = 0, divided = 0, most_iterations = 0;
  double cpu = 0, longest = 0, iterations = 0, overlap = 0;
  void add(const StepReport& report, double seconds) {
    ++steps;
    unconverged += report.converged ? 0 : 1;
    divided += report.parts > 1 ? 1 : 0;
    iterations += report.iterations;
    most_iterations = std::max(most_iterations, report.iterations);
    cpu += seconds;
    longest = std::max(longest, seconds);
    overlap = std::max(overlap, report.largest_overlap);
  }
};

}  // namespace

// packing [OPTION VALUE]..., with the options and values below, and --radii LEAST LARGEST, in m, kg
// and s. Particles rest when their mean translational energy has fallen below --rest m g r. Then
// --settled more steps are timed, and after these the first ten steps of the same packing with
// radii --closed times as large, from rest and without impulses of earlier steps. --write FILE
// writes the start for LIGGGHTS.
int main(int argc, char** argv) {
  viscontact::keep_freed_memory();  // as the program does
  std::map<std::string, std::string> o;
  std::istringstream defaults(
      "--count 500 --dimension 3 --seed 1 --time-step 5e-4 --friction 0.5 --method convex "
      "--tolerance 1e-4 --impulse-tolerance 1e-3 --radii 1e-3 --largest 1.4e-3 --gamma-min 0 "
      "--until 2 --rest 1e-5 --print 0.05 --settled 0 --closed 0 --write -");
  for (std::string name, value; defaults >> name >> value;) o[name] = value;
  for (int i = 1; i < argc; i += 2) {
    const std::string name = argv[i];
    if (!o.contains(name) || i + (name == "--radii" ? 2 : 1) >= argc) {
      fmt::print(stderr, "packing: no option '{}', or no value\n", name);
      return 2;
    }
    o[name] = argv[i + 1];
    if (name == "--radii") o["--largest"] = argv[++i + 1];
  }
  const bool is_convex = o["--method"] == "convex";
  const bool is_plane = o["--dimension"] == "2";
  if ((!is_plane && o["--dimension"] != "3") || (!is_convex && o["--method"] != "coulomb")) {
    fmt::print(stderr, "packing: --dimension must be 2 or 3, --method convex or coulomb\n");
    return 2;
  }
  const auto number = [&](const char* option) { return std::stod(o[option]); };
  const int dimension = is_plane ? 2 : 3, count = std::stoi(o["--count"]);
  const double least = number("--radii"), largest = number("--largest");
  const double width =
      largest / 1.4e-3 *
      (is_plane ? 0.074 * std::sqrt(count / 1000.0) : 0.02 * std::cbrt(count / 500.0));
  auto setting = box(dimension, width);
  setting.time_step = number("--time-step");
  setting.laws.film.gamma_min = number("--gamma-min");
  setting.solver = SolverSettings::for_packings();
  setting.solver.tolerance = number("--tolerance");
  setting.solver.impulse_tolerance = number("--impulse-tolerance");
  const double friction = number("--friction");
  if (friction > 0)
    setting.laws.friction =
        FrictionLaw{friction, is_convex ? FrictionMethod::kConvex : FrictionMethod::kCoulomb};
  State first;
  first.particles = start(count, dimension, std::stoull(o["--seed"]), least, largest, width);
  if (friction > 0) add_rotation(first.particles);
  if (o["--write"] != "-") write_data(o["--write"], first.particles, width);

  Simulation simulation(setting, std::move(first), 1);
  const auto& state = simulation.state();
  const double until = number("--until"), rest = number("--rest");
  Tally all, shown;
  Forces last;
  double balance = 0;  // the largest of all steps
  const auto step = [&](double end) {
    const auto before = state.particles;
    const double from = cpu_seconds();
    const auto report = simulation.step(end);
    const double took = cpu_seconds() - from;
    last = forces(setting, state, before);
    if (report.parts == 1) balance = std::max(balance, last.balance);  // parts have own normals
    for (auto* tally : {&all, &shown}) tally->add(report, took);
    return took;
  };
  bool has_fallen = false, rests = false;  // at the start the particles have no energy either
  double next = number("--print");
  fmt::print("t       CPU ms/step  longest  iterations  most  not converged  overlap  energy\n");
  while (!rests && state.time < until * (1 - 1e-9)) {
    step(until);
    const double now = energy(state.particles);
    has_fallen = has_fallen || now > rest;
    rests = has_fallen && now < rest;
    if (!rests && state.time < std::min(next, until) * (1 - 1e-9)) continue;
    fmt::print("{:.4f}  {:11.3f}  {:7.2f}  {:10.1f}  {:4}  {:13}  {:.1e}  {:.1e}\n", state.time,
               1e3 * shown.cpu / shown.steps, 1e3 * shown.longest, shown.iterations / shown.steps,
               shown.most_iterations, shown.unconverged, shown.overlap, now);
    std::fflush(stdout);  // shows the line at once, because a run can be long
    shown = {};
    next += number("--print");
  }
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  fmt::print(
      "count={} seed={} rests={} t={:.4f} cpu_s={:.3f} steps={} iterations={:.1f} most={} "
      "unconverged={} divided={} longest_s={:.4f} fraction={:.5f} coordination={:.3f} floor={:.5f} "
      "walls-1={:.1e} momentum={:.1e} balance={:.1e} net={:.1e} largest_net={:.1e} "
      "overlap={:.1e} overlap_at_end={:.1e} MiB={}",
      count, o["--seed"], rests ? "yes" : "no", state.time, all.cpu, all.steps,
      all.iterations / all.steps, all.most_iterations, all.unconverged, all.divided, all.longest,
      packing_fraction(state.particles, width), last.coordination, last.on_floor, last.on_walls - 1,
      last.momentum, balance, last.net, last.largest_net, all.overlap,
      largest_overlap(setting, state), usage.ru_maxrss / 1024);
  if (std::vector<double> took(std::stoul(o["--settled"])); rests && !took.empty()) {
    for (auto& seconds : took) seconds = step(state.time + 1);
    std::ranges::sort(took);
    fmt::print(" settled_ms={:.3f}", 1e3 * took[took.size() / 2]);
  }
  if (const double factor = number("--closed"); rests && factor > 0) {
    State still;
    still.particles = state.particles;
    for (auto& radius : still.particles.radii) radius *= factor;
    std::ranges::fill(still.particles.velocities, 0.0);
    std::ranges::fill(still.particles.angular_velocities, 0.0);
    Simulation closed(setting, std::move(still), 1);
    Tally cold;
    for (int k = 0; k < 10; ++k) {
      const double from = cpu_seconds();
      const auto report = closed.step(10 * setting.time_step);
      cold.add(report, cpu_seconds() - from);
    }
    fmt::print(" closed_longest_ms={:.3f} closed_most={} closed_unconverged={}", 1e3 * cold.longest,
               cold.most_iterations, cold.unconverged);
  }
  fmt::print("\n");
}
