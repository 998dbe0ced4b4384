// Requests to a fluid solver and its answers, docs/fluid-solver.md.
#include "viscontact/freefem_flow/process/flow_process.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <system_error>
#include <utility>

#include "viscontact/common/error.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/freefem_flow/process/dissipation_alone.hpp"
#include "viscontact/freefem_flow/process/opening.hpp"
#include "viscontact/freefem_flow/process/solver_dialogue.hpp"

namespace viscontact::freefem_flow {
namespace {

using particles::FluidParticles;

// The error on a mesh that is too large to be refined is estimated from a coarser mesh, whose edges
// are longer by this factor. If it changes, so does kErrorOfDifference.
constexpr double kCoarsening = 2;

// Estimated error on the finer mesh, divided by the difference of the results on both meshes. If
// errors fall as the power p of the length of edges, this ratio is 1/(2^p - 1). In theory p is 4.
// The coarser mesh is too coarse for this, so that p = 3 is taken, which gives a larger estimate.
constexpr double kErrorOfDifference = 1.0 / 7;

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

/// A new folder for files of the solver, which the destructor removes. The constructor throws
/// Error(kWrongUsage) if it cannot be made.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::error_code problem;
    const auto parent = std::filesystem::temp_directory_path(problem);
    std::string name = (parent / "viscontact-XXXXXX").string();
    if (problem || mkdtemp(name.data()) == nullptr)
      throw Error(ErrorKind::kWrongUsage,
                  "cannot make a temporary folder for the flow of the fluid; the environment "
                  "variable TMPDIR, or else /tmp, must be a folder to write in");
    path_ = name;
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace

FlowProcess::FlowProcess(const particles::Fluid& fluid, const particles::Domain& domain,
                         std::span<const particles::Shape> shapes, int dimension,
                         SolverCommand command, MeshBoundaryMaker make_boundary,
                         const SolverLimits& limits)
    : fluid_(fluid),
      domain_(domain),
      dimension_(dimension),
      components_(shapes.size() * particles::motion_components(dimension)),
      make_boundary_(std::move(make_boundary)),
      dissipation_alone_(dissipation_alone(fluid, domain)),
      command_(std::move(command)),
      limits_(limits),
      opening_(opening(fluid, domain, shapes, dimension)) {
  assert(dimension == 1 || dimension == 2);
  // saved_flow() needs a temporary folder. If none can be made, the error comes now and not after
  // the first steps.
  if (fluid.has_inertia()) const TemporaryFolder needed;
  start();
}

void FlowProcess::start() {
  if (solver_)
    peak_memory_of_earlier_ = std::max(peak_memory_of_earlier_, solver_->peak_memory_kb());
  solver_.reset();
  largest_system_ = 0;
  solver_ = std::make_unique<SolverDialogue>(command_, limits_.answer, limits_.ready, limits_.stop);
  solver_->ask("viscontact-fluid", opening_);
  solver_->expect("ready", true);  // FreeFEM first prints lines about its libraries
  const std::string wants = solver_->word();
  if (wants != "boundary" && wants != "places") solver_->refuse("'boundary' or 'places'");
  wants_boundary_ = wants == "boundary";
  if (const auto gradient = gradient_request(fluid_); !gradient.empty()) {
    solver_->ask("pressure_gradient", gradient);
    solver_->expect("driving");
  }
  if (fluid_.probes.empty()) return;
  std::string probes = fmt::format("probes {}\n", fluid_.probes.size());
  for (const auto& probe : fluid_.probes) {
    append(probes, probe.from, "a place");
    append(probes, probe.to, "a place");
    probes += '\n';
  }
  solver_->ask("probes", probes);
  solver_->expect("probing");
}

FlowProcess::~FlowProcess() = default;

void FlowProcess::place(const FluidParticles& bodies) {
  assert(bodies.particles != nullptr);
  assert(bodies.particles->count() * particles::motion_components(dimension_) == components_);
  assert(dimension_ == 1 || bodies.angles.size() == bodies.particles->count());
  assert(bodies.inertia.empty() || bodies.inertia.size() == components_);
  placement_ = "place\n";
  append_places(placement_, bodies, dimension_);
  append_driven(placement_, bodies, dimension_);
  placement_ += fmt::format("inertia {}", bodies.inertia.size());
  append(placement_, bodies.inertia, "an inertia");
  placement_ += '\n';
  if (fluid_.has_inertia()) {
    const auto& step = bodies.flow_step;
    assert(step.masses.size() == components_);
    placement_ += fmt::format("step {}", step.order);
    append(placement_, std::array{step.length, step.before}, "a time step");
    append(placement_, fluid_.pressure_gradient_at(step.time), "a pressure gradient");
    placement_ += '\n' + walls_at(fluid_, domain_, step) + "masses";
    append(placement_, step.masses, "a mass");
    placement_ += '\n';
  }
  assert(!wants_boundary_ || make_boundary_);
  boundary_ = wants_boundary_ ? words_of(make_boundary_(bodies, 1)) : "";
  coarser_boundary_.clear();
  // A process that has solved a large system gives other rounding errors afterwards. A process for
  // a fluid with inertia is kept, because it remembers the flow; it does not use the random numbers
  // that cause them.
  if (!fluid_.has_inertia() && largest_system_ > command_.most_unknowns_reproduced) start();
  unknowns_ = ask_to_place(boundary_);
  is_on_coarser_mesh_ = false;
  if (wants_boundary_ && unknowns_ > limits_.most_unknowns_to_refine)
    coarser_boundary_ = words_of(make_boundary_(bodies, kCoarsening));
}

std::size_t FlowProcess::ask_to_place(const std::string& boundary) {
  solver_->ask("place", placement_ + boundary);
  solver_->expect("placed", command_.remarks_on_meshes);
  // All whole numbers up to 2^53 are doubles, so that a solver may count in doubles.
  constexpr std::int64_t kMost = std::int64_t{1} << 53;
  const auto unknowns = static_cast<std::size_t>(solver_->whole_number(kMost));
  largest_system_ = std::max(largest_system_, unknowns);
  return unknowns;
}

std::vector<double> FlowProcess::velocities(std::span<const double> forces, bool driving) {
  assert(forces.size() == components_);
  if (driving) forces_.assign(forces.begin(), forces.end());
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
  if (alone == 0) alone = dissipation_alone_;
  quantities.apparent_viscosity = alone == 0 ? 0 : quantities.dissipation / alone;
  quantities.fluid_forces = solver_->numbers(components_);
  if (fluid_.has_inertia()) {
    quantities.kinetic_energy = solver_->number();
    quantities.courant_number = solver_->number();
    if (fluid_.advection == particles::Advection::kCharacteristics)
      quantities.advection_error = solver_->number_from_zero();
  }
  for (std::size_t k = 0; k < fluid_.probes.size(); ++k) {
    const double flow = solver_->number();
    quantities.probes.push_back({flow, solver_->number()});
  }
  return quantities;
}

void FlowProcess::keep_flow(bool at_rest, std::span<const double> motions) {
  assert(motions.size() == components_);
  std::string text = at_rest ? "keep rest" : "keep flow";
  append(text, motions, "a velocity");
  solver_->ask("keep", text + '\n');
  solver_->expect("kept");
}

std::string FlowProcess::saved_flow() {
  const TemporaryFolder folder;
  const auto file = folder.path() / "flow.msh";
  solver_->ask("save", fmt::format("save {}\n", file.string()));
  solver_->expect("saved");
  auto text = read_file(file);
  if (!text.ends_with("complete\n"))
    throw Error(ErrorKind::kExternalProgram,
                "the fluid solver could not write {}; is the disk full?", file.string());
  return text;
}

void FlowProcess::load_flow(const std::string& flow) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "flow.msh";
  write_file(file, flow);
  solver_->ask("load", fmt::format("load {}\n", file.string()));
  solver_->expect("loaded");
}

double FlowProcess::vary_penalty() {
  solver_->ask("vary", "vary penalty\n");
  solver_->expect("varied");
  return solver_->number_from_zero();
}

particles::SecondMesh FlowProcess::vary_mesh() {
  if (!coarser_boundary_.empty()) {
    ask_to_place(coarser_boundary_);
    is_on_coarser_mesh_ = true;
    return {0, kErrorOfDifference, kErrorOfDifference};
  }
  // The refined mesh has four times as many unknowns.
  largest_system_ = std::max(largest_system_, 4 * unknowns_);
  solver_->ask("vary", "vary mesh\n");
  solver_->expect("varied");
  particles::SecondMesh second;
  for (auto* number : {&second.extrapolation, &second.error, &second.error_of_one_mesh})
    *number = solver_->number_from_zero();
  return second;
}

double FlowProcess::peak_memory_mebibytes() const {
  return static_cast<double>(std::max(peak_memory_of_earlier_, solver_->peak_memory_kb())) / 1024;
}

particles::FlowField FlowProcess::flow() {
  if (is_on_coarser_mesh_) {
    ask_to_place(boundary_);
    is_on_coarser_mesh_ = false;
    const auto forces = forces_;
    velocities(forces, true);
  }
  return read_flow(*solver_);
}

particles::FlowField read_flow(SolverDialogue& solver) {
  solver.ask("flow", "flow\n");
  solver.expect("flow");
  constexpr std::int64_t kMost = std::numeric_limits<std::int32_t>::max();
  const std::int64_t nodes = solver.whole_number(kMost);
  const std::int64_t triangles = solver.whole_number(kMost);
  if (nodes == 0 && triangles > 0) solver.refuse("0 triangles, as there are no nodes,");
  // Memory is not reserved for the numbers that the solver announces, because a wrong count could
  // take all of it; the arrays grow with the numbers that arrive.
  particles::FlowField field;
  for (std::int64_t k = 0; k < nodes; ++k)
    for (auto* column : {&field.x, &field.y, &field.velocity_x, &field.velocity_y, &field.pressure})
      column->push_back(solver.number());
  for (std::int64_t k = 0; k < triangles; ++k)
    for (auto& node : field.triangles.emplace_back())
      node = static_cast<std::int32_t>(solver.whole_number(nodes - 1));
  return field;
}

}  // namespace viscontact::freefem_flow
