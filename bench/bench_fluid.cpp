// Accuracy and cost of the FreeFEM fluid solver: errors of velocities, the ratio to the lecture's
// mesh at equal CPU time, and a step with many discs. Viscosity and radius are 1.
#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "tests/common/temporary_folder.hpp"
#include "tests/freefem_flow/accuracy/exact_flows.hpp"
#include "tests/freefem_flow/placed_flow.hpp"
#include "viscontact/particle_runs/case/particles_case.hpp"

namespace {

using namespace viscontact;
using namespace viscontact::freefem_flow;
using particles::DiscDomain;
using particles::RigidConstraint;

/// CPU seconds of child processes that have ended.
double cpu_seconds_of_children() {
  rusage usage{};
  getrusage(RUSAGE_CHILDREN, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

/// CPU seconds of the solvers that run within `work` and end with it.
double cpu_seconds(const std::function<void()>& work) {
  const double begin = cpu_seconds_of_children();
  work();
  return cpu_seconds_of_children() - begin;
}

double error_of(const std::vector<double>& values, const std::vector<double>& exact) {
  double error = 0, largest = 0;
  for (std::size_t i = 0; i < exact.size(); ++i) {
    error = std::max(error, std::abs(values[i] - exact[i]));
    largest = std::max(largest, std::abs(exact[i]));
  }
  return error / largest;
}

struct Arrangement {
  std::string name;
  double container;  ///< radius
  std::vector<Body> discs;
  std::vector<double> forces;
  std::vector<double> exact;  ///< velocities; empty: computed on a fine mesh
};

std::vector<Arrangement> arrangements() {
  const double first = concentric_mobility(5);
  std::vector<Arrangement> all = {{"one disc, R = 5", 5, {{}}, {1, 0, 0}, {first, 0, 0}}};
  for (const double gap : {0.1, 0.02}) {
    const double x = 1 + gap / 2;
    const auto name = [&](const char* what) { return fmt::format("{}, gap {}", what, gap); };
    all.push_back({name("two, squeezed"), 6, {{-x, 0}, {x, 0}}, {1, 0, 0, -1, 0, 0}, {}});
    all.push_back({name("two, across"), 6, {{-x, 0}, {x, 0}}, {0, 1, 0, 0, -1, 0}, {}});
    std::vector<Body> seven = {{}};
    std::vector<double> forces = {0, -1, 0};
    for (int k = 0; k < 6; ++k) {
      const double angle = k * std::numbers::pi / 3;
      seven.push_back({2 * x * std::cos(angle), 2 * x * std::sin(angle)});
      forces.insert(forces.end(), {std::sin(3.0 * k), -1, 0.1 * k});
    }
    all.push_back({name("seven"), 6, seven, forces, {}});
  }
  return all;
}

void print_errors() {
  fmt::print("errors of velocities relative to the largest: extrapolated; of one mesh\n");
  fmt::print("{:22} {:8} {:>22} {:>22} {:>22}\n", "", "", "12 edges", "24 edges", "48 edges");
  for (auto& [name, container, discs, forces, exact] : arrangements()) {
    const DiscDomain domain = {{}, container};
    auto reference = exact;
    if (reference.empty())
      reference = PlacedFlow(fluid_with(64, RigidConstraint::kRigid), domain, discs)
                      .estimate(forces)
                      .velocities;
    for (const auto constraint : {RigidConstraint::kPenalty, RigidConstraint::kRigid}) {
      fmt::print("{:22} {:8}", name, constraint == RigidConstraint::kRigid ? "rigid" : "penalty");
      for (const int edges : {12, 24, 48}) {
        PlacedFlow flow(fluid_with(edges, constraint), domain, discs);
        const double of_one = error_of(flow.velocities(forces), reference);
        const auto estimated = flow.estimate(forces);
        fmt::print("      {:8.1e} {:8.1e}", error_of(estimated.velocities, reference), of_one);
        std::fflush(stdout);
      }
      fmt::print("\n");
    }
  }
}

struct Cost {
  int edges;
  double error, seconds;  ///< relative error of velocities, CPU time [s]
};

/// One disc off the centre of a round container, pulled; the reference is exact to 12 digits.
Cost cost_of(particles::FluidMesh mesh, int edges) {
  auto fluid = fluid_with(edges);
  fluid.mesh = mesh;
  Cost cost{edges, 0, 0};
  cost.seconds = cpu_seconds([&] {
    PlacedFlow flow(fluid, DiscDomain{{}, 5}, {{1, 0}});
    const std::vector<double> forces = {1, 0, 0};
    const bool extrapolated = mesh == particles::FluidMesh::kFitted;
    const auto v = extrapolated ? flow.estimate(forces).velocities : flow.velocities(forces);
    cost.error = error_of(v, {0.0517479643038846, 0, 0});
  });
  return cost;
}

void print_ratio_to_fixed_mesh() {
  using particles::FluidMesh;
  std::vector<Cost> fitted;
  for (const int edges : {8, 12, 16, 24, 32, 48}) {
    fitted.push_back(cost_of(FluidMesh::kFitted, edges));
    fmt::print("fitted, extrapolated {:4} edges: error {:8.1e}, {:6.2f} CPU s\n", edges,
               fitted.back().error, fitted.back().seconds);
  }
  for (const int edges : {24, 48, 96}) {
    const auto fixed = cost_of(FluidMesh::kFixed, edges);
    double best = 1;
    for (const auto& cost : fitted)
      if (cost.seconds <= fixed.seconds) best = std::min(best, cost.error);
    fmt::print(
        "fixed {:19} edges: error {:8.1e}, {:6.2f} CPU s; {:.0f} times that of the best "
        "fitted mesh in this time\n",
        edges, fixed.error, fixed.seconds, fixed.error / best);
  }
}

/// Discs at random in a box with four walls, as [arrangement] makes them.
std::vector<Body> random_discs(int count, double side) {
  const TemporaryFolder folder;
  const auto file = folder.file(
      "case.toml",
      fmt::format("title = \"Discs\"\n[space]\ndimension = 2\n[fluid]\nviscosity = 1.0\n"
                  "[domain]\nbox = {{ from = [0.0, 0.0], to = [{0}, {0}] }}\n"
                  "[viscous_contact]\ntime_step = 0.1\nend_time = 1.0\n"
                  "[arrangement]\ncount = {1}\nradius = 1.0\nsmallest_gap = 0.1\n",
                  side, count));
  const auto c = particles::read_particles_case(file);
  std::vector<Body> discs;
  for (std::size_t k = 0; k < c.particles.count(); ++k)
    discs.push_back({c.particles.position(k)[0], c.particles.position(k)[1]});
  return discs;
}

void print_steps(int most) {
  fmt::print(
      "a step of discs of 12 edges, area fraction 0.3, gaps from 0.1: CPU seconds of the step, of "
      "one more right-hand side\n");
  for (const int count : {49, 100, 400, 1024}) {
    if (count > most) break;
    const double side = std::ceil(std::sqrt(count * std::numbers::pi / 0.3));
    const auto discs = random_discs(count, side);
    for (const auto constraint : {RigidConstraint::kPenalty, RigidConstraint::kRigid}) {
      const auto fluid = fluid_with(12, constraint);
      const particles::BoxDomain box = {{0, 0}, {side, side}, {}};
      std::vector<double> forces(3 * discs.size());
      for (std::size_t i = 0; i < forces.size(); ++i) forces[i] = std::sin(static_cast<double>(i));
      double memory = 0;
      std::size_t unknowns = 0;
      // Each step with more than 4000 unknowns starts FreeFEM, and the time of this belongs to it.
      const double step = cpu_seconds([&] {
        PlacedFlow flow(fluid, box, discs);
        flow.velocities(forces);
        flow.solver().quantities();
      });
      constexpr int kMore = 10;
      const double with_more = cpu_seconds([&] {
        PlacedFlow flow(fluid, box, discs);
        flow.velocities(forces);
        flow.solver().quantities();
        for (int i = 0; i < kMore; ++i) flow.solver().velocities(forces, false);
        unknowns = flow.solver().unknowns();
        memory = flow.solver().peak_memory_mebibytes();
      });
      const double more = (with_more - step) / kMore;
      fmt::print("{:5} {:8} {:7} unknowns: {:6.2f} CPU s, {:6.3f} s (1/{:.0f}), {:5.0f} MiB\n",
                 count, constraint == RigidConstraint::kRigid ? "rigid" : "penalty", unknowns, step,
                 more, step / more, memory);
      std::fflush(stdout);
    }
  }
}

}  // namespace

/// bench_fluid [errors | ratio | steps [MOST_DISCS]]; all without an argument.
int main(int argc, char** argv) {
  const std::string what = argc > 1 ? argv[1] : "all";
  if (what == "all" || what == "errors") print_errors();
  if (what == "all" || what == "ratio") print_ratio_to_fixed_mesh();
  if (what == "all" || what == "steps") print_steps(argc > 2 ? std::atoi(argv[2]) : 1024);
}
