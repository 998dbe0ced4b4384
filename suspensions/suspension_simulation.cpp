// The state of a suspension and its instantaneous problem.
#include "viscontact/suspensions/suspension_simulation.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <optional>
#include <string_view>
#include <utility>

#include "viscontact/common/error.hpp"
#include "viscontact/particles/domain/bounded_region.hpp"
#include "viscontact/particles/steps/step_times.hpp"
#include "viscontact/suspensions/cell/pair_search.hpp"
#include "viscontact/suspensions/cell/planes.hpp"
#include "viscontact/suspensions/cell/sheared_cell.hpp"
#include "viscontact/suspensions/cell/strained_lattice.hpp"
#include "viscontact/suspensions/instant.hpp"
#include "viscontact/suspensions/pairs/pair_sizes.hpp"
#include "viscontact/suspensions/pairs/pair_system.hpp"
#include "viscontact/suspensions/setting_checks.hpp"
#include "viscontact/suspensions/step/sphere_order.hpp"
#include "viscontact/suspensions/step/suspension_step.hpp"
#include "viscontact/suspensions/values/stress_sums.hpp"

namespace viscontact::particles {
namespace {

using suspensions::Motion;
using suspensions::NearPair;
using suspensions::ShearedCell;

struct SuspensionTuning {
  // Of an instant, relative; errors of the power are about its square.
  static constexpr double kInstantTolerance = 1e-11;
  // Gaps below this fraction of the mean radius count as rounding errors.
  static constexpr double kLeastGap = 1e-12;
  // In mean radii: the least range of the search, because spheres move in a step.
  static constexpr double kLeastSearch = 0.2;
  // If a flow changes at most by this factor, the motions of its last step times it begin a step.
  static constexpr double kMostChange = 10;
  // Overlap that no step leaves, in mean radii: half of what is allowed.
  static constexpr double kMostOverlap = 5e-8;
  // A step that is not solved is taken in half of its length, and so on. If only the stress or
  // Coulomb's law are not right, the last part is taken after fewer halvings. The spheres jam if
  // there is no solution after the last halving, or none that obeys Coulomb's law in so many steps
  // one after the other. At the edge of jamming up to 5 follow each other.
  static constexpr int kMostHalvings = 7, kMostForFriction = 3, kMostUnsolved = 20;
  // Near jamming a step with friction is at most so many times as long as the last one, because
  // most longer ones have no solution.
  static constexpr double kMostGrowth = 8;
  // More spheres than this are sorted, because their numbers do not fit into the nearest cache.
  static constexpr std::size_t kMostUnordered = 1024;
  // Largest range of the search without a box, in mean radii.
  static constexpr double kMostSearch = 100;
};

double largest_distance(const PairLubrication& lubrication, const Particles& particles) {
  return suspensions::largest_distance(particles.radii,
                                       std::max(lubrication.range, SuspensionTuning::kLeastSearch));
}

/// Of lattices that do not last against the flow.
constexpr std::string_view kLastsBothWays =
    "a planar extension without rotation, in a box whose edges in its plane are equal, has no such "
    "end";

/// The factor by which the flow has changed, if motions times it are near those of the new flow;
/// else 1.
double change_of(double now_before, double before_before) {
  const double change = before_before > 0 ? now_before / before_before : 1;
  const double size = std::abs(change);
  return size * SuspensionTuning::kMostChange >= 1 && size <= SuspensionTuning::kMostChange ? change
                                                                                            : 1;
}

}  // namespace

struct SuspensionSimulation::Content {
  Setting setting;
  State state;
  std::array<Vector, 3> gradient{};  // of the flow of rate 1, in the last step
  suspensions::SymmetricTensor strain{};
  std::optional<double> stress;  // of the last step, if it is given
  double mean_radius = 1, volume = 0;
  std::optional<suspensions::StrainedLattice> lasting;  // if the periods of the state are its
  double sense = 1;  // of the net strain of the state, in the direction of `lasting`
  std::vector<suspensions::PlaneBody> planes;
  std::vector<double> radii;  // of all bodies, the planes after the spheres
  Rheology rheology;
  std::unique_ptr<ThreadPool> pool;
  int unsolved = 0;          // steps one after the other in which Coulomb's law is not right
  bool has_instant = false;  // whether `rheology` and the velocities are those of the present state

