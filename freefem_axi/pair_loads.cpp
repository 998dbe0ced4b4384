// Calls the FreeFEM script of a geometry with -strains 1, and reads the lines "viscontact-entry".
#include "viscontact/freefem_axi/pair_loads.hpp"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <cmath>
#include <limits>
#include <numbers>
#include <sstream>
#include <string>

#include "viscontact/common/error.hpp"
#include "viscontact/common/text/number.hpp"

namespace viscontact::freefem_axi {
namespace {

/// A kind of velocity of a surface in scripts/row.idp, which is also a load.
struct SurfaceVelocity {
  int length;         ///< power of the length in it: 0 of a velocity, 1 of a turn and of a strain
  bool is_strain;     ///< E.(x - centre)
  double contracted;  ///< load of row.idp over the force, torque or component of S that is wanted
  double ambient;     ///< own S by the stress 2 mu E of the undisturbed flow, over pi mu r^3
};
constexpr SurfaceVelocity kMove{0, false, 1, 0}, kTurn{1, false, 1, 0}, kDilation{1, false, 1, 0};
// 2 (4/3) E_zz, E_xz, E_xx. row.idp gives E:S, which is S_zz, 2 S_xz or 2 S_xx.
constexpr SurfaceVelocity kAxialStrain{1, true, 1, 16.0 / 9}, kStrain{1, true, 2, 8.0 / 3};

/// Differences |R_ij - R_ji| over sqrt(R_ii R_jj) are 1e-16 to 1e-12 (bench_motions), the residuals
/// of a solve that row.idp accepts at most 1e-9.
constexpr double kMostAsymmetry = 1e-8;

std::vector<SurfaceVelocity> velocities_of(MotionGroup group) {
  switch (group) {
    case MotionGroup::kAlong:
      return {kMove, kAxialStrain, kDilation};
    case MotionGroup::kAcross:
      return {kMove, kTurn, kStrain};
    case MotionGroup::kAround:
      return {kTurn};
    case MotionGroup::kTwofold:
      return {kStrain};
  }
  assert(false);
  return {};
}

/// Sets the numbers of `loads` as row.idp prints them. Returns false unless there is a line for
/// each load of each source.
bool read_entries(const std::string& output, PairLoads& loads) {
  std::size_t count = 0;
  std::istringstream lines(output);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string name, value, error, order;
    std::size_t solution = 0, body = 0, load = 0;
    if (!(words >> name) || name != "viscontact-entry") continue;
    if (!(words >> solution >> body >> load >> value >> error >> order)) return false;
    if (solution >= loads.bodies * loads.sources_of_body || body >= loads.bodies ||
        load >= loads.loads_of_body)
      return false;
    const auto here =
        loads.place(body, load, solution / loads.sources_of_body, solution % loads.sources_of_body);
    const auto number = parse_number(value), estimate = parse_number(error),
               observed = parse_number(order);
    if (!number || !estimate || !observed) return false;
    loads.observed_orders.at(solution) = *observed;
    loads.loads.at(here) = *number;
    loads.errors.at(here) = *estimate;
    ++count;
  }
  return count == loads.loads.size();
}

/// Gives R_ij and R_ji, which are one number, the same error: the larger one of their estimates plus
/// |R_ij - R_ji|. Returns the largest of these differences over sqrt(R_ii R_jj).
double make_errors_symmetric(PairLoads& loads) {
  const auto size = [&](std::size_t body, std::size_t kind) {
    return std::abs(loads.loads[loads.place(body, kind, body, kind)]);
  };
  const auto estimates = loads.errors;
  double largest = 0;
  for (std::size_t body = 0; body < loads.bodies; ++body)
    for (std::size_t load = 0; load < loads.sources_of_body; ++load)
      for (std::size_t of = 0; of < loads.bodies; ++of)
        for (std::size_t source = 0; source < loads.sources_of_body; ++source) {
          const auto one = loads.place(body, load, of, source),
                     other = loads.place(of, source, body, load);
          const double difference = std::abs(loads.loads[one] - loads.loads[other]);
          loads.errors[one] = std::max(estimates[one], estimates[other]) + difference;
          // Without this case, 0/0 would refuse numbers that are all exact.
          if (difference > 0)
            largest =
                std::max(largest, difference / std::sqrt(size(body, load) * size(of, source)));
        }
  return largest;
}

/// From the units and signs of row.idp, where a strain has the velocity +E.(x - centre), to those
/// of PairLoads.
void convert(const Tabulation& tabulation, PairLoads& loads) {
  const auto velocities = velocities_of(loads.group);
  const double radius = tabulation.radius, mu = tabulation.viscosity;
  for (std::size_t body = 0; body < loads.bodies; ++body)
    for (std::size_t load = 0; load < loads.loads_of_body; ++load)
      for (std::size_t of = 0; of < loads.bodies; ++of)
        for (std::size_t source = 0; source < loads.sources_of_body; ++source) {
          const auto here = loads.place(body, load, of, source);
          const auto &row = velocities[load], &column = velocities[source];
          const double unit =
              mu * std::pow(radius, 1 + row.length + column.length) / row.contracted;
          loads.loads[here] *= column.is_strain ? -unit : unit;
          loads.errors[here] *= unit;
          if (body == of && load == source && column.is_strain) {
            const double own = body == 0 ? radius : tabulation.geometry_parameters.at(0);
            loads.loads[here] += column.ambient * std::numbers::pi * mu * own * own * own;
          }
          const bool is_trace = loads.group == MotionGroup::kAlong && load == 2;
          if (is_trace && tabulation.container)
            loads.loads[here] = loads.errors[here] = std::numeric_limits<double>::quiet_NaN();
        }
}

}  // namespace

