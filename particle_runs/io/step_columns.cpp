// A new column of steps is a row of step_columns().
#include "viscontact/particle_runs/io/step_columns.hpp"

#include <algorithm>
#include <cassert>

namespace viscontact::particles {
namespace {

constexpr Condition kWithInertia{[](const RunFacts& run) { return run.has_inertia; },
                                 "in a fluid with a density"};

constexpr Condition kWithSolverStages{[](const RunFacts& run) { return run.has_solver_stages; },
                                      "with `step_columns`"};

constexpr Presence over_time_if(const Condition& condition) {
  return {.at_end = kNever, .over_time = condition, .frames = kNever};
}

template <auto kMember>
Column<StepRow> of_step(const Declaration& declaration) {
  return column<StepRow>(
      declaration, [](const StepRow& row) -> const auto& { return row.report.*kMember; });
}
/// A member of FluidStepReport. `condition` says when steps.csv has it.
template <auto kMember>
Column<StepRow> of_fluid(std::string_view name, std::string_view unit, std::string_view meaning,
                         const Condition& condition) {
  return column<StepRow>({name, unit, meaning, over_time_if(condition)},
                         [](const StepRow& row) { return row.report.fluid.*kMember; });
}

}  // namespace

const std::vector<Column<StepRow>>& step_columns() {
  using OfFluid = FluidStepReport;
  static const std::vector<Column<StepRow>> columns = {
      column<StepRow>({"step", "", "number of the step, from 1", only_over_time()},
                      [](const StepRow& row) { return row.step; }),
      of_step<&StepReport::time>({"time", "T", "at the end of the step"}),
      of_step<&StepReport::contacts>({"contacts", "", "number of close pairs"}),
      of_step<&StepReport::glued>({"glued", "", "number of contacts with gamma < 0"}),
      of_step<&StepReport::iterations>(
          {"iterations", "",
           "of the projection, with friction, bodies or links those of the set of connected "
           "particles that needs most"}),
      of_step<&StepReport::residual>(
          {"residual", "1", "the largest one of gaps, friction and links, over the mean radius"}),
      of_step<&StepReport::largest_overlap>({"largest_overlap", "1", "over the mean radius"}),
      of_step<&StepReport::converged>(
          {"converged", "", "whether all residuals are within the tolerances of the case"}),
      of_step<&StepReport::impulse_residual>(
          {"impulse_residual", "1",
           "the largest [error of an impulse](particles.md#the-projection) over the impulse at "
           "work; errors within the effect of rounding errors do not count"}),
      of_step<&StepReport::parts>({"parts", "", "number of parts that the step was divided into"}),
      of_step<&StepReport::unresolved>(
          {"unresolved", "",
           "number of [contacts that turn too far](particles.md#from-theory-to-code) even in the "
           "smallest part"}),
      of_fluid<&OfFluid::dissipation>("dissipation", "M L²/T³, of discs M L/T³", "of the flow",
                                      kInFluid),
      of_fluid<&OfFluid::apparent_viscosity>(
          "apparent_viscosity", "1",
          "0 if the walls are at rest, or if the dissipation of the fluid alone is not known",
          kInFluid),
      column<StepRow>(
          {"fluid_seconds", "s", "wall time of the step: mesh, fluid solver and contacts",
           over_time_if(kInFluid)},
          [](const StepRow& row) { return Rounded{row.report.fluid.seconds}; }),
      of_fluid<&OfFluid::kinetic_energy>("kinetic_energy_fluid", "M L²/T², of discs M L/T²", "",
                                         kWithInertia),
      of_fluid<&OfFluid::reynolds_number>(
          "reynolds_number", "1", "the largest rho_f \\|V\\| 2 r/mu of a particle", kWithInertia),
      of_fluid<&OfFluid::courant_number>(
          "courant_number", "1",
          "the largest distance that the fluid moves relative to the mesh in the step, over the "
          "length of an edge",
          kWithInertia),
      column<StepRow>(
          {"given_force_x", "M L/T², of discs M/T²",
           "sum of the forces of the fluid on the particles whose motion is given, such as the "
           "drag of an obstacle; on an axis along z",
           over_time_if(kWithInertia)},
          [](const StepRow& row) { return row.report.fluid.given_force[0]; }),
      column<StepRow>({"given_force_y", "M L/T², of discs M/T²", "the same along y, such as a lift",
                       over_time_if(kWithInertia)},
                      [](const StepRow& row) { return row.report.fluid.given_force[1]; }),
      of_step<&StepReport::solver_stages>(
          {"solver_stages", "",
           "the [stages of the contact solver](#stages-of-the-contact-solver) that ran; empty if "
           "there was nothing to solve",
           over_time_if(kWithSolverStages)}),
  };
  return columns;
}

namespace {

CsvTable<StepRow> steps_table(const std::optional<Fluid>& fluid,
                              std::span<const std::string> further) {
  RunFacts run;
  run.is_in_fluid = fluid.has_value();
  run.has_inertia = fluid && fluid->has_inertia();
  run.has_solver_stages = std::ranges::find(further, "solver_stages") != further.end();
  return {columns_in(Output::kOverTime, step_columns(), run), run.dimension};
}

struct ProbeRow {
  double time;
  std::string_view name;
  double flow, pressure;
};

const std::vector<Column<ProbeRow>>& probe_columns() {
  static const std::vector<Column<ProbeRow>> columns = {
      column<&ProbeRow::time>({"time", "T", "the beginning of the step, whose flow the row has"}),
      column<&ProbeRow::name>({"name", "", "of the probe"}),
      column<&ProbeRow::flow>({"flow", "L²/T",
                               "through the line of the probe per unit length, > 0 to the right of "
                               "the way from `from` to `to`"}),
      column<&ProbeRow::pressure>({"pressure", "M/(L T²)", "mean on the line"}),
  };
  return columns;
}

}  // namespace

std::string steps_header(const std::optional<Fluid>& fluid, std::span<const std::string> further) {
  return steps_table(fluid, further).header();
}

std::string step_row(std::int64_t step, const StepReport& report, const std::optional<Fluid>& fluid,
                     std::span<const std::string> further) {
  std::string text;
  steps_table(fluid, further).add(text, {report, step});
  return text;
}

std::string probes_header() { return table_over_time(probe_columns(), 2).header(); }

std::string probe_rows(const FluidStepReport& report, std::span<const Probe> probes) {
  assert(report.probes.size() >= probes.size());
  const auto table = table_over_time(probe_columns(), 2);
  std::string text;
  for (std::size_t k = 0; k < probes.size(); ++k)
    table.add(text, {report.flow_time, probes[k].name, report.probes[k][0], report.probes[k][1]});
  return text;
}

std::vector<ColumnTable> step_column_tables() {
  return {column_table("`steps.csv`", step_columns()),
          column_table("`probes.csv`", probe_columns())};
}

}  // namespace viscontact::particles