  const PairLubrication& lubrication() const { return *setting.lubrication; }
  Particles& particles() { return state.particles; }
  /// Those of viscous contact, (9.14).
  bool contacts_have_films() const { return lubrication().pairs == PairTerms::kNone; }
  ShearedCell cell() const {
    ShearedCell cell;
    if (const auto* box = std::get_if<BoxDomain>(&setting.domain)) cell.from = box->from;
    cell.lengths = periods_of(setting.domain);
    cell.offset = state.shear.offset;
    if (state.shear.has_periods()) cell.lattice.emplace(state.shear.periods, middle_of_box());
    return cell;
  }
  Vector middle_of_box() const {
    const auto& box = std::get<BoxDomain>(setting.domain);
    return 0.5 * (box.from + box.to);
  }
  double volume_of_region() const {
    const double measured =
        size_of_region(setting.domain, positions_of(setting.planes, state.time), 3);
    return measured > 0 ? measured : std::numeric_limits<double>::infinity();
  }
  /// The image displacements that tables of contacts need.
  void set_cell() {
    auto& shown = particles().cell;
    shown = cell_of(setting.domain);
    if (state.shear.has_periods()) {
      shown.vectors = state.shear.periods;
      return;
    }
    if (shown.lengths[0] > 0 && shown.lengths[1] > 0) shown.offset = state.shear.offset;
  }
  void wrap() {
    const auto cell_now = cell();
    for (std::size_t k = 0; k < particles().count(); ++k) {
      const Vector x = cell_now.wrapped(particles().position(k));
      std::ranges::copy(x, &particles().positions[3 * k]);
    }
  }

  Vector flow_at(const Vector& x) const {
    return state.shear.rate * suspensions::times(gradient, x);
  }
  std::vector<Motion> relative_motions() const {
    const auto& p = state.particles;
    const Vector rotation = state.shear.rate * suspensions::rotation_of(gradient);
    std::vector<Motion> motions(radii.size());
    for (std::size_t k = 0; k < p.count(); ++k) {
      motions[k].along = suspensions::lanes_of(p.velocity(k) - flow_at(p.position(k)));
      motions[k].turn =
          suspensions::lanes_of(point_of(p.angular_velocities.data(), k, 3) - rotation);
    }
    return motions;
  }
  void set_velocities(const std::vector<Motion>& motions) {
    auto& p = particles();
    const Vector rotation = state.shear.rate * suspensions::rotation_of(gradient);
    for (std::size_t k = 0; k < p.count(); ++k) {
      std::ranges::copy(suspensions::vector_of(motions[k].along) + flow_at(p.position(k)),
                        &p.velocities[3 * k]);
      std::ranges::copy(suspensions::vector_of(motions[k].turn) + rotation,
                        &p.angular_velocities[3 * k]);
    }
  }

  /// Sets the flow, or the stress, between two times within one piece, or at a time.
  void set_flow(double from, double to) {
    const double middle =
        to > from ? from + (to - from) / 2 : from + StepGrid::tiny(setting.time_step);
    const auto flow = lubrication().flow_at(middle);
    gradient = flow.gradient;
    strain = suspensions::strain_rate_of(gradient);
    stress = flow.stress;
    const double factor = lubrication().factor(from, to);
    if (stress)
      *stress *= factor;
    else
      state.shear.rate = factor;
  }
  /// Sets them as they were in the last step, by the state alone.
  void restore_flow() {
    const double rate = state.shear.rate;
    set_flow(state.time - state.earlier_step, state.time);
    state.shear.rate = rate;
  }
  suspensions::SymmetricTensor strain_now() const {
    suspensions::SymmetricTensor now;
    now.add(state.shear.rate, strain);
    return now;
  }
  /// Gives the shear rate, which is a magnitude, the sign of the flow.
  void set_sign(Rheology& of) const {
    if (signed_rate_of_strain(gradient_now()) < 0 && of.shear_rate > 0) of.shear_rate *= -1;
  }
  std::array<Vector, 3> gradient_now() const {
    auto now = gradient;
    for (auto& row : now) row = state.shear.rate * row;
    return now;
  }

