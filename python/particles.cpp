// The class Particles of Python, from which python/viscontact/particles.py derives that of users.
// Its arrays are views of the state, so no step may move an array of the state in memory.
#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <optional>

#include "viscontact/freefem_flow/freefem_solver.hpp"
#include "viscontact/particle_runs/case/particles_case.hpp"
#include "viscontact/particle_runs/io/contact_columns.hpp"
#include "viscontact/particle_runs/io/particle_columns.hpp"
#include "viscontact/particle_runs/io/rheology_file.hpp"
#include "viscontact/particle_runs/io/step_columns.hpp"
#include "viscontact/particle_runs/run/particles_earlier_run.hpp"
#include "viscontact/particle_runs/run/start_simulation.hpp"
#include "viscontact/particles/steps/current_contacts.hpp"
#include "viscontact/python/call.hpp"
#include "viscontact/suspensions/suspension_simulation.hpp"

namespace viscontact::python {
namespace {

namespace fs = std::filesystem;
using particles::State;

class PythonParticles {
 public:
  PythonParticles(const fs::path& path, int threads, const std::optional<fs::path>& restart)
      : case_(particles::read_particles_case(path)),
        simulation_(particles::start_simulation(
            case_.setting, particles::first_state(case_, restart ? restart->string() : ""), threads,
            freefem_flow::start_fluid_solver, interrupt_token())) {
    // The velocities of spheres with lubrication follow from the places, also before the first step.
    if (case_.setting.lubrication && simulation_->state().steps == 0)
      particles::suspension_of(*simulation_)->solve_instant();
  }

  const particles::ParticlesCase& case_file() const { return case_; }
  /// The caller must have called check_idle(), or be a step that compute() runs.
  particles::ParticleSimulation& simulation() { return *simulation_; }

  /// Throws Error(kWrongUsage) while another thread computes steps. All functions that read or
  /// change the simulation call check_idle(). Only a thread that holds the interpreter's lock may
  /// call it, so that compute() and compute_step() do so before they release the lock.
  void check_idle() const {
    if (is_computing_)
      throw Error(ErrorKind::kWrongUsage,
                  "another thread computes steps of these particles; wait for it");
  }

  /// Calls `step` while other threads of Python may run. Meanwhile check_idle() refuses their calls
  /// for this object, but they can read the views that they already have. Without a fluid, Ctrl-C
  /// cannot stop a step, so Python's own handler stays in place and acts after the step. To replace
  /// the handler would take 5 us, which is 2 % of a short step of 1000 discs.
  template <class Step>
  particles::StepReport compute_step(const Step& step) {
    if (case_.setting.fluid) return compute([&](const StopToken&) { return step(); });
    check_idle();
    const Computing computing(is_computing_);
    const py::gil_scoped_release released;
    return step();
  }

  /// Calls `compute` as long_call() does. Meanwhile check_idle() refuses other calls.
  template <class Compute>
  auto compute(const Compute& compute) {
    check_idle();
    const Computing computing(is_computing_);
    return long_call(compute);
  }

  const State& state() const {
    check_idle();
    return simulation_->state();
  }
  bool is_finished() const {
    return state().time >= case_.end_time - 1e-6 * case_.setting.time_step;
  }

 private:
  /// The flag is true while an object of this class exists.
  class Computing {
   public:
    explicit Computing(bool& flag) : flag_(flag) { flag_ = true; }
    ~Computing() { flag_ = false; }
    Computing(const Computing&) = delete;
    Computing& operator=(const Computing&) = delete;

   private:
    bool& flag_;
  };

