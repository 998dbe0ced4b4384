// A fluid solver that is a process of its own, FreeFEM or a program of the user's, which is asked
// by the protocol of docs/fluid-solver.md.
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <span>
#include <string>

#include "viscontact/common/stop_token.hpp"
#include "viscontact/freefem_flow/boundary/mesh_boundary.hpp"
#include "viscontact/freefem_flow/process/solver_command.hpp"
#include "viscontact/immersed/fluid/fluid_solver.hpp"
#include "viscontact/particles/setting/fluid.hpp"

namespace viscontact::freefem_flow {

class SolverDialogue;

/// Asks a solver for the velocity and pressure of its last solution. Throws the errors of
/// SolverDialogue.
particles::FlowField read_flow(SolverDialogue& solver);

/// Makes the boundary of the mesh around particles, with edges that are about `coarsening` >= 1
/// times as long as `edges_per_particle` gives. Only solvers that ask for a boundary need it.
using MeshBoundaryMaker =
    std::function<MeshBoundary(const particles::FluidParticles&, double coarsening)>;

struct SolverLimits {
  /// The longest time for one answer, > 0. An answer for 1024 discs took 16 to 21 s
  /// (bench/README.md).
  std::chrono::milliseconds answer = std::chrono::minutes(30);
  StopToken stop{};
  /// A mesh of at most this many unknowns is refined to estimate the error. The refined mesh has
  /// four times as many unknowns, with this default at most 400000, which take 2 GB. For larger
  /// meshes the error is estimated from a coarser mesh, if the solver asks for boundaries.
  std::size_t most_unknowns_to_refine = 100'000;
  /// The longest time until the solver is ready, > 0. It is shorter than `answer`, so that a
  /// command that is no solver fails soon; FreeFEM needs a second on a busy machine.
  std::chrono::milliseconds ready = std::chrono::minutes(1);
};

/// A fluid solver that is a process. The process starts with the object and ends with it; after
/// large systems place() replaces it by a new one (SolverCommand::most_unknowns_reproduced). The
/// process also ends with the thread that made the object. After an Error(kExternalProgram) or
/// Error(kInterrupted) every request throws Error(kExternalProgram). saved_flow() and load_flow()
/// throw Error(kWrongUsage) without a temporary folder, and Error(kBadInput) if a file in it cannot
/// be read or written.
class FlowProcess : public particles::FluidSolver {
 public:
  /// Starts the solver and waits until it is ready. `dimension` is 2 for discs in the plane, 1 for
  /// spheres on the axis of a cylinder. `shapes` are those of all particles. Throws
  /// Error(kBadInput) if `domain` does not fit the dimension or the velocities of the boundary,
  /// Error(kExternalProgram) if the solver cannot be run or is not ready in time,
  /// Error(kInterrupted) if a stop is requested, and Error(kWrongUsage) if the fluid has inertia
  /// and no temporary folder can be made.
  FlowProcess(const particles::Fluid& fluid, const particles::Domain& domain,
              std::span<const particles::Shape> shapes, int dimension, SolverCommand command,
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
  /// Sends placement_. Returns the number of unknowns.
  std::size_t ask_to_place(const std::string& boundary);

  particles::Fluid fluid_;
  particles::Domain domain_;
  int dimension_;
  std::size_t components_;  ///< of the motions of all particles together
  MeshBoundaryMaker make_boundary_;
  double dissipation_alone_;  ///< dissipation_alone(); 0: not known
  SolverCommand command_;
  SolverLimits limits_;
  std::string opening_;
  std::unique_ptr<SolverDialogue> solver_;
  bool wants_boundary_ = false;      ///< the solver asked for boundaries of meshes
  std::size_t largest_system_ = 0;   ///< most unknowns that the present process has solved for
  long peak_memory_of_earlier_ = 0;  ///< largest one of the processes that were replaced [kB]
  std::size_t unknowns_ = 0;
  // The parts of the last request `place`; coarser_boundary_ is empty if the mesh is small enough
  // to be refined.
  std::string placement_, boundary_, coarser_boundary_;
  bool is_on_coarser_mesh_ = false;
  std::vector<double> forces_;  ///< of the last velocities(forces, true)
};

}  // namespace viscontact::freefem_flow
