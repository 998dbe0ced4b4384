// Implements a fluid solver by a process of its own, FreeFEM or a program of the user's, which is
// asked by the protocol of docs/fluid-solver.md. Lengths, masses and times have the units of the
// arguments. freefem_solver.cpp makes it; membranes/ uses read_flow() and SolverLimits. A solver
// that ends, is late or gives a wrong answer throws Error(kExternalProgram). Numbers that are not
// finite are not sent: they throw Error(kNotConverged). A change of the protocol must change its
// version and docs/fluid-solver.md.
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <span>
#include <string>

#include "viscontact/common/stop_token.hpp"
#include "viscontact/freefem_flow/boundary/mesh_boundary.hpp"
#include "viscontact/freefem_flow/process/solver_command.hpp"
#include "viscontact/particles/fluid.hpp"
#include "viscontact/particles/fluid/fluid_solver.hpp"

namespace viscontact::freefem_flow {

class SolverDialogue;

/// Asks a solver for the velocity and pressure of its last solution, and reads the answer: for each
/// node x, y [L], velocity [L/T] and pressure [M/(L T^2)], and for each triangle its six nodes,
/// numbers from 0. Throws Error(kExternalProgram) if the answer is late or incomplete or a number
/// of a node is out of range, and Error(kInterrupted) if a stop is requested.
particles::FlowField read_flow(SolverDialogue& solver);

/// A function that makes the boundary of the mesh around particles, with edges that are about
/// `coarsening` >= 1 times as long as `edges_per_particle` of the fluid gives. It is called only
/// for solvers that ask for a boundary. place() passes on the errors that it throws.
using MeshBoundaryMaker =
    std::function<MeshBoundary(const particles::FluidParticles&, double coarsening)>;

/// When the process of a solver is killed, and how large its meshes may be.
struct SolverLimits {
  /// The longest time for one answer, > 0. An answer for 1024 discs took 16 to 21 s
  /// (bench/README.md).
  std::chrono::milliseconds answer = std::chrono::minutes(30);
  /// If it requests a stop, the solver is killed and Error(kInterrupted) is thrown.
  StopToken stop{};
  /// A mesh of at most this many unknowns is refined to estimate the error. The refined mesh has
  /// four times as many unknowns, with this default at most 400000, which take 2 GB. If the mesh
  /// has more unknowns, the error is estimated from a coarser mesh, provided that the solver asks
  /// for boundaries. With 0 the coarser mesh is always used.
  std::size_t most_unknowns_to_refine = 100'000;
  /// The longest time until the solver is ready, > 0. It is shorter than `answer`, so that a
  /// command that is no solver fails soon; FreeFEM needs a second on a busy machine.
  std::chrono::milliseconds ready = std::chrono::minutes(1);
};

/// A fluid solver that is a process. The process starts with the object and ends with it; after
/// large systems place() replaces it by a new one (SolverCommand::most_unknowns_reproduced). The
/// process also ends with the thread that made the object, so that this thread must live as long as
/// the object. The functions of the base class throw Error(kExternalProgram) if the solver ends,
/// does not answer in time, reports an error, or answers with anything but the finite numbers that
/// the protocol asks for; the message names the solver, the request and the last lines of the
/// solver. They throw Error(kNotConverged) if a number for the solver is not finite, and
/// Error(kInterrupted) if a stop is requested. After an Error(kExternalProgram) or
/// Error(kInterrupted) every request throws Error(kExternalProgram). Sizes of arrays are asserted.
/// saved_flow() and load_flow() throw Error(kWrongUsage) without a temporary folder, and
/// Error(kBadInput) if a file in it cannot be read or written.
class FlowProcess : public particles::FluidSolver {
 public:
  /// Starts the solver and waits until it is ready. `dimension` is 2 for discs in the plane, 1 for
  /// spheres on the axis of a cylinder. `radii` [L], > 0, are those of all particles; there may be
  /// none. Throws Error(kBadInput) if `domain` does not fit the dimension or the velocities of the
  /// boundary, Error(kExternalProgram) if the solver cannot be run or is not ready in time,
  /// Error(kInterrupted) if a stop is requested, and Error(kWrongUsage) if the fluid has inertia
  /// and no temporary folder can be made. `make_boundary` must not be empty (not checked).
  FlowProcess(const particles::Fluid& fluid, const particles::Domain& domain,
              std::span<const double> radii, int dimension, SolverCommand command,
              MeshBoundaryMaker make_boundary, const SolverLimits& limits = {});
  ~FlowProcess() override;

  void place(const particles::FluidParticles& bodies) override;
  std::vector<double> velocities(std::span<const double> forces, bool driving) override;
  particles::FlowQuantities quantities() override;
  double vary_penalty() override;
  particles::SecondMesh vary_mesh() override;
  particles::FlowField flow() override;
  void keep_flow(bool at_rest, std::span<const double> motions) override;
  std::string saved_flow() override;
  void load_flow(const std::string& flow) override;
  std::size_t unknowns() const override { return unknowns_; }
  double peak_memory_mebibytes() const override;

 private:
  void start();
  /// Sends placement_ with this boundary. Returns the number of unknowns.
  std::size_t ask_to_place(const std::string& boundary);

  particles::Fluid fluid_;
  particles::Domain domain_;
  int dimension_;
  std::size_t components_;  ///< number of components of the motions of all particles together
  MeshBoundaryMaker make_boundary_;
  double dissipation_alone_;  ///< dissipation_alone(); 0: not known
  SolverCommand command_;
  SolverLimits limits_;
  std::string opening_;
  std::unique_ptr<SolverDialogue> solver_;
  bool wants_boundary_ = false;      ///< the solver asked for boundaries of meshes
  std::size_t largest_system_ = 0;   ///< most unknowns that the present process has solved for
  long peak_memory_of_earlier_ = 0;  ///< largest one of the processes that were replaced [kB]
  std::size_t unknowns_ = 0;         ///< of the last placement
  // The parts of the last request `place`: places, driven particles and inertia; the boundary; and
  // a coarser boundary, which is empty if the mesh is small enough to be refined.
  std::string placement_, boundary_, coarser_boundary_;
  bool is_on_coarser_mesh_ = false;
  std::vector<double> forces_;  ///< of the last velocities(forces, true)
};

}  // namespace viscontact::freefem_flow
