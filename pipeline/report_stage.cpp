// Finds out by the results in a folder which command wrote them (report_stage.hpp).
#include "viscontact/pipeline/report_stage.hpp"

#include "viscontact/pipeline/particles/particles_pages.hpp"
#include "viscontact/pipeline/rolling/rolling_stage.hpp"
#include "viscontact/pipeline/swimmer/swimmer_stage.hpp"
#include "viscontact/report/report.hpp"

namespace viscontact::pipeline {

void report_stage(const std::filesystem::path& folder, const StopToken& stop) {
  const auto has = [&](const char* name) {
    return std::filesystem::is_regular_file(folder / name);
  };
  if (has("rolling.json"))
    report_rolling(folder, stop);
  else if (has("swimmer.json"))
    report_swimmer(folder, stop);
  else if (has("particles.pvd"))
    report_particles(folder);
  else
    report::write_report(folder, {}, stop);
}

}  // namespace viscontact::pipeline
