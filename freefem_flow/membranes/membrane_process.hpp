// Starts FreeFEM with scripts/membranes.edp, which computes Stokes flow with membranes and rigid
// discs in the plane.
#pragma once

#include <memory>
#include <span>

#include "viscontact/freefem_flow/process/flow_process.hpp"
#include "viscontact/freefem_flow/process/solver_units.hpp"
#include "viscontact/immersed/fluid/fluid_solver.hpp"

namespace viscontact::freefem_flow {

/// Starts the process and waits until it is ready. `domain` is a disc, or a box that is not
/// periodic along y. `fluid` has membranes, no inertia, and no solver of the user's own; radii and
/// viscosity should be about 1. `radii` [L] are those of all particles, which are either beads,
/// which are points of the membranes and feel no torque, or rigid discs, free or driven. `units`
/// are those of the arguments; messages have places of the case. Throws
/// Error(kExternalProgram) if FreeFEM cannot be run or is not ready in time, Error(kInterrupted) if
/// a stop is requested, and Error(kBadInput) if there are more than kMostMembranes membranes or no
/// domain in the plane (opening()). The result is never null; its functions throw the errors that
/// FluidSolver names.
///
/// The mesh has `edges_per_particle` edges on each membrane, but at least two thirds as many as any
/// membrane has beads. In a box that is periodic along x the mesh ends at a straight line that no
/// membrane or disc crosses. place() needs the beads of each membrane at images without jumps by a
/// period between neighbours; beads may be outside the box. It throws Error(kNotConverged) if there
/// is no such line, and if a membrane meets a disc or a membrane or disc leaves the domain. There
/// is neither a penalty nor a second mesh.
std::unique_ptr<particles::FluidSolver> start_membrane_solver(
    const particles::Fluid& fluid, const particles::Domain& domain, std::span<const double> radii,
    const SolverUnits& units, SolverCommand command, const SolverLimits& limits);

}  // namespace viscontact::freefem_flow
