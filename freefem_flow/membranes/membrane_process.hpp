// Starts FreeFEM with membranes.edp, which computes Stokes flow with membranes. Units are those of
// the solver (freefem_solver.cpp, which calls it).
#pragma once

#include <memory>
#include <span>

#include "viscontact/freefem_flow/process/flow_process.hpp"
#include "viscontact/particles/fluid/fluid_solver.hpp"

namespace viscontact::freefem_flow {

/// Starts the process and waits until it is ready. `domain` is a disc, or a box that is not
/// periodic along y; `fluid` has membranes, no inertia, and no solver of the user's own; `unit` is
/// that of the length in the unit of the case, for messages. The particles, which have these
/// `radii`, are the beads of the membranes, which feel no torque, and rigid discs, free or driven.
/// The solver computes no second mesh and no quantities but the dissipation. Throws
/// Error(kExternalProgram) if FreeFEM cannot be run, and Error(kBadInput) if there are more
/// membranes than the script has labels for.
///
/// The mesh has `edges_per_particle` edges on each membrane, at least two thirds of its beads.
/// Edges grow with the distance from the membranes. Where the box is periodic along x, the mesh
/// ends at a straight line that no membrane crosses; place() throws Error(kNotConverged) if there
/// is no such line, and if a membrane leaves the domain.
std::unique_ptr<particles::FluidSolver> start_membrane_solver(const particles::Fluid& fluid,
                                                              const particles::Domain& domain,
                                                              std::span<const double> radii,
                                                              double unit, SolverCommand command,
                                                              const SolverLimits& limits);

}  // namespace viscontact::freefem_flow
