// The functions simulate, rolling and swimmer of Python (docs/python.md): motions of single
// spheres.

#include <cassert>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <variant>

#include "viscontact/case_file/case_file.hpp"
#include "viscontact/common/named.hpp"
#include "viscontact/freefem_axi/journal/row_record.hpp"
#include "viscontact/pipeline/simulate/simulate_stage.hpp"
#include "viscontact/python/call.hpp"
#include "viscontact/reduced_model/models/models.hpp"
#include "viscontact/reduced_model/trajectory.hpp"
#include "viscontact/rolling/case/rolling_case.hpp"
#include "viscontact/swimmer/fit/fit_resistance.hpp"
#include "viscontact/swimmer/job/swimmer_stage.hpp"
#include "viscontact/swimmer/swim.hpp"

namespace viscontact::python {
namespace {

namespace fs = std::filesystem;
using Numbers = std::map<std::string, double>;

/// The models of the case if there is no value.
using GivenModels = std::optional<std::vector<std::string>>;

/// The names that are given, or none. Throws Error(kWrongUsage) for an empty list.
std::vector<std::string> names_in(const GivenModels& models) {
  if (models && models->empty())
    throw Error(ErrorKind::kWrongUsage,
                "models is an empty list; it must name at least one model, or be None for those of "
                "the case");
  return models.value_or(std::vector<std::string>());
}

/// The case with the value at each key of `numbers`, such as "sphere.radius", replaced. Throws
/// Error(kBadInput) if the file, a key or a value is wrong.
template <class Case>
Case read_with(const fs::path& path, const Numbers& numbers) {
  const std::vector<std::pair<std::string, double>> changed(numbers.begin(), numbers.end());
  return case_file::CaseTemplate<Case>(path).with(changed);
}

/// An object or the path of a fit file.
using GivenFit = std::variant<const PythonFit*, fs::path>;
using GivenPairFit = std::variant<const motions::PairFit*, fs::path>;

/// The fit that is given or else that the case names, scaled to radius and viscosity of the case.
/// Throws Error(kWrongUsage) if there is neither.
lubrication::Fit fit_of(const case_file::Case& c, const std::optional<GivenFit>& given) {
  if (given) {
    if (const auto* object = std::get_if<const PythonFit*>(&*given))
      return case_file::fit_for(c, (*object)->fit(), "fit");
    const auto& path = std::get<fs::path>(*given);
    return case_file::fit_for(c, lubrication::read_fit(path), path);
  }
  if (c.fit && c.fit->file)
    return case_file::fit_for(c, lubrication::read_fit(*c.fit->file), *c.fit->file);
  if (c.fit && c.fit->exact) return lubrication::exact_plane_fit(c.viscosity, c.radius);
  throw Error(ErrorKind::kWrongUsage,
              "{}: the drag is not given: the section [fit] of the case has neither 'file' nor "
              "'exact'; give fit=, a Fit or the path of a fit file",
              c.path.string());
}

template <class Value>
py::object or_none(const std::optional<Value>& value) {
  return value ? py::cast(*value) : py::none();
}

py::object columns_of(const reduced_model::Trajectory& trajectory) {
  using Row = reduced_model::TrajectoryRow;
  const auto& rows = trajectory.rows;
  const auto optional = [&](reduced_model::OptionalDouble Row::*member) {
    return column(rows, [member](const Row& row) {
      const auto& value = row.*member;
      return value ? *value : std::numeric_limits<double>::quiet_NaN();
    });
  };
  py::dict columns;
  columns["time"] = column(rows, [](const Row& row) { return row.time; });
  columns["gap"] = column(rows, [](const Row& row) { return row.gap; });
  columns["velocity"] = column(rows, [](const Row& row) { return row.velocity; });
  columns["lubrication_force"] = optional(&Row::lubrication_force);
  columns["external_force"] = optional(&Row::external_force);
  columns["gamma"] = optional(&Row::gamma);
  columns["solid_force"] = optional(&Row::solid_force);
  py::dict about;
  about["model"] = trajectory.model;
  about["steps"] = trajectory.steps;
  about["seconds"] = trajectory.seconds;
  about["film_from_gamma"] = or_none(trajectory.film_from_gamma);
  about["contact_interval"] = or_none(trajectory.contact_interval);
  about["solid_contact_from"] =
      trajectory.solid_contact_from ? py::cast(trajectory.solid_contact_from->time) : py::none();
  py::list gap_times;
  for (const auto& of : trajectory.gap_times)
    gap_times.append(py::make_tuple(of.gap, or_none(of.time)));
  about["time_to_gap"] = gap_times;
  if (trajectory.budget)
    for (const auto& entry : reduced_model::kBudgetEntries)
      about[py::str(std::string(entry.name))] = (*trajectory.budget).*entry.value;
  py::list rebounds;
  for (const auto& rebound : trajectory.rebounds) {
    py::dict one;
    one["time"] = rebound.time;
    one["approach_velocity"] = rebound.approach_velocity;
    one["solid_impulse"] = rebound.solid_impulse;
    one["velocity"] = rebound.velocity;
    one["coefficient"] = rebound.coefficient;
    rebounds.append(one);
  }
  about["rebounds"] = rebounds;
  return as_columns(columns, about);
}

py::dict simulate(const fs::path& path, const std::optional<GivenFit>& given,
                  const GivenModels& models, const Numbers& numbers) {
  const auto names = names_in(models);
  const auto trajectories = long_call([&](const StopToken& stop) {
    const auto c = read_with<case_file::Case>(path, numbers);
    auto motion = case_file::required_motion(c);
    motion.stop = stop;
    const auto fit = fit_of(c, given);
    const auto outside = c.fit ? c.fit->outside : lubrication::OutsideInterval{};
    const lubrication::LubricationForce force(fit, outside);
    std::vector<reduced_model::Trajectory> computed;
    for (const auto& name : pipeline::models_to_run(c, names)) {
      auto& one = computed.emplace_back(
          reduced_model::simulate(reduced_model::find_model(name), motion, force));
      if (motion.output_rows > 0)
        one.rows = reduced_model::fewer_rows(one.rows, motion.output_rows);
    }
    return computed;
  });
  py::dict by_model;
  for (const auto& trajectory : trajectories)
    by_model[py::str(trajectory.model)] = columns_of(trajectory);
  return by_model;
}

py::object columns_of(const rolling::RollingTrajectory& rows, const rolling::RollingCase& c) {
  using Row = rolling::RollingRow;
  py::dict columns;
  const auto add = [&](const char* name, double Row::*member) {
    columns[name] = column(rows, [member](const Row& row) { return row.*member; });
  };
  add("time", &Row::time);
  add("gap", &Row::gap);
  add("position", &Row::position);
  add("angle", &Row::angle);
  add("normal_velocity", &Row::normal_velocity);
  add("velocity", &Row::velocity);
  add("angular_velocity", &Row::angular_velocity);
  add("contact_force", &Row::contact_force);
  add("friction_force", &Row::friction_force);
  columns["contact"] = column(rows, [](const Row& row) { return static_cast<int>(row.contact); });
  const auto end = rolling::end_of(rows, c.motion, c.radius);
  py::dict about;
  about["smallest_gap"] = end.smallest_gap;
  about["slip"] = end.slip;
  about["contact_time"] = or_none(end.contact_time);
  return as_columns(columns, about);
}

/// Does what fit_of() above does, for the resistances of sphere and plane.
motions::PairFit fit_of(const rolling::RollingCase& c, const std::optional<GivenPairFit>& given) {
  if (given)
    if (const auto* object = std::get_if<const motions::PairFit*>(&*given))
      return rolling::fit_for(c, **object, "fit");
  const auto path = given ? std::optional(std::get<fs::path>(*given)) : c.fit;
  if (!path)
    throw Error(ErrorKind::kWrongUsage,
                "{}: the case names no fit of a pair; give fit=, a PairFit or the path of its file",
                c.path.string());
  return rolling::fit_for(c, motions::read_pair_fit(*path), *path);
}

py::dict roll(const fs::path& path, const std::optional<GivenPairFit>& given,
              const GivenModels& models, const Numbers& numbers) {
  const auto names = names_in(models);
  std::vector<std::pair<std::string, rolling::RollingTrajectory>> trajectories;
  const auto c = long_call([&](const StopToken& stop) {
    auto read = read_with<rolling::RollingCase>(path, numbers);
    read.motion.stop = stop;
    const auto fit = fit_of(read, given);
    for (const auto& name : names.empty() ? read.models : names) {
      const auto& model = require_named(rolling::rolling_models(), name, "model");
      trajectories.emplace_back(name,
                                with_place(name, [&] { return model.run(read.motion, fit); }));
    }
    return read;
  });
  py::dict by_model;
  for (const auto& [model, rows] : trajectories) by_model[py::str(model)] = columns_of(rows, c);
  return by_model;
}

/// The motion of the swimmer in one stroke, a cycle of the lengths of its arms, with at least one
/// row.
struct SwumStroke {
  double period;  // [T], > 0
  swimmer::SwimSums sums;
  swimmer::SwimErrors errors;
  std::vector<swimmer::SwimRow> rows;
};

py::object columns_of(const SwumStroke& stroke) {
  using Row = swimmer::SwimRow;
  const auto& rows = stroke.rows;
  assert(!rows.empty());
  const auto vectors = [&](Eigen::VectorXd Row::*member) {
    const auto width = (rows.front().*member).size();
    py::array_t<double> array({static_cast<py::ssize_t>(rows.size()), width});
    double* to = array.mutable_data();
    for (const auto& row : rows)
      for (const double value : row.*member) *to++ = value;
    return array;
  };
  py::dict columns;
  columns["time"] = column(rows, [](const Row& row) { return row.time; });
  columns["arms"] = vectors(&Row::arms);
  columns["position"] = column(rows, [](const Row& row) { return row.position; });
  columns["forces"] = vectors(&Row::forces);
  columns["power"] = column(rows, [](const Row& row) { return row.power; });
  py::dict about;
  about["period"] = stroke.period;
  about["displacement"] = stroke.sums.displacement;
  about["displacement_error_estimate"] = stroke.errors.displacement;
  about["energy"] = stroke.sums.energy;
  about["energy_error_estimate"] = stroke.errors.energy;
  about["energy_at_constant_power"] = stroke.sums.energy_at_constant_power;
  about["efficiency"] = stroke.sums.efficiency;
  return as_columns(columns, about);
}

/// Throws Error(kBadInput) if the table in `given` was made from other spheres, arms or walls than
/// the case, and Error(kWrongUsage) if there are two tables or none.
swimmer::ResistanceTable table_of(const swimmer::SwimmerCase& c,
                                  const std::optional<fs::path>& given) {
  if (given.has_value() == c.table_file.has_value())
    throw Error(ErrorKind::kWrongUsage, "{} {} swimmer.table; give a table there or as an argument",
                c.path.string(), c.table_file ? "has" : "lacks");
  if (c.table_file) return c.table;
  const auto& path = *given;
  auto table = swimmer::read_resistance_table(path);
  const auto plan = swimmer::case_table(c, path).plan;
  if (!freefem_axi::missing_points(plan.read(path), plan.points).empty())
    throw_bad_input({path.string()},
                    "is not the table of {}, or lacks rows; viscontact.tabulate() makes it",
                    c.path.string());
  return table;
}

/// A stroke has about `intervals` rows.
py::dict swim(const fs::path& path, const std::optional<fs::path>& table_path, int intervals) {
  if (intervals < 1)
    throw Error(ErrorKind::kWrongUsage, "intervals is {}; it must be > 0", intervals);
  std::optional<SwumStroke> given, optimal;
  long_call([&](const StopToken& stop) {
    const auto c = swimmer::read_swimmer_case(path);
    const auto table = table_of(c, table_path);
    const auto place = (c.table_file ? *c.table_file : *table_path).string();
    const auto fit = with_place(place, [&] { return swimmer::fit_resistance(table); });
    const swimmer::Swimmer swimmer(fit);
    const auto perturbed = swimmer::perturbed_fits(table, fit);
    const auto result = [&](const swimmer::Stroke& stroke, double multiplier) {
      const auto sums = swimmer::swim_sums(swimmer, stroke);
      return SwumStroke{stroke.period, sums,
                        swimmer::swim_errors(sums, stroke, perturbed.lower_degrees,
                                             perturbed.table_errors, multiplier),
                        swimmer::swim_rows(swimmer, stroke, intervals)};
    };
    if (c.stroke)
      given = with_place(path.string() + ": [stroke]", [&] { return result(*c.stroke, 0); });
    if (c.optimal)
      optimal = with_place(path.string() + ": [optimal]", [&] {
        const auto search = swimmer::find_optimal_stroke(swimmer, *c.optimal, stop);
        // The search computes the stroke and its multiplier for the period 1.
        return result(swimmer::stroke_of(search.loop, c.optimal_period),
                      search.multiplier / c.optimal_period);
      });
  });
  py::dict strokes;
  if (given) strokes["stroke"] = columns_of(*given);
  if (optimal) strokes["optimal"] = columns_of(*optimal);
  return strokes;
}

}  // namespace

void add_spheres(py::module_& module) {
  module.def("simulate", &simulate,
             R"(The motion of one sphere by models of motion; see docs/physics.md.

case       case file of one sphere (TOML)
fit        Fit or path of a fit file, which is scaled to the case; None: that of the case. The force
           outside its interval is what the section [fit] of the case says
models     list of names; None: those of the case
values     numbers in place of those of the case, such as {"sphere.radius": 2.0}

Returns a dictionary with a table for each model, of R rows:

time, gap, velocity                 (R,) [T], [L], [L/T]
lubrication_force, external_force   (R,) [M L/T^2]
gamma, solid_force                  (R,) [M L/T], [M L/T^2]

NaN stands where a model has no such number. Its `about` has model, steps, seconds,
film_from_gamma, contact_interval, solid_contact_from, time_to_gap (pairs of a gap and its first
time), rebounds, and the impulses and works of the budget. No file is written.)",
             py::arg("case"), py::arg("fit") = py::none(), py::kw_only(),
             py::arg("models") = py::none(), py::arg("values") = Numbers());
  module.def("rolling", &roll,
             R"(The motion of a sphere that moves along a plane and turns; see docs/motions.md.

case       case file with the section [rolling] (TOML)
fit        PairFit or path of its file, which is scaled to the case; None: that of the case
models     "smooth", "rough", "viscous_contact"; None: those of the case
values     numbers in place of those of the case

Returns a dictionary with a table for each model, of R rows, with the columns of the files of
`viscontact rolling`: time [T], gap, position [L], angle [rad], normal_velocity, velocity [L/T],
angular_velocity [1/T], contact_force, friction_force [M L/T^2], and contact: 0 none, 1 the solids
roll, 2 they slide. Its `about` has smallest_gap [L], slip [L/T] at the end, and contact_time [T], the
first at which the solids touch. No file is written.)",
             py::arg("case"), py::arg("fit") = py::none(), py::kw_only(),
             py::arg("models") = py::none(), py::arg("values") = Numbers());
  module.def("swimmer", &swim,
             R"(The strokes of a swimmer: spheres on a line; see docs/swimmer.md.

case       case file with the section [swimmer] (TOML)
table      its table of resistance matrices (CSV), which tabulate() makes; None: that which the case
           names with swimmer.table
intervals  about as many rows has the table of a stroke

Returns a dictionary with "stroke" and "optimal", as far as the case has these sections: tables of R
rows, A arms and S spheres:

time, position, power   (R,) [T], [L], [M L^2/T^3]
arms                    (R, A) [L]
forces                  (R, S) of each sphere on the fluid [M L/T^2]

Its `about` has period [T], displacement [L], energy, energy_at_constant_power [M L^2/T^2],
efficiency, and displacement_error_estimate, energy_error_estimate. No file is written.)",
             py::arg("case"), py::arg("table") = py::none(), py::kw_only(),
             py::arg("intervals") = 400);  // as the command `swimmer`
}

}  // namespace viscontact::python
