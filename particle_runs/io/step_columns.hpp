// The columns of steps.csv and probes.csv, and the members of StepReport in Python.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "viscontact/particle_runs/io/columns.hpp"
#include "viscontact/particles/setting/setting.hpp"
#include "viscontact/particles/steps/step_report.hpp"

namespace viscontact::particles {

struct StepRow {
  const StepReport& report;
  std::int64_t step = 0;  ///< number of the step, from 1
};

const std::vector<Column<StepRow>>& step_columns();

/// The line with the names of the columns of steps.csv. `further` are those that a case asks for
/// (ParticlesCase::step_columns).
std::string steps_header(const std::optional<Fluid>& fluid,
                         std::span<const std::string> further = {});
/// The row of steps.csv of the step with the number `step`, from 1.
std::string step_row(std::int64_t step, const StepReport& report, const std::optional<Fluid>& fluid,
                     std::span<const std::string> further = {});

/// The line with the names of the columns of probes.csv.
std::string probes_header();
/// The rows of probes.csv of a step, one for each probe.
std::string probe_rows(const FluidStepReport& report, std::span<const Probe> probes);

/// The tables of docs/file-formats.md with the columns of both files.
std::vector<ColumnTable> step_column_tables();

}  // namespace viscontact::particles
