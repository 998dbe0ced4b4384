// Writes the requests of the protocol and reads the answers (docs/fluid-solver.md, which a change
// must follow). Numbers are written so that they read back to the same double.
#include "viscontact/freefem_flow/process/flow_process.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cassert>
#include <charconv>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "viscontact/common/error.hpp"
#include "viscontact/common/stop_token.hpp"
#include "viscontact/common/system/child_process.hpp"
#include "viscontact/common/text/number.hpp"
#include "viscontact/common/text/shell_words.hpp"
#include "viscontact/freefem_flow/dissipation_alone.hpp"
#include "viscontact/freefem_flow/process/opening.hpp"
#include "viscontact/freefem_flow/process/solver_command.hpp"

namespace viscontact::freefem_flow {
namespace {

/// All functions but the destructor throw Error(kExternalProgram) if the solver fails, and
/// Error(kInterrupted) if a stop is requested. After an error the process of the solver is gone, and
/// every further request is an error.
class SolverDialogue {
 public:
  /// Starts the solver. `time_limit` is that of each answer, `first_limit` that of the first one.
  SolverDialogue(const SolverCommand& command, std::chrono::milliseconds time_limit,
                 std::chrono::milliseconds first_limit, const StopToken& stop);
  SolverDialogue(const SolverDialogue&) = delete;
  SolverDialogue& operator=(const SolverDialogue&) = delete;
  /// Asks the solver to end, and kills it if it does not within two seconds.
  ~SolverDialogue();

  /// Sends a request, whose first word is `name`. The answer to the last one must have been read.
  void ask(std::string_view name, std::string_view text);

  /// Reads the first word of the answer, which must be `word`. With `skip_lines`, up to a thousand
  /// lines that begin with another word than `word` and `error` are left out.
  void expect(std::string_view word, bool skip_lines = false);

  /// The next word of the answer.
  std::string word();
  double number();            ///< a finite number
  double number_from_zero();  ///< a finite number >= 0
  /// The next `count` words of the answer, as finite numbers.
  std::vector<double> numbers(std::size_t count);
  /// A whole number from 0 to `largest`.
  std::int64_t whole_number(std::int64_t largest);

  /// The largest resident memory of the solver so far [kB]; 0 after an error.
  long peak_memory_kb() const { return process_ ? process_->peak_memory_kb() : 0; }

  /// Ends the solver and throws: what it answered, the last word that was read, is wrong.
  [[noreturn]] void refuse(std::string_view needed);

 private:
  std::string_view next_word();
  /// The limit of the answer to the last request.
  std::chrono::milliseconds limit() const { return requests_ > 1 ? time_limit_ : first_limit_; }
  [[noreturn]] void fail(const std::string& reason, std::chrono::milliseconds grace);
  [[noreturn]] void fail_without_answer(ChildProcess::State state);
  [[noreturn]] void fail_as_solver_says();
  std::string asked_in_words() const;

