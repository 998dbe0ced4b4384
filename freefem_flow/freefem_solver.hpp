// Starts the process of a fluid solver: FreeFEM with the scripts of freefem_flow/scripts/, which
// are installed under their names, or a program of the user's own.
#pragma once

#include <memory>
#include <span>

#include "viscontact/freefem_flow/process/flow_process.hpp"

namespace viscontact::freefem_flow {

/// The command of the solver of `fluid`: the user's own program and arguments `fluid.solver`, or
/// else FreeFEM with a script of share/viscontact/freefem_flow, which is in the folder of this
/// program or in the one above it: discs.edp (`dimension` 2, the plane) or spheres.edp (1, the axis
/// of a cylinder), or with a fixed mesh discs_on_fixed_mesh.edp or spheres_on_fixed_mesh.edp. The
/// environment variable VISCONTACT_FREEFEM, if set, names the FreeFEM to run. Throws
/// Error(kExternalProgram) if there is no such script; the program need not exist.
SolverCommand solver_command(const particles::Fluid& fluid, int dimension);

/// The environment variable VISCONTACT_FREEFEM_TIME_LIMIT, if set, is the limit in seconds of an
/// answer and of the time until the solver is ready. Throws Error(kWrongUsage) if it is not a whole
/// number from 1 to 10 million.
SolverLimits solver_limits(const StopToken& stop = {});

/// Starts the solver of `fluid` in `domain` and waits until it is ready. `shapes` are those
/// of all particles; `dimension` is 2 (the plane) or 1 (the axis of a cylinder). The result
/// is never null; its arguments and results are in the units of the case. With membranes the solver
/// is FreeFEM with membranes.edp (membranes/membrane_process.hpp). Throws Error(kExternalProgram)
/// if the solver cannot be run or is not ready in time or its script is not found; Error(kBadInput)
/// if the domain does not fit `dimension` or the boundary of the fluid, if it is so large that
/// FreeFEM makes no mesh around the smallest particle, or if there are more than 80 membranes;
/// Error(kInterrupted) if `stop` requests a stop; and Error(kWrongUsage) for a wrong time limit, or
/// if the fluid has inertia and no temporary folder can be made.
std::unique_ptr<particles::FluidSolver> start_fluid_solver(const particles::Fluid& fluid,
                                                           const particles::Domain& domain,
                                                           std::span<const particles::Shape> shapes,
                                                           int dimension,
                                                           const StopToken& stop = {});

}  // namespace viscontact::freefem_flow