  particles::ParticlesCase case_;
  std::unique_ptr<particles::ParticleSimulation> simulation_;
  bool is_computing_ = false;  // the interpreter's lock protects it
};

std::unique_ptr<PythonParticles> open_case(const fs::path& path, int threads,
                                           const std::optional<fs::path>& restart) {
  if (threads < 1) throw Error(ErrorKind::kWrongUsage, "threads is {}; it must be > 0", threads);
  return long_call(
      [&](const StopToken&) { return std::make_unique<PythonParticles>(path, threads, restart); });
}

/// A NumPy array that views the `size` numbers from `numbers` on, which belong to the simulation in
/// `owner`, and keeps `owner` alive. The numbers are `rows` rows of equal length. The array has the
/// shape (rows, length), or (rows,) if the length is 1 and `is_flat` is true.
template <class Number>
py::array view(const py::object& owner, const Number* numbers, std::size_t size, std::size_t rows,
               bool is_flat, bool is_writeable) {
  assert(rows == 0 || size % rows == 0);
  const auto columns = rows == 0 ? 0 : size / rows;
  std::vector<py::ssize_t> shape = {static_cast<py::ssize_t>(columns == 0 ? 0 : rows)};
  if (!is_flat || columns > 1) shape.push_back(static_cast<py::ssize_t>(columns));
  py::array_t<Number> array(shape, numbers, owner);
  if (!is_writeable) array.attr("flags").attr("writeable") = false;
  return array;
}

/// A property of the class in Python that views an array of the particles and cannot be written.
template <class Member>
auto view_of(Member particles::Particles::*member, bool is_flat = false) {
  return [member, is_flat](const py::object& self) {
    const auto& p = self.cast<const PythonParticles&>().state().particles;
    const auto& numbers = p.*member;
    return view(self, numbers.data(), numbers.size(), p.count(), is_flat, false);
  };
}

/// Times closer than this [T] count as equal.
double tiny_time(const PythonParticles& self) { return 1e-6 * self.case_file().setting.time_step; }

/// `until` [T], or end_time of the case. Throws Error(kWrongUsage) if `until` is NaN or before the
/// present time.
double end_of_steps(const PythonParticles& self, const std::optional<double>& until) {
  if (!until) return self.case_file().end_time;
  const double now = self.state().time;
  if (!(*until >= now - tiny_time(self)))
    throw Error(ErrorKind::kWrongUsage,
                "until is {}; it must be at least {}, which is the present time", *until, now);
  return *until;
}

/// Computes one step, which ends at `until` [T] or at end_time of the case if it would end later.
/// Throws Error(kWrongUsage) if there is no step left before end_time, after which the forces and
/// given motions of the case are not defined.
particles::StepReport step(PythonParticles& self, const std::optional<double>& until) {
  const double end = end_of_steps(self, until), last = self.case_file().end_time;
  if (self.is_finished() && (!until || end > self.state().time + tiny_time(self)))
    throw Error(ErrorKind::kWrongUsage,
                "the particles have reached end_time of the case, {}; there is no step after it, "
                "because the forces of the case end there. A larger viscous_contact.end_time lets "
                "them go on",
                last);
  return self.compute_step([&] { return self.simulation().step(std::min(end, last)); });
}

/// Returns the number of steps. The steps before an error are kept.
std::int64_t run(PythonParticles& self, const std::optional<double>& until) {
  const double end = end_of_steps(self, until), last = self.case_file().end_time;
  const double tiny = tiny_time(self);
  if (!(end <= last + tiny))
    throw Error(ErrorKind::kWrongUsage,
                "until is {}; it must be at most {}, which is end_time of the case: the forces of "
                "the case end there",
                end, last);
  return self.compute([&](const StopToken& stop) {
    auto& simulation = self.simulation();
    const auto before = simulation.state().steps;
    while (simulation.state().time < end - tiny) {
      stop.throw_if_stop_requested();
      (void)simulation.step(end);
    }
    return simulation.state().steps - before;
  });
}

/// A new array of the values of a column: (rows,), or (rows, components) of a vector, also on an
/// axis.
template <class Number, class Row>
py::array array_of(const particles::Column<Row>& column, const std::vector<Row>& rows,
                   int dimension) {
  const auto values = particles::values_of<Number>(column, rows, dimension, false);
  std::vector<py::ssize_t> shape = {static_cast<py::ssize_t>(rows.size())};
  if (column.is_vector(dimension))
    shape.push_back(static_cast<py::ssize_t>(column.count(dimension)));
  py::array_t<Number> array(shape);
  std::ranges::copy(values, array.mutable_data());
  return array;
}

/// The object of the class Columns with these columns.
template <class AnyColumn, class Row>
py::object table_of(const std::vector<const AnyColumn*>& columns, const std::vector<Row>& rows,
                    int dimension) {
  py::dict table;
  for (const AnyColumn* column : columns)
    table[py::str(std::string(column->name))] =
        column->is_whole() ? array_of<std::int32_t, Row>(*column, rows, dimension)
                           : array_of<double, Row>(*column, rows, dimension);
  return as_columns(table);
}

py::object contacts(const PythonParticles& self) {
  const auto& p = self.state().particles;
  const auto all = particles::contacts_of(self.case_file().setting, self.state());
  std::vector<particles::ContactRow> rows;
  for (const auto& contact : all) rows.push_back({p, contact, self.state().time});
  particles::RunFacts run;
  run.dimension = p.dimension;
  return table_of(
      particles::columns_in(particles::Output::kPython, particles::contact_columns(), run), rows,
      p.dimension);
}

py::object final_particles(PythonParticles& self) {
  self.check_idle();
  auto& simulation = self.simulation();
  const auto p = simulation.reported_particles();
  auto run = particles::facts_of(p);
  auto* const flow = particles::flow_of(simulation);
  run.is_in_fluid = flow != nullptr;
  particles::FluidForces forces;
  std::vector<double> values, errors;
  if (flow != nullptr) {
    values = flow->fluid_forces();
    errors = flow->force_errors().of_fluid;
    forces = {values, errors};
  }
  const auto& loads = simulation.state().given_loads;
  run.has_given_loads = flow == nullptr && !loads.empty();
  return table_of(
      particles::columns_in(particles::Output::kPython, particles::particle_columns(), run),
      particles::rows_of(p, simulation.state().time, flow != nullptr ? &forces : nullptr, loads),
      p.dimension);
}

/// What a column contains, for help().
std::string help_of(const particles::ColumnForm& column) {
  std::string text(column.meaning);
  if (!column.unit.empty()) text += fmt::format("{}[{}]", text.empty() ? "" : " ", column.unit);
  return text;
}

/// The entries that a table may have, in a line each.
template <class AnyColumn>
std::string help_of(const std::vector<AnyColumn>& columns) {
  std::string text;
  for (const auto& column : columns)
    if (column.presence.python.words != particles::kNever.words)
      text += fmt::format("{:<18} {}\n", column.name, help_of(column));
  return text;
}

/// The value of a column without components in a row.
template <class Row>
py::object value_of(const particles::Column<Row>& column, const Row& row) {
  if (column.text != nullptr) return py::str(std::string(column.text(row)));
  particles::Entries entries{};
  if (!column.read(row, entries)) entries[0] = std::numeric_limits<double>::quiet_NaN();
  if (column.kind == particles::ValueKind::kTruth) return py::bool_(entries[0] != 0);
  if (column.is_whole()) return py::int_(static_cast<std::int64_t>(entries[0]));
  return py::float_(entries[0]);
}

void add_step_report(py::module_& module) {
  using particles::StepReport;
  py::class_<StepReport> reports(module, "StepReport", "What a step did; see Particles.step.");
  for (const auto* column : particles::columns_in(particles::Output::kPython,
                                                  particles::step_columns(), particles::kAllFacts))
    reports.def_property_readonly(
        std::string(column->name).c_str(),
        [column](const StepReport& report) {
          return value_of(*column, particles::StepRow{report});
        },
        help_of(*column).c_str());
  reports.def("__repr__", [](const StepReport& report) {
    return fmt::format("<viscontact.StepReport time {}, {} contacts, {} iterations, {}>",
                       report.time, report.contacts, report.iterations,
                       report.converged ? "converged" : "not converged");
  });
}

void add_rheology(py::module_& module) {
  using particles::Rheology;
  py::class_<Rheology> rheology(module, "Rheology",
                                "The stress of a suspension; see Particles.rheology.");
  for (const auto& column : particles::rheology_columns())
    rheology.def_property_readonly(
        std::string(column.name).c_str(),
        [&column](const Rheology& row) { return value_of(column, row); }, help_of(column).c_str());
  rheology.def("__repr__", [](const Rheology& row) {
    if (row.shear_rate == 0)
      return fmt::format("<viscontact.Rheology strain {}, at rest>", row.strain);
    if (!std::isfinite(row.viscosity))
      return fmt::format("<viscontact.Rheology strain {}, without a box>", row.strain);
    return fmt::format("<viscontact.Rheology strain {}, viscosity {}, n1 {}, n2 {}>", row.strain,
                       row.viscosity, row.n1, row.n2);
  });
}

/// Throws Error(kWrongUsage) if the case has no lubrication.
particles::SuspensionSimulation& suspension(PythonParticles& self) {
  auto* found = particles::suspension_of(self.simulation());
  if (found == nullptr)
    throw Error(ErrorKind::kWrongUsage, "the case has no [lubrication], to which this belongs");
  return *found;
}

}  // namespace

void add_particles(py::module_& module) {
  using particles::Particles;
  add_step_report(module);
  add_rheology(module);
  py::class_<PythonParticles>(module, "Particles", R"(Many discs or spheres with viscous contact.

Particles(case, particles=None, threads=1, restart=None)

case       case file of many particles (TOML), or a dictionary with its sections, which names files
           relative to the working folder and needs no title
particles  arrays in place of the section [particles] of the case, as a dictionary, a structured
           array or a pandas.DataFrame: "x", "y", "z" [L], "radius" [L], "mass" [M], and if they are given "vx",
           "vy", "vz" [L/T] and "id" (N,), which are the columns of a file of particles; row k is
           in line k + 2 of messages. With a file as case this needs Python 3.11
threads    number of threads; the results do not depend on it
restart    restart.bin of an earlier run, whose state is the start; None: that of the case

N is the number of particles and D the number of dimensions: 2 for discs, 3 for spheres, 1 for
spheres on an axis. Arrays are views: they show the present state after each step, cannot be written
(but forces and torques), and keep the object alive. While a thread computes steps, calls from
other threads raise InputError, and the views that they already have show an unfinished step. For
discs in a fluid M is a mass per length of the third dimension. No file is written.)")
      .def(py::init(&open_case), py::arg("case"), py::kw_only(), py::arg("threads") = 1,
           py::arg("restart") = py::none())
      .def("step", &step, R"(Computes one step and returns its StepReport.

until      the step ends at this time [T] if it would end later; if the time is reached, no step is
           made. None: a whole step of the case. A step ends at end_time at the latest.

Raises InputError at end_time, after which there is no step, and NotConvergedError if the step cannot
be computed; the state is then that before the step.)",
           py::arg("until") = py::none())
      .def("run", &run, R"(Computes steps until a time and returns their number.

until      the time [T], at most end_time of the case; None: end_time)",
           py::arg("until") = py::none())
      .def(
          "solve_instant",
          [](PythonParticles& self) {
            auto& simulation = suspension(self);
            return self.compute([&](const StopToken&) { return simulation.solve_instant(); });
          },
          R"(Computes the velocities of spheres with lubrication and returns their Rheology.

Nothing moves. Forces and torques of the caller act. Raises InputError if the case has no section
[lubrication].)")
      .def_property_readonly(
          "rheology",
          [](PythonParticles& self) {
            self.check_idle();
            return suspension(self).rheology();
          },
          "The Rheology of the last step, or of the start or solve_instant() before it.")
      .def_property_readonly(
          "forces",
          [](const py::object& self) {
            auto& particles = self.cast<PythonParticles&>();
            const auto count = particles.state().particles.count();
            const auto forces = particles.simulation().added_forces();
            return view(self, forces.data(), forces.size(), count, false, true);
          },
          "Forces of the caller (N, D) [M L/T^2], 0 at first, in addition to those of the case.\n\n"
          "They act in each of the next steps with the values that they have when it begins.")
      .def_property_readonly(
          "torques",
          [](const py::object& self) {
            auto& particles = self.cast<PythonParticles&>();
            const auto& p = particles.state().particles;
            const auto torques = particles.simulation().added_torques();
            return view(self, torques.data(), torques.size(), p.count(), p.dimension != 3, true);
          },
          "Torques of the caller [M L^2/T^2]: (N,) of discs, (N, 3) of spheres, likewise; empty "
          "if\n"
          "the particles do not turn.")
      .def_property_readonly("positions", view_of(&Particles::positions),
                             "of the centres (N, D) [L]")
      .def_property_readonly("velocities", view_of(&Particles::velocities),
                             "(N, D) [L/T]; with scheme = \"leapfrog\" half a step before the time")
      .def_property_readonly("angles", view_of(&Particles::angles, true),
                             "of discs, counter-clockwise (N,) [rad]; empty if they do not turn")
      .def_property_readonly("orientations", view_of(&Particles::orientations),
                             "of spheres: unit quaternions w, x, y, z (N, 4); empty for discs")
      .def_property_readonly("angular_velocities", view_of(&Particles::angular_velocities, true),
                             "(N,) of discs, (N, 3) of spheres [1/T]; empty if they do not turn")
      .def_property_readonly("radii", view_of(&Particles::radii, true), "(N,) [L]")
      .def_property_readonly("masses", view_of(&Particles::masses, true), "(N,) [M]")
      .def_property_readonly(
          "ids",
          [](const PythonParticles& self) {
            const auto& p = self.state().particles;
            std::vector<std::int32_t> ids(p.count());
            for (std::size_t k = 0; k < ids.size(); ++k) ids[k] = p.id(k);
            return column(ids, [](std::int32_t id) { return id; });
          },
          "Names of the particles in files (N,), a copy.")
      .def(
          "reported_velocities",
          [](PythonParticles& self) {
            self.check_idle();
            const auto p = self.simulation().reported_particles();
            Doubles array(
                {static_cast<py::ssize_t>(p.count()), static_cast<py::ssize_t>(p.dimension)});
            std::ranges::copy(p.velocities, array.mutable_data());
            return array;
          },
          "The velocities at the present time (N, D) [L/T], as in final_particles.csv: a copy.")
      .def("particles", &final_particles,
           ("The particles, a copy of an array for each column of final_particles.csv, whose "
            "vectors\nhave the shape (N, D). Those of a fluid, of given motions and of bodies are "
            "there only with\nthem; NaN stands for what is not known:\n\n" +
            help_of(particles::particle_columns()))
               .c_str())
      .def("contacts", &contacts,
           ("The present contacts, an array for each column, whose vectors have the shape (C, D) "
            "for C contacts:\n\n" +
            help_of(particles::contact_columns()) + "\nForces are means of the last step.")
               .c_str())
      .def_property_readonly(
          "time", [](const PythonParticles& self) { return self.state().time; }, "[T]")
      .def_property_readonly(
          "steps", [](const PythonParticles& self) { return self.state().steps; },
          "number of steps that were made")
      .def_property_readonly(
          "time_step",
          [](const PythonParticles& self) { return self.case_file().setting.time_step; }, "[T]")
      .def_property_readonly(
          "end_time", [](const PythonParticles& self) { return self.case_file().end_time; },
          "of the case [T]")
      .def_property_readonly("finished", &PythonParticles::is_finished,
                             "whether the time is end_time")
      .def("__len__", [](const PythonParticles& self) { return self.state().particles.count(); })
      .def("__repr__", [](const PythonParticles& self) {
        return fmt::format("<viscontact.Particles {} particles, {} dimensions, time {} of {}>",
                           self.state().particles.count(), self.state().particles.dimension,
                           self.state().time, self.case_file().end_time);
      });
}

}  // namespace viscontact::python
