// Writes the requests of the protocol and reads the answers (docs/fluid-solver.md, which a change
// must follow). Numbers are written so that they read back to the same double.
#include "viscontact/freefem_flow/flow_process.hpp"

#include <fmt/format.h>

#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

#include "viscontact/common/error.hpp"
#include "viscontact/common/text/number.hpp"
#include "viscontact/freefem_flow/dissipation_alone.hpp"
#include "viscontact/freefem_flow/opening.hpp"
#include "viscontact/freefem_flow/solver_dialogue.hpp"

namespace viscontact::freefem_flow {
namespace {

using particles::FluidParticles;

/// Appends numbers with a space before each. `what` they are stands in the error.
void append(std::string& text, std::span<const double> values, const char* what) {
  for (const double value : values) {
    if (!std::isfinite(value))
      throw Error(ErrorKind::kNotConverged,
                  fmt::format("{} of the particles in the fluid left the range of a double ({})",
                              what, value));
    text += ' ';
    text += format_number(value);
  }
}

/// One line for each particle: its centre and, in the plane, its angle.
void append_places(std::string& text, const FluidParticles& bodies, int dimension) {
  const auto& positions = bodies.particles->positions;
  const auto width = static_cast<std::size_t>(dimension);
  for (std::size_t k = 0; k < bodies.particles->count(); ++k) {
    append(text, std::span(positions).subspan(width * k, width), "a position");
    if (dimension == 2) append(text, bodies.angles.subspan(k, 1), "an angle");
    text += '\n';
  }
}

void append_driven(std::string& text, const FluidParticles& bodies, int dimension) {
  text += fmt::format("driven {}\n", bodies.driven.size());
  for (const auto& [k, motion] : bodies.driven) {
    text += std::to_string(k);
    append(text, std::span(motion).first(particles::motion_components(dimension)), "a velocity");
    text += '\n';
  }
}

void append_boundary(std::string& text, const MeshBoundary& boundary) {
  text += fmt::format("boundary {} {}\n", boundary.points.size(), boundary.curves.size());
  for (const auto& point : boundary.points) {
    append(text, point, "a point of the mesh around one");
    text += '\n';
  }
  for (const auto& curve : boundary.curves)
    text += fmt::format("{} {} {}\n", curve.first, curve.edges, curve.label);
}

}  // namespace

FlowProcess::FlowProcess(const particles::Fluid& fluid, const particles::Domain& domain,
                         std::span<const double> radii, int dimension, const SolverCommand& command,
                         MeshBoundaryMaker make_boundary, const SolverLimits& limits)
    : dimension_(dimension),
      components_(radii.size() * particles::motion_components(dimension)),
      make_boundary_(std::move(make_boundary)),
      dissipation_alone_(dissipation_alone(fluid, domain)) {
  // The opening is made first, because it throws if the domain is wrong.
  const std::string text = opening(fluid, domain, radii, dimension);
  solver_ = std::make_unique<SolverDialogue>(command, limits.answer, limits.stop);
  solver_->ask("viscontact-fluid", text);
  // FreeFEM prints lines about its libraries when it starts.
  solver_->expect("ready", true);
  const std::string wants = solver_->word();
  if (wants != "boundary" && wants != "places") solver_->refuse("'boundary' or 'places'");
  wants_boundary_ = wants == "boundary";
}

FlowProcess::~FlowProcess() = default;

void FlowProcess::place(const FluidParticles& bodies) {
  assert(bodies.particles->count() * particles::motion_components(dimension_) == components_);
  assert(dimension_ == 1 || bodies.angles.size() == bodies.particles->count());
  assert(bodies.inertia.empty() || bodies.inertia.size() == components_);
  std::string text = "place\n";
  append_places(text, bodies, dimension_);
  append_driven(text, bodies, dimension_);
  text += fmt::format("inertia {}", bodies.inertia.size());
  append(text, bodies.inertia, "an inertia");
  text += '\n';
  if (wants_boundary_) append_boundary(text, make_boundary_(bodies));
  solver_->ask("place", text);
  solver_->expect("placed");
  // A double holds all whole numbers up to this one, so that every solver can write them.
  constexpr std::int64_t kMost = std::int64_t{1} << 53;
  unknowns_ = static_cast<std::size_t>(solver_->whole_number(kMost));
}

std::vector<double> FlowProcess::velocities(std::span<const double> forces, bool driving) {
  assert(forces.size() == components_);
  std::string text = driving ? "solve 1" : "solve 0";
  append(text, forces, "a force");
  solver_->ask("solve", text + '\n');
  solver_->expect("velocities");
  return solver_->numbers(components_);
}

particles::FlowQuantities FlowProcess::quantities() {
  solver_->ask("quantities", "quantities\n");
  solver_->expect("quantities");
  particles::FlowQuantities quantities;
  quantities.dissipation = solver_->number();
  double alone = solver_->number_from_zero();
  // The solver answers 0 if it does not know the dissipation without particles.
  if (alone == 0) alone = dissipation_alone_;
  quantities.apparent_viscosity = alone == 0 ? 0 : quantities.dissipation / alone;
  quantities.fluid_forces = solver_->numbers(components_);
  return quantities;
}

particles::EstimatedVelocities FlowProcess::estimate(std::span<const double> forces) {
  assert(forces.size() == components_);
  std::string text = "estimate";
  append(text, forces, "a force");
  solver_->ask("estimate", text + '\n');
  solver_->expect("estimate");
  particles::EstimatedVelocities estimated;
  estimated.relative_error = solver_->number_from_zero();
  estimated.relative_error_of_one_mesh = solver_->number_from_zero();
  estimated.velocities = solver_->numbers(components_);
  return estimated;
}

particles::FlowField FlowProcess::flow() {
  solver_->ask("flow", "flow\n");
  solver_->expect("flow");
  constexpr std::int64_t kMost = std::numeric_limits<std::int32_t>::max();
  const std::int64_t nodes = solver_->whole_number(kMost);
  const std::int64_t triangles = solver_->whole_number(kMost);
  if (nodes == 0 && triangles > 0) solver_->refuse("0 triangles, as there are no nodes,");
  // The memory grows with what comes: a wrong count must not take all of it at once.
  particles::FlowField field;
  for (std::int64_t k = 0; k < nodes; ++k)
    for (auto* column : {&field.x, &field.y, &field.velocity_x, &field.velocity_y, &field.pressure})
      column->push_back(solver_->number());
  for (std::int64_t k = 0; k < triangles; ++k)
    for (auto& node : field.triangles.emplace_back())
      node = static_cast<std::int32_t>(solver_->whole_number(nodes - 1));
  return field;
}

}  // namespace viscontact::freefem_flow
