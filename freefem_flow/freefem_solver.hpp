// Starts the process of a fluid solver: FreeFEM with the scripts of freefem_flow/scripts/, or a
// program of the user's own. Numbers are in the units of the case. app/ and python/ hand
// start_fluid_solver() to particles/. A solver that cannot be run or that fails throws
// Error(kExternalProgram), a requested stop Error(kInterrupted). A change must keep the names of
// the scripts, because they are installed under these names.
#pragma once

#include <memory>
#include <span>

#include "viscontact/freefem_flow/process/flow_process.hpp"

namespace viscontact::freefem_flow {

/// The command of the solver of `fluid`. It is `fluid.solver`, the user's own program and
/// arguments, if this is not empty. Otherwise it is FreeFEM with a script of
/// share/viscontact/freefem_flow, which is in the folder of this program or in the one above it:
/// discs.edp (`dimension` 2, the plane) or spheres.edp (1, the axis of a cylinder), or with a fixed
/// mesh discs_on_fixed_mesh.edp or spheres_on_fixed_mesh.edp. The environment variable
/// VISCONTACT_FREEFEM, if set, names the FreeFEM to run. Throws Error(kExternalProgram) if there is
/// no such script; whether the program exists is not checked.
SolverCommand solver_command(const particles::Fluid& fluid, int dimension);

/// The limits of any fluid solver: if the environment variable VISCONTACT_FREEFEM_TIME_LIMIT is
/// set, it is the limit in seconds of an answer and of the time until the solver is ready. Throws
/// Error(kWrongUsage) if it is not a whole number from 1 to 10 million. If `stop` requests a stop,
/// requests to the solver throw Error(kInterrupted).
SolverLimits solver_limits(const StopToken& stop = {});

/// Starts the solver of `fluid` in `domain` and waits until it is ready. `radii` [L], > 0, has one
/// number for each particle; `dimension` is 2 (the plane) or 1 (the axis of a cylinder). The result
/// is never null. For a fluid with membranes the solver is FreeFEM with membranes.edp
/// (membranes/membrane_process.hpp). FreeFEM computes in units of its own, but arguments and
/// results of the returned object are in the units of the case; a solver of the user's own gets the
/// units of the case. Throws Error(kExternalProgram) if the solver cannot be run or is not ready in
/// time or its script is not found, Error(kBadInput) if the domain does not fit `dimension` or the
/// boundary of the fluid, if it is so large that FreeFEM makes no mesh around the smallest
/// particle, or if there are more than 80 membranes, Error(kInterrupted) if `stop` requests a stop,
/// and Error(kWrongUsage) for a wrong time limit (solver_limits()) or if the fluid has inertia and
/// no temporary folder can be made. place() of the object throws Error(kNotConverged) if a gap is
/// too narrow for an edge of FreeFEM's mesh.
std::unique_ptr<particles::FluidSolver> start_fluid_solver(const particles::Fluid& fluid,
                                                           const particles::Domain& domain,
                                                           std::span<const double> radii,
                                                           int dimension,
                                                           const StopToken& stop = {});

}  // namespace viscontact::freefem_flow