std::size_t PairLoads::place(std::size_t body, std::size_t load, std::size_t of_body,
                             std::size_t source) const {
  assert(body < bodies && load < loads_of_body && of_body < bodies && source < sources_of_body);
  return ((of_body * sources_of_body + source) * bodies + body) * loads_of_body + load;
}

PairLoads solve_pair_loads(const FreeFem& freefem, const Tabulation& tabulation, MotionGroup group,
                           double gap) {
  const auto start = std::chrono::steady_clock::now();
  const auto& geometry = find_geometry(tabulation.geometry);
  if (!has_motion(geometry, lubrication::MotionKind::kTwofoldStrain))
    throw Error(ErrorKind::kBadInput,
                "beside a {} there are no strains; they need a plane or a sphere",
                tabulation.geometry);
  PairLoads loads;
  loads.group = group;
  loads.bodies = neighbour_is_sphere(tabulation) ? 2 : 1;
  loads.loads_of_body = velocities_of(group).size();
  loads.sources_of_body = group == MotionGroup::kAlong ? 2 : loads.loads_of_body;
  loads.loads.resize(loads.bodies * loads.bodies * loads.loads_of_body * loads.sources_of_body);
  loads.errors.resize(loads.loads.size());
  loads.observed_orders.resize(loads.bodies * loads.sources_of_body);

  auto scaled = tabulation;
  scaled.viscosity = 1;
  auto arguments = row_arguments(scaled, gap, 1);
  arguments.insert(arguments.end(),
                   {"-motion", std::to_string(static_cast<int>(group)), "-strains", "1"});
  const auto result = run_freefem(freefem, geometry.script, arguments);
  std::istringstream answer(line_after(result.output, "viscontact-result"));
  double load = 0, order = 0;
  answer >> load >> loads.largest_relative_error >> loads.degrees_of_freedom >> order >>
      loads.traction_mismatch;
  if (result.exit_status != 0 || !answer || !read_entries(result.output, loads))
    throw Error(ErrorKind::kExternalProgram, "FreeFEM failed at gap {} (exit status {}): {}",
                format_number(gap), result.exit_status,
                failure_in_words(result, freefem.row_limit));
  loads.asymmetry = make_errors_symmetric(loads);
  // The condition also refuses NaN.
  if (!(loads.asymmetry <= kMostAsymmetry))
    throw Error(ErrorKind::kExternalProgram,
                "at gap {} the loads contradict the reciprocal theorem: two of them, which must be "
                "equal, differ by {:.2g} of their size, and rounding explains at most {}",
                format_number(gap), loads.asymmetry, kMostAsymmetry);
  convert(tabulation, loads);
  loads.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return loads;
}

