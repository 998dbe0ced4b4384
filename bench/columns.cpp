// Columns of equal discs or spheres under gravity, and chains that are pushed at one end:
// iterations, CPU time and relative error of gamma. Radii, masses and gravity are 1.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ctime>

#include "viscontact/contact_dynamics/simulation.hpp"

namespace {

using namespace viscontact::particles;

State chain(int dimension, int count) {
  State state;
  auto& p = state.particles;
  p.dimension = dimension;
  for (int k = 0; k < count; ++k) {
    p.positions.insert(p.positions.end(), {0, 1.0 + 2 * k});
    if (dimension == 3) p.positions.push_back(0);
  }
  p.velocities.assign(p.positions.size(), 0.0);
  p.radii.assign(static_cast<std::size_t>(count), 1.0);
  p.masses = p.radii;
  return state;
}

double cpu_seconds() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

void run(int dimension, int count, bool column) {
  Setting setting;
  setting.time_step = 0.01;
  if (column) {
    Plane floor;
    floor.start = {{}, {0, 1, 0}};
    setting.planes = {floor};
    setting.gravity = {0, -1, 0};
  } else {
    setting.forces[0].pieces = {{1e9, {0, 1, 0}}};
  }
  Simulation simulation(setting, chain(dimension, count), 1);
  constexpr int kSteps = 10;
  int first = 0, most = 0, unconverged = 0;
  const double begin = cpu_seconds();
  for (int n = 0; n < kSteps; ++n) {
    const auto report = simulation.step(1e9);
    if (n == 0) first = report.iterations;
    most = std::max(most, n == 0 ? 0 : report.iterations);
    unconverged += report.converged ? 0 : 1;
  }
  const double seconds = cpu_seconds() - begin;
  // The exact impulse of a contact is the weight of the particles beyond the contact, or their
  // share of the pushing force, times the time.
  double error = 0;
  const double t = kSteps * setting.time_step;
  for (const auto& film : simulation.state().pairs) {
    if (film.second != film.first + 1) continue;
    const double beyond = count - film.second;
    error = std::max(error, std::abs(film.gamma / (-t * (column ? beyond : beyond / count)) - 1));
  }
  fmt::print("{:8}  {}D  {:6}  {:6} {:6}  {:9.3f}  {:8.1e}  {}\n", column ? "column" : "pushed",
             dimension, count, first, most, 1e3 * seconds / kSteps, error, unconverged);
}

}  // namespace

int main() {
  fmt::print("                  iterations\n");
  fmt::print("                 first  later   CPU ms/step  error of gamma  not converged\n");
  for (const bool column : {true, false})
    for (const int dimension : {2, 3})
      for (const int count : {10, 100, 1000, 10'000}) run(dimension, count, column);
}
