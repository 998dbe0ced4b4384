// Many particles: N discs or spheres fall into a box. CPU time [s], iterations, residual (in mean
// radii) and memory for each STRETCH of time; in the end the stages of the contact solver.
#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <map>
#include <sstream>
#include <string>
#include <utility>

#include "tests/contact_dynamics/box2d/box2d_case.hpp"
#include "viscontact/common/system/memory.hpp"
#include "viscontact/particles/steps/current_contacts.hpp"

namespace {

using namespace viscontact::particles;

double kinetic_energy(const Particles& p) {
  double energy = 0;
  for (std::size_t k = 0; k < p.count(); ++k)
    energy += p.masses[k] * dot(p.velocity(k), p.velocity(k)) / 2;
  return energy;
}

double cpu_seconds() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

/// Adds the iterations in a text such as "sweeps:60+proximal_steps:12".
void add_stages(const std::string& text, std::map<std::string, double>& stages) {
  std::istringstream words(text);
  for (std::string word; std::getline(words, word, '+');) {
    const auto colon = word.find(':');
    stages[word.substr(0, colon)] += std::stod(word.substr(colon + 1));
  }
}

}  // namespace

// box2d [--count N] [--until T] [--max-iterations K] [--tolerance X] [--impulse-tolerance X]
//       [--threads N] [--print STRETCH] [--friction MU] [--method coulomb|convex]
//       [--gamma-min G] [--dimension 2|3] [--sides walls|periodic]
//
// The discs start on a lattice of spacing 2.1 with random displacements up to 0.05, in a box of
// width 2.1 ceil(sqrt N) with a floor and two walls. Radii are 0.8 to 1, m = r^2, gravity is 1, the
// time step is 0.05. Spheres (m = r^3) start in the same way in a cube of width 2.1 (N^(1/3)) with
// a floor and four walls. With `--sides periodic` only the floor is there.
int main(int argc, char** argv) {
  viscontact::keep_freed_memory();  // as the program does
  std::map<std::string, std::string> o = {{"--count", "1000"},
                                          {"--until", "10"},
                                          {"--max-iterations", "10000"},
                                          {"--tolerance", "1e-6"},
                                          {"--impulse-tolerance", "1e-10"},
                                          {"--threads", "1"},
                                          {"--print", "2.5"},
                                          {"--friction", "0"},
                                          {"--method", "coulomb"},
                                          {"--dimension", "2"},
                                          {"--sides", "walls"},
                                          {"--gamma-min", "-2"}};
  for (int i = 1; i < argc; i += 2) {
    if (!o.contains(argv[i]) || i + 1 == argc) {
      fmt::print(stderr, "box2d: no option '{}', or no value\n", argv[i]);
      return 2;
    }
    o[argv[i]] = argv[i + 1];
  }
  const auto refuse = [&](const std::string& option, const char* allowed) {
    fmt::print(stderr, "box2d: {} is '{}'; it must be {}\n", option, o[option], allowed);
    return 2;
  };
  if (o["--dimension"] != "2" && o["--dimension"] != "3") return refuse("--dimension", "2 or 3");
  if (o["--method"] != "coulomb" && o["--method"] != "convex")
    return refuse("--method", "coulomb or convex");
  if (o["--sides"] != "walls" && o["--sides"] != "periodic")
    return refuse("--sides", "walls or periodic");
  const int count = std::stoi(o["--count"]);
  const int dimension = std::stoi(o["--dimension"]);
  auto setting = box(count, dimension);
  setting.solver = {std::stod(o["--tolerance"]), std::stod(o["--impulse-tolerance"]),
                    std::stoi(o["--max-iterations"])};
  setting.laws.film.gamma_min = std::stod(o["--gamma-min"]);
  auto particles = particles_in_box(count, dimension);
  if (o["--sides"] == "periodic") {
    const double width = setting.planes[2].start.point[0];
    setting.planes.resize(1);  // the floor
    for (std::size_t d = 0; d + 1 < static_cast<std::size_t>(dimension); ++d)
      particles.particles.cell.lengths[d] = width;
  }
  if (const double friction = std::stod(o["--friction"]); friction > 0) {
    const bool is_convex = o["--method"] == "convex";
    setting.laws.friction =
        FrictionLaw{friction, is_convex ? FrictionMethod::kConvex : FrictionMethod::kCoulomb};
    add_rotation(particles.particles);
  }
  const double until = std::stod(o["--until"]), stretch = std::stod(o["--print"]);
  Simulation simulation(setting, std::move(particles), std::stoi(o["--threads"]));
  double shown = 0, all = 0, worst_overlap = 0;
  std::map<std::string, double> stages;  // iterations of the methods of the contact solver
  int steps = 0, iterations = 0, unconverged = 0, all_unconverged = 0, all_steps = 0;
  double spent = 0, residual = 0, longest = 0, contact_iterations = 0;
  fmt::print(
      "t             CPU ms/step  longest  iterations  contacts  glued  residual  not converged  "
      "kinetic energy\n");
  while (simulation.state().time < until * (1 - 1e-9)) {
    const double before = cpu_seconds();
    const auto report = simulation.step(until);
    const double took = cpu_seconds() - before;
    spent += took;
    all += took;
    longest = std::max(longest, took);
    ++steps;
    ++all_steps;
    iterations += report.iterations;
    add_stages(report.solver_stages, stages);
    contact_iterations += static_cast<double>(report.contacts) * report.iterations;
    residual = std::max(residual, report.residual);
    unconverged += report.converged ? 0 : 1;
    all_unconverged += report.converged ? 0 : 1;
    worst_overlap = std::max(worst_overlap, report.largest_overlap);
    if (report.time >= shown + stretch * (1 - 1e-9) || report.time >= until * (1 - 1e-9)) {
      fmt::print(
          "{:6.2f}-{:6.2f}  {:10.3f}  {:7.2f}  {:10.1f}  {:8}  {:5}  {:.1e}  {:13}  {:.1e}\n",
          shown, report.time, 1e3 * spent / steps, 1e3 * longest, double(iterations) / steps,
          report.contacts, report.glued, residual, unconverged,
          kinetic_energy(simulation.state().particles));
      std::fflush(stdout);  // shows the line at once, because a run can be long
      shown = report.time;
      spent = residual = longest = 0;
      steps = iterations = unconverged = 0;
    }
  }
  fmt::print("iterations of all steps and sets:");
  for (const auto& [stage, taken] : stages) fmt::print(" {} {:.0f}", stage, taken);
  fmt::print("\n");
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  fmt::print(
      "N = {}: {:.3f} ms CPU a step, {:.1f} ns a disc and step; {} of {} steps not converged; "
      "largest overlap {:.1e} mean radii, at the end {:.1e}; {:.1f} ns a contact and iteration; "
      "{:.0f} MiB, {:.0f} bytes a disc\n",
      count, 1e3 * all / all_steps, 1e9 * all / all_steps / count, all_unconverged, all_steps,
      worst_overlap, largest_overlap(setting, simulation.state()),
      1e9 * all / std::max(contact_iterations, 1.0), static_cast<double>(usage.ru_maxrss) / 1024,
      1024.0 * static_cast<double>(usage.ru_maxrss) / count);
}