  std::string name_;  ///< the command, for messages
  std::string remedy_if_silent_;
  std::chrono::milliseconds time_limit_, first_limit_;
  std::optional<ChildProcess> process_;  ///< nothing after an error
  std::string request_;                  ///< first word of the last request
  std::string awaited_;                  ///< first word of the answer that is expected
  std::int64_t requests_ = 0;
  std::size_t numbers_asked_ = 0, numbers_read_ = 0;  ///< of the numbers that are being read
  ChildProcess::Clock::time_point asked_at_{};
};

using namespace std::chrono_literals;

// How long a solver that has failed may take to write its last lines and to end.
constexpr auto kGraceOfFailed = 1000ms;

// How long a solver may take to end when it is asked to.
constexpr auto kGraceAtEnd = 2000ms;

std::string command_in_words(const std::vector<std::string>& arguments) {
  std::string text;
  for (const auto& argument : arguments) text += (text.empty() ? "" : " ") + shell_word(argument);
  return text;
}

/// A text of the solver for a message, in which a long one would hide the rest.
std::string shortened(std::string_view text, std::size_t longest) {
  if (text.size() <= longest) return std::string(text);
  return std::string(text.substr(0, longest)) + "...";
}

/// A word of the solver. Words are plain text; a byte that is not may end a message or disturb a
/// terminal.
std::string in_quotes(std::string_view word) {
  auto text = shortened(word, 40);
  for (char& c : text)
    if (c < ' ' || c > '~') c = '?';
  return "'" + text + "'";
}

double in_seconds(ChildProcess::Clock::duration time) {
  return std::chrono::duration<double>(time).count();
}

SolverDialogue::SolverDialogue(const SolverCommand& command, std::chrono::milliseconds time_limit,
                               std::chrono::milliseconds first_limit, const StopToken& stop)
    : name_(command_in_words(command.arguments)),
      remedy_if_silent_(command.remedy_if_silent),
      time_limit_(time_limit),
      first_limit_(first_limit) {
  try {
    process_.emplace(ProcessCommand{command.arguments, command.environment, command.folder}, stop);
  } catch (const Error& error) {
    const auto& remedy = command.remedy_if_missing;
    throw Error(error.kind(), fmt::format("the fluid solver {}{}{}", error.what(),
                                          remedy.empty() ? "" : "; ", remedy));
  }
}

SolverDialogue::~SolverDialogue() {
  if (!process_) return;
  process_->send("end\n");
  process_->finish(kGraceAtEnd);
}

void SolverDialogue::ask(std::string_view name, std::string_view text) {
  if (!process_)
    throw Error(ErrorKind::kExternalProgram,
                fmt::format("the fluid solver ({}) has ended after an earlier error", name_));
  // What comes before the first request is read when `ready` is expected.
  if (requests_ > 0 && process_->has_unread_output())
    fail("it wrote more than the answer", kGraceOfFailed);
  request_ = name;
  ++requests_;
  asked_at_ = ChildProcess::Clock::now();
  process_->send(text);
}

std::string_view SolverDialogue::next_word() {
  ChildProcess::Reading reading;
  try {
    reading = process_->read_word(asked_at_ + limit());
  } catch (const Error&) {
    process_.reset();
    throw;
  }
  if (reading.state == ChildProcess::State::kRead) {
    if (reading.text == "error") fail_as_solver_says();
    return reading.text;
  }
  fail_without_answer(reading.state);
}

void SolverDialogue::expect(std::string_view word, bool skip_lines) {
  awaited_ = in_quotes(word);
  constexpr int kMostLines = 1000;
  for (int i = 0; i < kMostLines; ++i) {
    if (next_word() == word) return;
    if (!skip_lines) refuse(in_quotes(word));
    process_->put_word_back();
    const auto line = process_->read_line(asked_at_ + limit());
    process_->keep(line.text);
    if (line.state != ChildProcess::State::kRead) fail_without_answer(line.state);
  }
  fail(fmt::format("it wrote {} other lines and not {}", kMostLines, in_quotes(word)),
       kGraceOfFailed);
}

std::string SolverDialogue::word() { return std::string(next_word()); }

double SolverDialogue::number() {
  const auto value = parse_number(next_word());
  if (!value) refuse("a finite number");
  return *value;
}

double SolverDialogue::number_from_zero() {
  const double value = number();
  if (value < 0) refuse("a number >= 0");
  return value;
}

std::vector<double> SolverDialogue::numbers(std::size_t count) {
  std::vector<double> values(count);
  numbers_asked_ = count;
  for (numbers_read_ = 0; numbers_read_ < count; ++numbers_read_) values[numbers_read_] = number();
  numbers_asked_ = 0;
  return values;
}

std::int64_t SolverDialogue::whole_number(std::int64_t largest) {
  const auto word = next_word();
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size() || value < 0 || value > largest)
    refuse(fmt::format("a whole number from 0 to {}", largest));
  return value;
}

void SolverDialogue::refuse(std::string_view needed) {
  process_->put_word_back();
  const std::string word(process_->read_word(ChildProcess::Clock::now()).text);
  process_->put_word_back();  // so that the whole line is among the last lines
  fail(fmt::format("it answered {} in place of {}", in_quotes(word), needed), kGraceOfFailed);
}

void SolverDialogue::fail_as_solver_says() {
  const auto line = process_->read_line(asked_at_ + limit());
  const auto start = line.text.find_first_not_of(" \t\r");
  fail(fmt::format("it says: {}", start == std::string_view::npos ? "an error without a text"
                                                                  : line.text.substr(start)),
       kGraceOfFailed);
}

void SolverDialogue::fail_without_answer(ChildProcess::State state) {
  switch (state) {
    case ChildProcess::State::kTimedOut:
      fail(fmt::format("it had not answered after {:g} s ({} was awaited){}{}{}",
                       in_seconds(limit()), awaited_,
                       numbers_asked_ > 0 ? fmt::format(", but for {} of {} numbers", numbers_read_,
                                                        numbers_asked_)
                                          : "",
                       remedy_if_silent_.empty() ? "" : "; ", remedy_if_silent_),
           0ms);
    case ChildProcess::State::kTooLong:
      fail(fmt::format("it wrote a word or a line of more than {} bytes",
                       ChildProcess::kLongestText),
           0ms);
    default:
      fail("it closed its output before the answer was complete", kGraceOfFailed);
  }
}

std::string SolverDialogue::asked_in_words() const {
  return fmt::format("request {}, '{}', {:.3g} s after it was sent", requests_, request_,
                     in_seconds(ChildProcess::Clock::now() - asked_at_));
}

void SolverDialogue::fail(const std::string& reason, std::chrono::milliseconds grace) {
  const std::string asked = asked_in_words();
  const std::string end = process_->finish(grace);
  std::vector<std::string> lines;
  constexpr std::size_t kLongestLine = 200;
  for (const auto& line : process_->last_lines()) lines.push_back(shortened(line, kLongestLine));
  process_.reset();
  throw Error(
      ErrorKind::kExternalProgram,
      fmt::format("the fluid solver ({}) failed at {}: {}; it {}; {}", name_, asked, reason, end,
                  lines.empty() ? "it wrote nothing else"
                                : fmt::format("its last lines: {}", fmt::join(lines, " | "))));
}

using particles::FluidParticles;

// How much longer the edges of the coarser mesh are from which an error is estimated.
constexpr double kCoarsening = 2;

// The error of the finer mesh over the difference from the coarser one. Errors fall as h^4, which
// makes a fifteenth; but so coarse a mesh does not follow this law yet, and h^3 makes a seventh.
constexpr double kErrorOfDifference = 1.0 / 7;

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

std::string words_of(const MeshBoundary& boundary) {
  std::string text =
      fmt::format("boundary {} {}\n", boundary.points.size(), boundary.curves.size());
  for (const auto& point : boundary.points) {
    append(text, point, "a point of the mesh around one");
    text += '\n';
  }
  for (const auto& curve : boundary.curves)
    text += fmt::format("{} {} {}\n", curve.first, curve.edges, curve.label);
  return text;
}

}  // namespace

