// Forces of the caller on particles: a spring draws nine discs to the origin, where they stay
// together by viscous contact (docs/physics.md (5.2), (5.3)).
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <exception>
#include <utility>

#include "viscontact/contact_dynamics/simulation.hpp"
#include "viscontact/particles/steps/current_contacts.hpp"

namespace {

namespace particles = viscontact::particles;

/// Nine discs of radius 1 [L] and mass 1 [M] at rest, in three rows of three discs. Neighbouring
/// centres have the distance 3 [L]. Units are any consistent ones.
particles::State discs_at_rest() {
  particles::State state;
  auto& p = state.particles;
  p.dimension = 2;
  for (int row = -1; row <= 1; ++row)
    for (int column = -1; column <= 1; ++column) {
      p.positions.insert(p.positions.end(), {3.0 * column, 3.0 * row});
      p.velocities.insert(p.velocities.end(), {0, 0});
      p.radii.push_back(1);
      p.masses.push_back(1);
    }
  return state;
}

/// Prints the time [T], the largest distance of a centre from the origin [L], and the number of
/// pairs of discs in contact.
void print_row(const particles::Simulation& simulation) {
  const auto& p = simulation.state().particles;
  double largest = 0;
  for (std::size_t k = 0; k < p.count(); ++k)
    largest = std::max(largest, particles::norm(p.position(k)));
  std::printf("%4.0f %18.6g %10zu\n", simulation.state().time, largest,
              particles::contacts_of(simulation.setting(), simulation.state()).size());
}

void run() {
  particles::Setting setting;
  // The last argument is the number of threads.
  setting.time_step = 0.01;
  particles::Simulation simulation(std::move(setting), discs_at_rest(), 1);

  // The forces [M L/T^2] that the caller sets: x and y for each disc, one disc after the other, 0
  // The forces [M L/T^2] that the caller sets: x and y for each disc, one disc after the other, 0
  // at first. They act in the next step with the values that they have when this step begins.
  const auto forces = simulation.added_forces();
  const double stiffness = 0.5;  // of the spring [M/T^2]
  std::printf("time   largest distance   contacts\n");
  print_row(simulation);
  for (int step = 1; step <= 400; ++step) {
    const auto& positions = simulation.state().particles.positions;
    std::ranges::transform(positions, forces.begin(), [&](double x) { return -stiffness * x; });
    // The argument is a time that the step must not pass [T]. step() throws Error(kNotConverged) if
    // the step cannot be computed.
    (void)simulation.step(4);
    if (step % 100 == 0) print_row(simulation);
  }
}

}  // namespace

// The comment before main() of smallest_gap.cpp says how to build the program. Then type
//
//   out/use_from_cpp/own_force
//
// The program prints this table, with which tests/package/use_installed compares its output. The
// largest distance is that of the centre of a disc from the origin.
//
//   time   largest distance   contacts
//      0            4.24264          0
//      1             3.2157          0
//      2            2.82843         12
//      3            2.82843         12
//      4            2.82843         12

int main() {
  try {
    run();
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
