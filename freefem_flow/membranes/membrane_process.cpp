// Asks FreeFEM with scripts/membranes.edp for Stokes flow around membranes and rigid discs.
#include "viscontact/freefem_flow/membranes/membrane_process.hpp"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <cassert>
#include <string>
#include <utility>
#include <vector>

#include "viscontact/common/error.hpp"
#include "viscontact/common/matrices/decompositions.hpp"
#include "viscontact/common/text/number.hpp"
#include "viscontact/freefem_flow/membranes/membrane_boundary.hpp"
#include "viscontact/freefem_flow/process/dissipation_alone.hpp"
#include "viscontact/freefem_flow/process/opening.hpp"
#include "viscontact/freefem_flow/process/solver_dialogue.hpp"
#include "viscontact/membranes/membrane_curve.hpp"
#include "viscontact/particles/domain/periods.hpp"

namespace viscontact::freefem_flow {
namespace {

using particles::Membrane;

constexpr std::size_t kComponents = 3;  // of the motion of a particle in the plane

/// Two matrices of 2 E rows and N columns between the N beads of a membrane and the 2 E nodes of
/// its E edges in the mesh: the ends and middles, so that a function on an edge is quadratic.
struct MembraneNodes {
  /// Takes positions of beads to those of nodes, by trigonometric interpolation.
  Eigen::MatrixXd sampling;
  /// Takes forces on beads to forces on nodes. Its transpose takes velocities of nodes to those of
  /// beads, by least squares along the edges, so that the power of forces is the same on both.
  Eigen::MatrixXd smoothing;
};

/// Both matrices. `edges` must be at least half of `beads`, so that the least squares have one
/// solution.
MembraneNodes nodes_of(int beads, int edges) {
  assert(beads > 0 && 2 * edges >= beads);
  MembraneNodes nodes;
  nodes.sampling.resize(2 * edges, beads);
  for (int i = 0; i < 2 * edges; ++i)
    for (int k = 0; k < beads; ++k)
      nodes.sampling(i, k) = particles::cardinal(
          beads, particles::kTwoPi * (i / (2.0 * edges) - static_cast<double>(k) / beads), 0);
  // The integrals of products of two quadratic basis functions over the edges, each divided by the
  // length of the edge.
  Eigen::MatrixXd mass = Eigen::MatrixXd::Zero(2 * edges, 2 * edges);
  const Eigen::Matrix3d own = (Eigen::Matrix3d() << 4, 2, -1, 2, 16, 2, -1, 2, 4).finished() / 30;
  for (int e = 0; e < edges; ++e)
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        mass((2 * e + i) % (2 * edges), (2 * e + j) % (2 * edges)) += own(i, j);
  const Eigen::MatrixXd weighted = mass * nodes.sampling;
  nodes.smoothing = weighted * (nodes.sampling.transpose() * weighted).inverse();
  return nodes;
}

class MembraneProcess : public particles::FluidSolver {
 public:
  MembraneProcess(const particles::Fluid& fluid, const particles::Domain& domain,
                  std::span<const double> radii, const SolverUnits& units, SolverCommand command,
                  const SolverLimits& limits);

  void place(const particles::FluidParticles& bodies) override;
  std::vector<double> velocities(std::span<const double> forces, bool driving) override;
  std::vector<double> mobility(std::size_t components) override;
  /// Of the last velocities() with `driving`, which must have been called.
  particles::FlowQuantities quantities() override {
    particles::FlowQuantities quantities;
    quantities.dissipation = dissipation_;
    if (dissipation_alone_ > 0) quantities.apparent_viscosity = dissipation_ / dissipation_alone_;
    quantities.fluid_forces = forces_of_fluid_;
    return quantities;
  }
  // Discs are rigid without a penalty, and there is no second mesh, so that no error is estimated.
  double vary_penalty() override { return 0; }
  particles::SecondMesh vary_mesh() override { return {}; }
  FlowField flow() override;
  std::size_t unknowns() const override { return unknowns_; }
  double peak_memory_mebibytes() const override {
    return static_cast<double>(std::max(peak_memory_kb_, solver_->peak_memory_kb())) / 1024;
  }

 private:
  /// Starts the process, instead of one that there is already, and sends the opening.
  void start();