FlowProcess::FlowProcess(const particles::Fluid& fluid, const particles::Domain& domain,
                         std::span<const double> radii, int dimension, SolverCommand command,
                         MeshBoundaryMaker make_boundary, const SolverLimits& limits)
    : dimension_(dimension),
      components_(radii.size() * particles::motion_components(dimension)),
      make_boundary_(std::move(make_boundary)),
      dissipation_alone_(dissipation_alone(fluid, domain)),
      command_(std::move(command)),
      limits_(limits),
      opening_(opening(fluid, domain, radii, dimension)) {
  start();
}

void FlowProcess::start() {
  if (solver_)
    peak_memory_of_earlier_ = std::max(peak_memory_of_earlier_, solver_->peak_memory_kb());
  solver_.reset();
  largest_system_ = 0;
  solver_ = std::make_unique<SolverDialogue>(command_, limits_.answer, limits_.ready, limits_.stop);
  solver_->ask("viscontact-fluid", opening_);
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
  placement_ = "place\n";
  append_places(placement_, bodies, dimension_);
  append_driven(placement_, bodies, dimension_);
  placement_ += fmt::format("inertia {}", bodies.inertia.size());
  append(placement_, bodies.inertia, "an inertia");
  placement_ += '\n';
  boundary_ = wants_boundary_ ? words_of(make_boundary_(bodies, 1)) : "";
  coarser_boundary_.clear();
  if (largest_system_ > command_.most_unknowns_reproduced) start();
  unknowns_ = ask_to_place(boundary_);
  is_on_coarser_mesh_ = false;
  if (wants_boundary_ && unknowns_ > limits_.most_unknowns_to_refine)
    coarser_boundary_ = words_of(make_boundary_(bodies, kCoarsening));
}

/// Returns the number of unknowns.
std::size_t FlowProcess::ask_to_place(const std::string& boundary) {
  solver_->ask("place", placement_ + boundary);
  solver_->expect("placed", command_.remarks_on_meshes);
  // A double holds all whole numbers up to this one, so that every solver can write them.
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
  // The solver answers 0 if it does not know the dissipation without particles.
  if (alone == 0) alone = dissipation_alone_;
  quantities.apparent_viscosity = alone == 0 ? 0 : quantities.dissipation / alone;
  quantities.fluid_forces = solver_->numbers(components_);
  return quantities;
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
  largest_system_ = std::max(largest_system_, 4 * unknowns_);  // of the refined mesh
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