  /// Forces and torques that do not depend on the motion, means between two times.
  std::vector<Motion> given_loads(double from, double to) const {
    const auto& p = state.particles;
    std::vector<Motion> loads(radii.size());
    const auto at = [&](const auto& map, std::size_t k) {
      const auto found = map.find(static_cast<std::int32_t>(k));
      if (found == map.end()) return Vector{};
      return to > from ? found->second.mean(from, to) : found->second.value(from);
    };
    for (std::size_t k = 0; k < p.count(); ++k) {
      const double mass = p.masses.empty() ? 0 : p.masses[k];
      loads[k].along = suspensions::lanes_of(mass * setting.gravity + at(setting.forces, k) +
                                             added_force(setting, k, 3));
      loads[k].turn = suspensions::lanes_of(at(setting.torques, k) + added_torque(setting, k, 3));
    }
    return loads;
  }
  /// Whether the gap of a pair is below the range, beyond which pairs have neither films nor
  /// repulsion and are listed only because they may come near in a step.
  bool is_in_range(const NearPair& pair) const {
    const auto sizes = sizes_of(pair);
    return norm(pair.apart) < sizes.touching + lubrication().range * sizes.mean;
  }
  suspensions::PairSizes sizes_of(const NearPair& pair) const {
    return suspensions::sizes_of(radii[index_of(pair.first)], radii[index_of(pair.second)]);
  }
  /// Adds the repulsion of the pairs to `loads`. Returns its part of the stress sums at the rate 1.
  suspensions::StressPart add_repulsion(const std::vector<NearPair>& pairs,
                                        std::vector<Motion>& loads) const {
    suspensions::StressPart sum;
    if (!lubrication().repulsion) return sum;
    const auto [amplitude, length] = *lubrication().repulsion;
    for (const auto& pair : pairs) {
      const auto i = index_of(pair.first), j = index_of(pair.second);
      const auto sizes = sizes_of(pair);
      const double distance = norm(pair.apart);
      if (!is_in_range(pair)) continue;
      const double force =
          amplitude * sizes.reduced * std::exp(-(distance - sizes.touching) / length);
      const auto push = suspensions::lanes_of((force / distance) * pair.apart);
      loads[i].along -= push;
      loads[j].along += push;
      sum.add_pair_force(suspensions::vector_of(push), pair.apart, gradient);
    }
    return sum;
  }
  std::vector<NearPair> find_pairs(double range) const {
    const auto& p = state.particles;
    auto pairs = suspensions::near_pairs(cell(), p.positions, p.radii, range, pool.get());
    suspensions::add_plane_pairs(planes, p.positions, p.radii, range, pairs);
    return pairs;
  }
  /// Range [in mean radii] of pairs that may come near in a step of length h: twice what the flow
  /// closes of it, and what the last motions, relative to the flow, close.
  double search_range(double h, const std::vector<Motion>& motions) const {
    const double sheared =
        h * std::sqrt(2 * strain.contracted(strain)) * std::abs(state.shear.rate);
    double fastest = 0;
    for (const auto& motion : motions)
      fastest = std::max(fastest, norm(suspensions::vector_of(motion.along)));
    double most = SuspensionTuning::kMostSearch;
    const double diameter = suspensions::largest_distance(state.particles.radii, 0);
    most = std::min(most, cell().least_height() / diameter - 2);
    const double by_flow = sheared < 2 ? 2 * sheared / (1 - sheared / 2) : most;
    const double least = std::max(lubrication().range, SuspensionTuning::kLeastSearch);
    return std::max(std::min(by_flow + 2 * h * fastest / mean_radius, most), least);
  }
  double smallest_gap(const std::vector<NearPair>& pairs) const {
    double smallest = std::numeric_limits<double>::infinity();
    for (const auto& pair : pairs)
      smallest = std::min(smallest, norm(pair.apart) - sizes_of(pair).touching);
    return smallest;
  }