  SolverCommand command_;
  SolverLimits limits_;
  std::string opening_, gradient_;  // the first requests; gradient_ may be empty
  particles::Domain domain_;
  SolverUnits units_;  // of the arguments
  std::vector<Membrane> membranes_;
  int edges_;                         // on each membrane
  int edges_of_disc_;                 // least number on each disc
  std::vector<MembraneNodes> nodes_;  // one for each of membranes_
  std::vector<double> radii_;         // of all particles
  std::vector<std::size_t> discs_;    // the particles that are not beads
  // The script has the components of motions in another order than FluidSolver: x of the beads of
  // all membranes, y of the same beads, then x, y and angle of each disc. In the order of the
  // script, this list has the place of each component in the arrays of FluidSolver.
  std::vector<std::size_t> components_;
  // Of the last velocities() with `driving`, and of the fluid without membranes and discs (0: not
  // known).
  double dissipation_ = 0, dissipation_alone_;
  std::vector<double> forces_of_fluid_;
  std::unique_ptr<SolverDialogue> solver_;
  double shift_ = 0;  // coordinate x in the domain minus that in the mesh [L]
  std::size_t unknowns_ = 0;
  long peak_memory_kb_ = 0;  // of the processes that were replaced
};

MembraneProcess::MembraneProcess(const particles::Fluid& fluid, const particles::Domain& domain,
                                 std::span<const double> radii, const SolverUnits& units,
                                 SolverCommand command, const SolverLimits& limits)
    : command_(std::move(command)),
      limits_(limits),
      domain_(domain),
      units_(units),
      membranes_(fluid.membranes),
      edges_(fluid.edges_per_particle),
      edges_of_disc_(fluid.edges_per_particle),
      radii_(radii.begin(), radii.end()),
      dissipation_alone_(dissipation_alone(fluid, domain)) {
  if (membranes_.size() > kMostMembranes)
    throw Error(ErrorKind::kBadInput, "the case has {} membranes; at most {} are allowed",
                membranes_.size(), kMostMembranes);
  // With fewer edges than two thirds of the beads, the forces on nodes that a force on one bead
  // gives would not be smooth along the edges.
  for (const auto& membrane : membranes_) edges_ = std::max(edges_, (2 * membrane.count() + 2) / 3);
  for (std::size_t d = 0; d < 2; ++d)
    for (const auto& membrane : membranes_)
      for (const auto bead : membrane.beads)
        components_.push_back(kComponents * index_of(bead) + d);
  std::vector<particles::Shape> rigid_discs;
  // The opening has the lines of opening() for the discs and then, for each membrane, a line with
  // its numbers of beads and edges and its viscosity ratio, and the rows of the matrix `smoothing`.
  for (std::size_t k = 0; k < radii.size(); ++k) {
    const auto has = [&](const Membrane& membrane) {
      return membrane.has(static_cast<std::int32_t>(k));
    };
    if (std::ranges::any_of(membranes_, has)) continue;
    discs_.push_back(k);
    rigid_discs.push_back(particles::Shape::disc(radii[k]));
    for (std::size_t d = 0; d < kComponents; ++d) components_.push_back(kComponents * k + d);
  }
  auto rigid = fluid;
  rigid.constraint = particles::RigidConstraint::kRigid;
  std::string text =
      opening(rigid, domain_, rigid_discs, 2) + fmt::format("membranes {}\n", membranes_.size());
  for (const auto& membrane : membranes_) {
    const auto& smoothing = nodes_.emplace_back(nodes_of(membrane.count(), edges_)).smoothing;
    text += fmt::format("{} {} {}\n", membrane.count(), edges_,
                        format_number(membrane.viscosity_ratio));
    for (Eigen::Index i = 0; i < smoothing.rows(); ++i) {
      const Eigen::VectorXd row = smoothing.row(i);
      append(text, {row.data(), row.data() + row.size()}, "a weight");
      text += '\n';
    }
  }
  opening_ = std::move(text);
  gradient_ = gradient_request(fluid);
  start();
}

void MembraneProcess::start() {
  if (solver_) peak_memory_kb_ = std::max(peak_memory_kb_, solver_->peak_memory_kb());
  solver_.reset();
  solver_ = std::make_unique<SolverDialogue>(command_, limits_.answer, limits_.ready, limits_.stop);
  solver_->ask("viscontact-fluid", opening_);
  solver_->expect("ready", true);
  solver_->expect("boundary");
  if (gradient_.empty()) return;
  solver_->ask("pressure_gradient", gradient_);
  solver_->expect("driving");
}

void MembraneProcess::place(const particles::FluidParticles& bodies) {
  assert(bodies.particles != nullptr && bodies.particles->count() == radii_.size());
  assert(bodies.angles.size() == radii_.size());
  InnerCurves curves{.edges = edges_, .edges_of_disc = edges_of_disc_};
  auto& nodes = curves.membranes;
  for (std::size_t m = 0; m < nodes_.size(); ++m) {
    // Trigonometric interpolation needs a curve without jumps: each bead is at its image nearest to
    // the bead before it, as Membranes::places() gives them.
    Eigen::MatrixXd own(membranes_[m].count(), 2);
    for (Eigen::Index k = 0; k < own.rows(); ++k) {
      const auto at =
          bodies.particles->position(index_of(membranes_[m].beads[static_cast<std::size_t>(k)]));
      own.row(k) << at[0], at[1];
    }
    if (!own.allFinite())
      throw Error(ErrorKind::kNotConverged, "a position of a membrane left the range of a double");
    nodes.emplace_back(nodes_[m].sampling * own);
  }
  for (const auto k : discs_) {
    const auto at = bodies.particles->position(k);
    curves.discs.push_back({particles::Shape::disc(radii_[k]), {at[0], at[1]}});
  }
  check_places(domain_, curves, units_);
  shift_ = shift_between_membranes(domain_, curves);
  // If the domain is periodic, the mesh covers the period that begins at a line between membranes
  // and discs. Each curve is shifted by whole periods into it.
  const auto cell = particles::cell_of(domain_);
  for (auto& own : nodes) {
    own.col(0).array() -= shift_;
    const double from = own.col(0).minCoeff();
    own.col(0).array() -= cell.lengths[0] * particles::periods_beyond(cell, 0, from);
  }
  for (auto& disc : curves.discs) {
    disc.centre[0] -= shift_;
    const double from = disc.centre[0] - disc.shape.bounding_radius();
    disc.centre[0] -= cell.lengths[0] * particles::periods_beyond(cell, 0, from);
  }
  std::string text = "place\n";
  for (std::size_t j = 0; j < discs_.size(); ++j) {
    append(text, curves.discs[j].centre, "a position");
    append(text, bodies.angles.subspan(discs_[j], 1), "an angle");
    text += '\n';
  }
  text += fmt::format("driven {}\n", bodies.driven.size());
  for (std::size_t j = 0; j < discs_.size(); ++j)
    if (const auto driven = bodies.driven.find(static_cast<std::int32_t>(discs_[j]));
        driven != bodies.driven.end()) {
      text += std::to_string(j);
      append(text, driven->second, "a velocity");
      text += '\n';
    }
  text += "inertia 0\n" + words_of(membrane_boundary(domain_, curves)) + "middles\n";
  for (const auto& own : nodes)
    for (Eigen::Index i = 1; i < own.rows(); i += 2) {
      append(text, std::array{own(i, 0), own(i, 1)}, "a node");
      text += '\n';
    }
  // A process that has solved a large system gives other rounding errors afterwards. A new process
  // does not.
  if (unknowns_ > command_.most_unknowns_reproduced) start();
  solver_->ask("place", text);
  solver_->expect("placed", command_.remarks_on_meshes);
  constexpr std::int64_t kMost = std::int64_t{1} << 53;  // doubles hold whole numbers up to it
  unknowns_ = static_cast<std::size_t>(solver_->whole_number(kMost));
}

std::vector<double> MembraneProcess::mobility(std::size_t components) {
  assert(components == kComponents * radii_.size());
  solver_->ask("mobility", "mobility\n");
  solver_->expect("mobility");
  // Beads have no angular velocity, so that the rows and columns of torques on them are 0.
  std::vector<double> rows(components * components);
  for (const auto row : components_)
    for (const auto column : components_) rows[row * components + column] = solver_->number();
  return rows;
}

std::vector<double> MembraneProcess::velocities(std::span<const double> forces, bool driving) {
  assert(forces.size() == kComponents * radii_.size());
  std::string text = driving ? "solve 1" : "solve 0";
  for (const auto component : components_) append(text, forces.subspan(component, 1), "a force");
  solver_->ask("solve", text + '\n');
  solver_->expect("velocities");
  std::vector<double> velocities(forces.size());
  for (const auto component : components_) velocities[component] = solver_->number();
  if (!driving) return velocities;
  dissipation_ = solver_->number();
  forces_of_fluid_.assign(forces.size(), 0);
  for (std::size_t i = 0; i < forces.size(); ++i) forces_of_fluid_[i] = -forces[i];
  for (const auto disc : discs_)
    for (std::size_t d = 0; d < kComponents; ++d)
      forces_of_fluid_[kComponents * disc + d] = solver_->number();
  return velocities;
}

FlowField MembraneProcess::flow() {
  auto field = read_flow(*solver_);
  for (auto& x : field.x) x += shift_;
  return field;
}

}  // namespace

std::unique_ptr<particles::FluidSolver> start_membrane_solver(
    const particles::Fluid& fluid, const particles::Domain& domain, std::span<const double> radii,
    const SolverUnits& units, SolverCommand command, const SolverLimits& limits) {
  return std::make_unique<MembraneProcess>(fluid, domain, radii, units, std::move(command), limits);
}

}  // namespace viscontact::freefem_flow
