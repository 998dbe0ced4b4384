// `sweep` of a case of many particles: its plan from the options, and what is to be done with it
// (sweep_options.hpp). The rows are computed by pipeline/sweep/.
#include <fmt/format.h>

#include <string>
#include <utility>
#include <vector>

#include "viscontact/app/commands/interrupt.hpp"
#include "viscontact/app/commands/sweep/sweep_options.hpp"
#include "viscontact/common/error.hpp"
#include "viscontact/pipeline/dry_run.hpp"
#include "viscontact/pipeline/sweep/particles_sweep_stage.hpp"
#include "viscontact/sweep/particles/means.hpp"

namespace viscontact::app {

void sweep_many_particles(const SweepOptions& o) {
  if (!o.models.empty() || !o.reference.empty() || !o.fit.empty() || !o.plot.empty() ||
      !o.x.empty() || !o.y.empty() || !o.columns.empty())
    throw Error(ErrorKind::kWrongUsage,
                "--models, --reference, --fit and the options of pictures are for cases of one "
                "sphere; leave them out");
  const auto means = sweep::path_of_means(o.output);
  results::refuse_other_kind(o.output, "# viscontact: sweep of particles", "sweep of particles");
  results::refuse_other_kind(means, "# viscontact: means of a sweep", "table of means");
  auto plan = sweep::planned_particles(o.case_file);
  if (!o.vary.empty()) plan.variations = variations_of(o);
  if (o.samples > 0) plan.samples = o.samples;
  if (o.draws > 0) plan.draws = o.draws;
  plan.seed = o.seed;
  if (plan.variations.empty() && plan.draws == 0)
    throw Error(ErrorKind::kWrongUsage,
                "there is nothing to vary; give --vary KEY=FROM:TO:COUNT or --draws N");
  const sweep::ParticlesSweep sweep(std::move(plan));
  const pipeline::ParticlesSweepRequest request{o.output, o.jobs, o.keep_runs, interrupt_token()};
  if (o.dry_run) {
    fmt::print("{}", pipeline::dry_run_text({pipeline::dry_run(sweep, o.output, interrupt_token())},
                                            o.jobs, o.json));
  } else if (o.array.is_slurm()) {
    // The tasks read the section [sweep] of the case, too, so only given options are passed on.
    std::vector<std::string> options;
    for (const auto& text : o.vary) options.insert(options.end(), {"--vary", text});
    if (o.samples > 0) options.insert(options.end(), {"--samples", std::to_string(o.samples)});
    if (o.draws > 0) options.insert(options.end(), {"--draws", std::to_string(o.draws)});
    options.insert(options.end(), {"--seed", std::to_string(o.seed)});
    if (o.keep_runs) options.emplace_back("--keep-runs");
    with_remedy(kRemedyOfSlurm, [&] {
      pipeline::submit_sweep(sweep, array_request(o.array, o.output, *o.jobs_option, o.jobs),
                             options);
    });
  } else if (o.array.gather) {
    with_remedy(kRemedyOfGather, [&] { pipeline::gather_sweep(sweep, request); });
  } else if (!o.array.task.empty()) {
    pipeline::share_of_sweep(sweep, request, share_of(o.array));
  } else {
    pipeline::sweep_particles(sweep, request);
  }
}

}  // namespace viscontact::app