  /// Steps end where the flow changes.
  StepGrid grid() const { return StepGrid(setting.time_step, false, jump_times(setting)); }
  suspensions::InstantSolution solve_instant();
  std::vector<suspensions::ContactMemory> memories(double h) const;
  /// `start` are motions near the solution. Sets the rate if the stress is given.
  suspensions::StepSolution solve_step(double h, std::vector<NearPair> pairs,
                                       std::vector<Motion> start, bool takes_given_bounds);
  /// The largest overlap of two spheres where they are [L], 0 if there is none.
  double largest_overlap() const { return std::max(-smallest_gap(find_pairs(0)), 0.0); }
  void add_inertia(suspensions::StepProblem& problem) const;
  // Sets the period vectors, if the cell needs them, and turns the box and its spheres.
  void start_periods();
  // Sets `lasting` if it has the periods of the state.
  void find_lasting(const FlowPath& path);
  // `back` is the net strain at all times from now on, at least, <= 0.
  void check_lasting(double back) const;
  void turn_box(const suspensions::Matrix& turn);
  // Adds the strains of a step.
  void strain_by(double h);
  void move_periods(double h);
  // Throws Error(kNotConverged) if images are too near for the search of pairs.
  void check_images() const;
  void move(const suspensions::StepSolution& solution, double h);
  void remember(const std::vector<suspensions::ContactMemory>& contacts, double h);
};

suspensions::InstantSolution SuspensionSimulation::Content::solve_instant() {
  set_flow(state.time, state.time);
  const double given = stress ? 1 : state.shear.rate;
  suspensions::SymmetricTensor given_strain;
  given_strain.add(given, strain);
  const auto pairs = find_pairs(lubrication().range);
  const suspensions::PairSystem system(
      lubrication(), radii,
      suspensions::placed(pairs, radii, SuspensionTuning::kLeastGap * mean_radius), *pool);
  suspensions::InstantProblem problem{
      &system, given_strain, lubrication().viscosity, volume, given_loads(state.time, state.time),
      {},      stress};
  problem.pool = pool.get();
  problem.softest = std::min(lubrication().drag, 1.0);
  problem.load_stress = add_repulsion(pairs, problem.loads).stress;
  suspensions::InstantSolution solution;
  if (lubrication().inertia) {
    // The velocities are given.
    state.shear.rate = given;
    solution.motions = relative_motions();
  } else {
    solution = suspensions::solve_instant(problem, std::vector<Motion>(radii.size()),
                                          SuspensionTuning::kInstantTolerance);
    state.shear.rate = given * solution.rate;
    set_velocities(solution.motions);
  }
  suspensions::check_plane_motions(setting, gradient_now(), state.time, state.time);
  set_cell();

  suspensions::SymmetricTensor rate;
  rate.add(solution.rate, given_strain);
  suspensions::StressSums sums;
  sums.film.stress = system.stresslets(solution.motions, rate);
  sums.film.power = sums.film.stress.contracted(rate);
  sums.repulsion.stress = problem.load_stress;
  sums.repulsion.power = problem.load_stress.contracted(rate);
  rheology = {.time = state.time, .strain = state.shear.strain};
  rheology.net_strain = state.shear.net_strain;
  rheology.pairs = pairs.size();
  rheology.smallest_gap = smallest_gap(pairs);
  suspensions::set_stresses(sums, rate, 0, lubrication().viscosity, volume, rheology);
  set_sign(rheology);
  return solution;
}

SuspensionSimulation::SuspensionSimulation(Setting setting, State state, int threads)
    : content_(std::make_unique<Content>()) {
  auto& content = *content_;
  content.setting = std::move(setting);
  content.state = std::move(state);
  content.pool = std::make_unique<ThreadPool>(threads);
  assert(content.setting.lubrication && !content.setting.fluid);
  assert(content.particles().dimension == 3 && content.particles().turn());
  check_setting(content.setting, largest_distance(content.lubrication(), content.particles()));
  content.restore_flow();
  content.mean_radius = mean_radius(content.particles());
  content.volume = content.volume_of_region();
  content.planes = suspensions::planes_beside(content.setting);
  content.radii = content.particles().radii;
  content.radii.resize(content.radii.size() + content.planes.size(),
                       std::numeric_limits<double>::infinity());
  if (content.state.steps == 0 && content.state.time == 0 && !content.state.shear.has_periods()) {
    content.state.shear = {};
    content.state.shear.offset = content.cell().moved_offset(content.lubrication().offset);
  }
  content.start_periods();
  content.wrap();
  content.set_cell();
  check_spheres(content.setting, content.particles(),
                content.smallest_gap(content.find_pairs(content.lubrication().range)));
}

SuspensionSimulation::~SuspensionSimulation() = default;
SuspensionSimulation::SuspensionSimulation(SuspensionSimulation&&) noexcept = default;

const State& SuspensionSimulation::state() const { return content_->state; }
const Rheology& SuspensionSimulation::rheology() const { return content_->rheology; }

std::span<double> SuspensionSimulation::added_forces() {
  content_->has_instant = false;
  return added_forces_for(content_->particles(), content_->setting);
}
std::span<double> SuspensionSimulation::added_torques() {
  content_->has_instant = false;
  return added_torques_for(content_->particles(), content_->setting);
}

const Rheology& SuspensionSimulation::solve_instant() {
  if (!content_->solve_instant().converged)
    throw Error(ErrorKind::kNotConverged, "the velocities of the suspension have not converged");
  content_->has_instant = true;
  return content_->rheology;
}

std::vector<suspensions::ContactMemory> SuspensionSimulation::Content::memories(double h) const {
  std::vector<suspensions::ContactMemory> result;
  const double before = state.earlier_step > 0 ? 1 / state.earlier_step : 0;
  const auto add = [&](const Pair& pair, std::int32_t first, std::int32_t second, double sign) {
    suspensions::ContactMemory memory{first, second};
    memory.load = before * pair.impulse;
    memory.friction = sign * before * state.memories.of(pair.memory).friction();
    if (contacts_have_films()) memory.least_load = pair.gamma / h;
    result.push_back(memory);
  };
  for (const auto& pair : state.pairs) add(pair, pair.first, pair.second, 1);
  const auto spheres = static_cast<std::int32_t>(state.particles.count());
  for (const auto& pair : state.walls) add(pair, pair.second, spheres - 1 - pair.first, -1);
  std::ranges::sort(result, {}, [](const suspensions::ContactMemory& memory) {
    return std::pair(memory.first, memory.second);
  });
  return result;
}

void SuspensionSimulation::Content::move(const suspensions::StepSolution& solution, double h) {
  const auto& motions = solution.motions;
  auto& p = particles();
  const auto now = gradient_now();
  const auto velocities = p.velocities, angular_velocities = p.angular_velocities;
  for (std::size_t k = 0; k < p.count(); ++k) {
    const Vector v = suspensions::vector_of(motions[k].along);
    const Vector x =
        suspensions::carried(now, h, p.position(k)) + h * suspensions::mean_carried(now, h, v);
    std::ranges::copy(x, &p.positions[3 * k]);
  }
  strain_by(h);
  move_periods(h);
  const auto unwrapped = p.positions;
  wrap();
  set_velocities(motions);
  turn_particles(
      p,
      [&] {
        std::vector<double> turns = p.angular_velocities;
        for (auto& turn : turns) turn *= h;
        return turns;
      }(),
      h);
  for (std::size_t k = 0; k < solution.changes.size(); ++k) {
    // A sphere that leaves the cell enters it with the velocity of its image.
    const Vector shift = p.position(k) - point_of(unwrapped.data(), k, 3);
    const Vector v = point_of(velocities.data(), k, 3) +
                     suspensions::vector_of(solution.changes[k].along) + flow_at(shift);
    const Vector w = point_of(angular_velocities.data(), k, 3) +
                     suspensions::vector_of(solution.changes[k].turn);
    std::ranges::copy(v, &p.velocities[3 * k]);
    std::ranges::copy(w, &p.angular_velocities[3 * k]);
  }
  set_cell();
}

void SuspensionSimulation::Content::start_periods() {
  auto& shear = state.shear;
  if (!strains_cell(lubrication(), setting.domain) && !shear.has_periods()) return;
  const auto path = lubrication().stress ? FlowPath{} : path_of(lubrication());
  const auto lengths = periods_of(setting.domain);
  const bool is_new = !shear.has_periods() && state.steps == 0;
  if (!shear.has_periods()) {
    const suspensions::StrainedLattice lattice(lengths, path.direction, lubrication().turns_box);
    auto start = lattice.start();
    if (!is_new) {
      // A run that continues a shear: the box is where the shear left it.
      start = {};
      for (std::size_t d = 0; d < 3; ++d) start[d][d] = lengths[d];
      start[1][0] = shear.offset;
    }
    shear.offset = 0;
    shear.periods = suspensions::reduced(start);
    if (is_new) turn_box(lattice.turn());
  }
  find_lasting(path);
  check_lasting(is_new ? path.lowest : 0);
  check_images();
}

void SuspensionSimulation::Content::find_lasting(const FlowPath& path) {
  // The run that turned the box may have had the opposite direction.
  for (const double sign : {1.0, -1.0}) {
    auto direction = path.direction;
    for (auto& row : direction) row = sign * row;
    const suspensions::StrainedLattice lattice(periods_of(setting.domain), direction, true);
    sense = sign * path.sense;
    const double t = sense * state.shear.net_strain;
    if (lattice.kind() == suspensions::StrainedLattice::Kind::kAsTheBox || t < lattice.earliest() ||
        !suspensions::are_same(lattice.at(t), state.shear.periods))
      continue;
    lasting = lattice;
    return;
  }
}

void SuspensionSimulation::Content::check_lasting(double back) const {
  if (!lasting) return;
  const double needed = 2 * largest_distance(lubrication(), state.particles);
  const double least = lasting->least_height();
  if (least < needed)
    throw Error(ErrorKind::kBadInput,
                "the box is too small for this extension: opposite faces of its strained cell "
                "come as near as {:.6g}, and must stay {:.6g} apart, twice the largest distance "
                "of a pair; the edges must be at least {:.3g} times as long",
                least, needed, needed / least);
  if (lasting->least_height(back) < needed)
    throw Error(ErrorKind::kBadInput,
                "the flow goes back by the strain {:.6g} beyond its start, where opposite faces of "
                "the strained cell come nearer than {:.6g}, twice the largest distance of a pair",
                -back, needed);
}

void SuspensionSimulation::Content::turn_box(const suspensions::Matrix& turn) {
  auto& p = particles();
  const auto cell_now = cell();
  const Vector middle = middle_of_box();
  for (std::size_t k = 0; k < p.count(); ++k) {
    const Vector x = cell_now.wrapped(middle + suspensions::times(turn, p.position(k) - middle));
    std::ranges::copy(x, &p.positions[3 * k]);
  }
}

void SuspensionSimulation::Content::check_images() const {
  if (!state.shear.has_periods()) return;
  const double least = cell().least_height();
  const double needed = 2 * largest_distance(lubrication(), state.particles);
  if (lasting && sense * state.shear.net_strain < lasting->earliest())
    throw Error(ErrorKind::kNotConverged,
                "the flow has reversed too far beyond its start at t = {:.6g}, the net strain "
                "{:.6g}; {}",
                state.time, state.shear.net_strain, kLastsBothWays);
  if (least < needed)
    throw Error(ErrorKind::kNotConverged,
                "the flow has brought images of the spheres too near at t = {:.6g}, the strain "
                "{:.6g}: opposite faces of the cell are {:.6g} apart, and must be {:.6g} apart, "
                "twice the largest distance of a pair; {}",
                state.time, state.shear.strain, least, needed,
                lasting ? kLastsBothWays
                        : "a larger box gets further, and a box that is turned at the start for a "
                          "planar extension, or a cube for one along three axes, has no such end");
}

void SuspensionSimulation::Content::strain_by(double h) {
  const double rate = std::sqrt(2 * strain.contracted(strain));
  const double net = h * rate * std::abs(state.shear.rate);
  const auto& wave = lubrication().wave;
  state.shear.strain +=
      wave && !stress ? h * rate * wave->mean_magnitude_over(state.time, state.time + h) : net;
  state.shear.net_strain += signed_rate_of_strain(gradient_now()) < 0 ? -net : net;
}

void SuspensionSimulation::Content::move_periods(double h) {
  auto& shear = state.shear;
  if (!shear.has_periods()) {
    shear.offset = cell().moved_offset(h * gradient_now()[0][1] * periods_of(setting.domain)[1]);
    return;
  }
  shear.periods = lasting ? lasting->at(sense * shear.net_strain)
                          : suspensions::carried_lattice(gradient_now(), h, shear.periods);
}

void SuspensionSimulation::Content::add_inertia(suspensions::StepProblem& problem) const {
  const auto& p = state.particles;
  const auto& gradient_of_step = problem.gradient;
  const double h = problem.h;
  const Vector rotation = suspensions::rotation_of(gradient_of_step);
  for (std::size_t k = 0; k < p.count(); ++k) {
    const Vector x = p.position(k), last = suspensions::vector_of(problem.motions[k].along);
    const Vector flow = (1 / h) * (suspensions::carried(gradient_of_step, h, x) - x) +
                        suspensions::mean_carried(gradient_of_step, h, last) - last;
    suspensions::SphereInertia inertia{p.masses[k], p.inertias[k]};
    inertia.start.along = suspensions::lanes_of(p.velocity(k) - flow);
    inertia.start.turn =
        suspensions::lanes_of(point_of(p.angular_velocities.data(), k, 3) - rotation);
    problem.inertia.push_back(inertia);
  }
}

void SuspensionSimulation::Content::remember(
    const std::vector<suspensions::ContactMemory>& contacts, double h) {
  const auto cell_now = cell();
  std::vector<Pair> pairs, walls;
  PairMemories memories_now;
  const auto spheres = static_cast<std::int32_t>(state.particles.count());
  for (const auto& contact : contacts) {
    const bool has_plane = contact.second >= spheres;
    Pair pair{contact.first, contact.second};
    if (has_plane) pair = {spheres - 1 - contact.second, contact.first};
    pair.impulse = h * contact.load;
    double borne_by_film = 0;
    if (contacts_have_films()) {
      const double lowest = setting.laws.film.lowest_gamma(radii[index_of(contact.first)],
                                                           radii[index_of(contact.second)]);
      pair.gamma = h * contact.least_load;
      borne_by_film = pair.gamma - lowest;
      FilmLaw::absorb(pair, 0, lowest);
    }
    if (!has_plane) {
      const Vector apart = state.particles.position(index_of(pair.second)) -
                           state.particles.position(index_of(pair.first));
      // The image of the second sphere that is near has the opposite shift.
      const auto periods = cell_now.periods_towards(apart);
      pair.image = image_number(-static_cast<int>(periods[0]), -static_cast<int>(periods[1]),
                                -static_cast<int>(periods[2]));
    }
    PairMemory memory;
    // Files have the friction on the sphere beside a plane.
    memory.set_friction((has_plane ? -h : h) * contact.friction);
    memory[Remembered::kSolidLoad] = std::max(pair.impulse - borne_by_film, 0.0);
    memories_now.set(pair.memory, memory);
    if (pair.impulse != 0 || pair.gamma != 0) (has_plane ? walls : pairs).push_back(pair);
  }
  memories_now.keep_only(pairs, walls);
  state.pairs = std::move(pairs);
  state.walls = std::move(walls);
  state.memories = std::move(memories_now);
}

suspensions::StepSolution SuspensionSimulation::Content::solve_step(double h,
                                                                    std::vector<NearPair> pairs,
                                                                    std::vector<Motion> start,
                                                                    bool takes_given_bounds) {
  suspensions::StepProblem problem;
  problem.takes_given_bounds = takes_given_bounds;
  problem.lubrication = lubrication();
  if (setting.laws.friction) problem.friction = setting.laws.friction->coefficient;
  if (contacts_have_films()) problem.contact_film = &setting.laws.film;
  problem.radii = radii;
  problem.mean_radius = mean_radius;
  problem.memories = memories(h);
  problem.pool = pool.get();
  problem.motions = std::move(start);
  problem.loads = given_loads(state.time, state.time + h);
  problem.gradient = gradient_now();
  problem.h = h;
  if (lubrication().inertia) add_inertia(problem);
  auto repulsion = add_repulsion(pairs, problem.loads);
  problem.pairs = std::move(pairs);
  if (stress) {
    auto& given = problem.stress.emplace();
    given.gradient = gradient;
    given.rate = state.shear.rate;
    given.of_fluid = 2 * lubrication().viscosity * volume * strain.contracted(strain);
    given.of_stress = volume * *stress;
    given.of_repulsion = repulsion.power;
  }
  auto solution = particles().count() > SuspensionTuning::kMostUnordered
                      ? suspensions::solve_in_order(
                            std::move(problem), suspensions::spatial_order(particles().positions))
                      : suspensions::SuspensionStep(std::move(problem)).solve();
  if (stress) state.shear.rate = solution.rate;
  repulsion.power *= state.shear.rate;
  solution.stresses.repulsion = repulsion;
  return solution;
}

StepReport SuspensionSimulation::step(double end) {
  auto& content = *content_;
  auto& state = content.state;
  StepReport report;
  report.time = state.time;
  const auto interval = content.grid().next(state, end);
  if (!interval) return report;
  content.check_images();
  if (state.steps == 0 && !content.has_instant) content.solve_instant();
  content.has_instant = false;
  content.restore_flow();
  const State start = state;
  const auto before = content.relative_motions();
  const auto stress_before = content.stress;
  const auto strain_before = content.strain_now();
  const double allowed =
      std::max(content.largest_overlap(), SuspensionTuning::kMostOverlap * content.mean_radius);
  double h = interval->h;
  suspensions::StepSolution solution;
  std::size_t pairs_in_range = 0;
  int solutions = 0, halvings = 0;
  while (content.setting.laws.friction && state.earlier_step > 0 &&
         h > SuspensionTuning::kMostGrowth * state.earlier_step &&
         halvings < SuspensionTuning::kMostHalvings) {
    h /= 2;
    ++halvings;
  }
  for (;; ++halvings, h /= 2) {
    if (halvings > SuspensionTuning::kMostHalvings ||
        content.unsolved >= SuspensionTuning::kMostUnsolved)
      throw Error(ErrorKind::kNotConverged,
                  "the spheres jam at t = {:.6g}, the strain {:.6g}: a step of {:.3g} has no "
                  "solution; use a smaller volume fraction, less friction, or a shorter step",
                  start.time, start.shear.strain, 2 * h);
    state = start;
    content.set_flow(state.time, state.time + h);
    // With inertia the motions at the start are given, relative to the new flow.
    const bool has_inertia = content.lubrication().inertia;
    auto motions = has_inertia ? content.relative_motions() : before;
    // Motions of a suspension at another rate are nearly proportional to it.
    const double change =
        content.stress && stress_before
            ? change_of(*content.stress * *stress_before, *stress_before * *stress_before)
            : change_of(content.strain_now().contracted(strain_before),
                        strain_before.contracted(strain_before));
    if (content.stress) state.shear.rate *= change;
    if (change != 1 && !has_inertia)
      for (auto& motion : motions) {
        motion.along *= change;
        motion.turn *= change;
      }
    auto pairs = content.find_pairs(content.search_range(h, motions));
    pairs_in_range = static_cast<std::size_t>(std::ranges::count_if(
        pairs, [&](const NearPair& pair) { return content.is_in_range(pair); }));
    solution = content.solve_step(h, std::move(pairs), std::move(motions),
                                  halvings >= SuspensionTuning::kMostForFriction);
    report.iterations += solution.iterations;
    solutions += solution.solutions;
    if (!solution.is_solved || !std::isfinite(solution.dissipation)) continue;
    if (!solution.converged && halvings < SuspensionTuning::kMostForFriction) continue;
    suspensions::check_plane_motions(content.setting, content.gradient_now(), start.time,
                                     start.time + h);
    content.move(solution, h);
    report.largest_overlap = content.largest_overlap();
    if (report.largest_overlap <= allowed) break;
  }
  report.largest_overlap /= content.mean_radius;
  report.parts = 1;
  report.contacts = solution.touching;
  report.residual = solution.residual;
  report.converged = solution.converged;
  if (!report.converged) report.excess = std::numeric_limits<double>::infinity();
  report.has_given_loads = solution.has_given_loads;
  content.unsolved = solution.has_given_loads ? content.unsolved + 1 : 0;
  auto taken = *interval;
  if (halvings > 0) {
    // The next step goes on to the same point of the grid.
    taken.h = h;
    taken.end = state.time + h;
    taken.new_grid = interval->end - content.setting.time_step;
  }
  content.remember(solution.contacts, h);
  state.time = taken.end;
  state.earlier_step = h;
  StepGrid::count(state, taken);
  report.time = state.time;

  auto& rheology = content.rheology;
  rheology = {.time = state.time, .strain = state.shear.strain};
  rheology.net_strain = state.shear.net_strain;
  rheology.pairs = pairs_in_range;
  rheology.contacts = solution.touching;
  rheology.smallest_gap = solution.smallest_gap;
  rheology.dissipation = solution.dissipation;
  suspensions::set_stresses(solution.stresses, content.strain_now(), solution.least_rate,
                            content.lubrication().viscosity, content.volume, rheology);
  content.set_sign(rheology);
  rheology.solutions = solutions;
  return report;
}

}  // namespace viscontact::particles