namespace {

using lubrication::Action;
using lubrication::MotionKind;
using lubrication::MotionRow;

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

/// The loads of one source, or of several with weights.
struct Source {
  std::size_t of_body, source;
  double weight;
};

/// The action on a body; `own` is the factor of the sphere to which errors are relative. Force,
/// torque, stresslet and trace are NaN; complete() computes them from the factors.
Action action_on(const PairLoads& loads, std::size_t body, const std::vector<Source>& sources,
                 const lubrication::ActionUnits& units) {
  const auto sum = [&](std::size_t load, double unit, double& factor, double& error) {
    for (const auto& [of_body, source, weight] : sources) {
      const auto here = loads.place(body, load, of_body, source);
      factor += weight * loads.loads[here] / unit;
      error += std::abs(weight * loads.errors[here] / unit);
    }
  };
  Action on;
  on.force = on.torque = on.stresslet = on.trace = kUnknown;
  const auto force = [&](std::size_t load) {
    sum(load, -units.force, on.force_factor, on.relative_error_estimate);
  };
  const auto torque = [&](std::size_t load) {
    sum(load, -units.torque, on.torque_factor, on.torque_error_estimate);
  };
  const auto stresslet = [&](std::size_t load) {
    sum(load, units.stresslet, on.stresslet_factor, on.stresslet_error_estimate);
  };
  switch (loads.group) {
    case MotionGroup::kAlong:
      force(0);
      stresslet(1);
      sum(2, units.stresslet, on.trace_factor, on.trace_error_estimate);
      break;
    case MotionGroup::kAcross:
      force(0);
      torque(1);
      stresslet(2);
      break;
    case MotionGroup::kAround:
      torque(0);
      break;
    case MotionGroup::kTwofold:
      stresslet(0);
      break;
  }
  return on;
}

/// Divides the errors by the sphere's own factor.
void divide_errors(Action& on, double own) {
  for (double* error : {&on.relative_error_estimate, &on.torque_error_estimate,
                        &on.stresslet_error_estimate, &on.trace_error_estimate})
    *error /= std::abs(own);
}

}  // namespace

std::vector<MotionKind> motions_with_strains(MotionGroup group) {
  switch (group) {
    case MotionGroup::kAlong:
      return {MotionKind::kApproach, MotionKind::kAxialStrain};
    case MotionGroup::kAcross:
      return {MotionKind::kSlide, MotionKind::kRoll, MotionKind::kShearStrain};
    case MotionGroup::kAround:
      return {MotionKind::kSpin};
    case MotionGroup::kTwofold:
      return {MotionKind::kTwofoldStrain};
  }
  assert(false);
  return {};
}

std::vector<MotionRow> rows_of(const Tabulation& tabulation, const PairLoads& loads, double gap) {
  const auto motions = motions_with_strains(loads.group);
  assert(motions.size() == loads.sources_of_body);
  std::vector<MotionRow> rows;
  for (std::size_t source = 0; source < motions.size(); ++source) {
    const auto motion = motions[source];
    // PairLoads has the axial strain zz - 1/3, a table E_zz = 1.
    std::vector<Source> sources = {{0, source, motion == MotionKind::kAxialStrain ? 1.5 : 1.0}};
    if (const double ratio = neighbour_ratio(tabulation, motion); ratio != 0)
      sources.push_back({1, source, ratio});
    const auto units = lubrication::action_units(motion, tabulation.viscosity, tabulation.radius);
    auto& row = rows.emplace_back();
    static_cast<Action&>(row) = action_on(loads, 0, sources, units);
    const double own = is_strain(motion) ? row.stresslet_factor
                       : motion == MotionKind::kRoll || motion == MotionKind::kSpin
                           ? row.torque_factor
                           : row.force_factor;
    if (loads.bodies == 2) {
      row.neighbour = action_on(loads, 1, sources, units);
      divide_errors(*row.neighbour, own);
    }
    divide_errors(row, own);
    row.has_stresslets = true;
    row.has_traces = loads.group == MotionGroup::kAlong && !tabulation.container;
    if (!row.has_traces) {
      row.trace = row.trace_factor = row.trace_error_estimate = 0;
      if (auto& other = row.neighbour)
        other->trace = other->trace_factor = other->trace_error_estimate = 0;
    }
    row.gap = gap;
    row.reference_velocity = 1;
    row.largest_error_estimate = loads.largest_relative_error;
    row.degrees_of_freedom = loads.degrees_of_freedom;
    row.seconds = loads.seconds;
    row.observed_order = loads.observed_orders.at(source);
    lubrication::TableHead head;
    head.motion = motion;
    head.viscosity = tabulation.viscosity;
    head.radius = tabulation.radius;
    complete(head, row);
  }
  return rows;
}

}  // namespace viscontact::freefem_axi
