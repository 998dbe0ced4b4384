// Starts the process of a fluid solver: FreeFEM with the scripts of this part, or a program of the
// user's own. Numbers are in the units of the case. The commands of app/ hand it to particles/. A
// change must keep the names of the scripts.
#pragma once

#include <memory>
#include <span>

#include "viscontact/freefem_flow/process/flow_process.hpp"

namespace viscontact::freefem_flow {

/// The command of the solver of `fluid`: that of the user's own if there is one, else FreeFEM with
/// a script of share/viscontact/freefem_flow, which is in the folder of this program or in the one
/// above it: discs.edp (dimension 2) or spheres.edp (dimension 1), or with a fixed mesh
/// discs_on_fixed_mesh.edp or spheres_on_fixed_mesh.edp. VISCONTACT_FREEFEM, if set, is the FreeFEM
/// to run. Throws Error(kExternalProgram) if there is no such script.
SolverCommand solver_command(const particles::Fluid& fluid, int dimension);

/// The limit of an answer, and of the time until the solver is ready, is
/// VISCONTACT_FREEFEM_TIME_LIMIT in seconds if it is set, for a solver of the user's own as well.
/// Throws Error(kWrongUsage) if it is not a whole number from 1 to 10 million.
SolverLimits solver_limits(const StopToken& stop = {});

/// Starts the solver of `fluid`, for membranes FreeFEM with membranes.edp
/// (membranes/membrane_process.hpp), and waits until it is ready. FreeFEM computes in units of its
/// own (ScaledSolver in freefem_solver.cpp); a solver of the user's own gets the units of the case.
/// Parameters and errors are those of FlowProcess and of the functions above. Throws
/// Error(kBadInput) if FreeFEM can make no mesh around the smallest particle, because the domain is
/// too large.
std::unique_ptr<particles::FluidSolver> start_fluid_solver(const particles::Fluid& fluid,
                                                           const particles::Domain& domain,
                                                           std::span<const double> radii,
                                                           int dimension,
                                                           const StopToken& stop = {});

}  // namespace viscontact::freefem_flow
