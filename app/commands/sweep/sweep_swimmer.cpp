// `sweep` of a swimmer's case: its plan and its picture (sweep_options.hpp). The rows are computed by
// sweep/swimmer_sweep.hpp.
#include <fmt/format.h>

#include <algorithm>

#include "viscontact/app/commands/interrupt.hpp"
#include "viscontact/app/commands/sweep/sweep_options.hpp"
#include "viscontact/common/error.hpp"
#include "viscontact/pipeline/dry_run.hpp"
#include "viscontact/report/pictures/sweep_plot.hpp"
#include "viscontact/results/foreign_files.hpp"
#include "viscontact/results/picture_kind.hpp"
#include "viscontact/results/provenance.hpp"
#include "viscontact/sweep/swimmer_sweep.hpp"

namespace viscontact::app {
namespace {

/// What to draw: by default the displacements over the first key.
report::SweepPlot picture_of_strokes(const SweepOptions& o, const sweep::SwimmerSweep& sweep) {
  const auto columns = sweep.columns();
  report::SweepPlot picture{o.x.empty() ? columns.front() : o.x, o.y, o.columns};
  if (picture.columns.empty())
    for (const char* column : {"displacement", "optimal.displacement"})
      if (std::ranges::find(columns, column) != columns.end()) picture.columns.emplace_back(column);
  return picture;
}

}  // namespace

void sweep_swimmer(const SweepOptions& o) {
  if (o.array.is_slurm() || o.array.gather || !o.array.task.empty() || o.keep_runs || o.draws > 0 ||
      !o.models.empty() || !o.reference.empty())
    throw Error(
        ErrorKind::kWrongUsage,
        "--launcher slurm, --gather, --task, --keep-runs, --draws, --models and --reference "
        "are not for cases of a swimmer; leave them out");
  if (o.fit.empty())
    throw Error(ErrorKind::kWrongUsage,
                "the resistance matrices are not given; give with --fit the file fit.json that "
                "`viscontact swimmer CASE -o FOLDER` writes");
  results::refuse_other_kind(o.output, "# viscontact: sweep of a swimmer", "sweep of a swimmer");
  const sweep::SwimmerSweep sweep(
      {o.case_file, lubrication::read_resistance_fit(o.fit), variations_of(o), o.samples, o.seed});
  const auto rows = sweep.rows(VISCONTACT_VERSION);
  if (o.dry_run) {
    fmt::print("{}", pipeline::dry_run_text({pipeline::dry_run(rows, o.output, interrupt_token())},
                                            o.jobs, o.json));
    return;
  }
  const std::vector<std::filesystem::path> files = {o.case_file, o.fit};
  write_rows(o, rows, files, "stroke");
  if (o.plot.empty()) return;
  const auto kind = results::picture_kind(o.plot)->kind;
  results::write_output(
      o.plot, kind,
      report::plot_sweep(o.output, picture_of_strokes(o, sweep), kind, interrupt_token()),
      results::provenance_of(results::Inputs{files, {o.output}}));
}

}  // namespace viscontact::app
