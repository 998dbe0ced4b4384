// Each row of the sweep computes the strokes of its case anew, with the same fit.
#include "viscontact/swimmer/case/swimmer_study.hpp"

#include <utility>

#include "viscontact/common/error.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/common/hash/sha256.hpp"
#include "viscontact/lubrication/scaling.hpp"
#include "viscontact/swimmer/case/swimmer_case.hpp"
#include "viscontact/swimmer/swim.hpp"
#include "viscontact/swimmer/tabulation/collinear_spheres.hpp"

namespace viscontact::swimmer {
namespace {

constexpr std::string_view kSwimmerResults[] = {"displacement", "energy",
                                                "energy_at_constant_power", "efficiency"};

/// Adds the sums of a stroke over a period to the columns with this prefix.
void add_sums(const std::string& prefix, const SwimSums& sums, sweep::RowResults& results) {
  results.values[prefix + "displacement"] = sums.displacement;
  results.values[prefix + "energy"] = sums.energy;
  results.values[prefix + "energy_at_constant_power"] = sums.energy_at_constant_power;
  results.values[prefix + "efficiency"] = sums.efficiency;
}

/// Throws Error(kWrongUsage) unless one fit serves all values of the key.
void check_swimmer_key(const std::string& key) {
  if (key.starts_with("stroke.") || key.starts_with("optimal.") || key == "fluid.viscosity") return;
  throw Error(ErrorKind::kWrongUsage,
              "{} cannot be varied with one fit, because it changes the table; keys of [stroke], "
              "[optimal] and fluid.viscosity can, and `viscontact swimmer` makes another table",
              key);
}

/// The results of a row. A stroke that fails leaves its columns empty.
sweep::RowResults swim_strokes(const SwimmerCase& c, ResistanceFit fit, const StopToken& stop) {
  sweep::RowResults results;
  const Swimmer swimmer(scaled_to(std::move(fit), c.spheres.viscosity, c.spheres.radii));
  if (c.stroke)
    sweep::add_part(results, [&] { add_sums("", swim_sums(swimmer, *c.stroke), results); });
  if (c.optimal)
    sweep::add_part(results, [&] {
      const auto found = find_optimal_stroke(swimmer, *c.optimal, stop);
      add_sums("optimal.", swim_sums(swimmer, stroke_of(found.loop, c.optimal_period)), results);
    });
  stop.throw_if_stop_requested();
  return results;
}

}  // namespace

sweep::Study swimmer_study(const std::filesystem::path& case_path, sweep::Points points,
                           const ResistanceFit& fit, const std::string& version) {
  const case_file::CaseTemplate<SwimmerCase> cases(case_path);
  sweep::check_keys(points, check_swimmer_key);
  SwimmerCase last;
  sweep::check_ends(points, [&](const auto& numbers) {
    last = cases.with(numbers);
    const auto scaled = in_file(case_path.string(), [&] {
      return scaled_to(fit, last.spheres.viscosity, last.spheres.radii);
    });
    const auto around = surroundings_in_words(last.spheres);
    if (last.spheres.radii != fit.radii && !scaled.container.empty() &&
        !lubrication::same_words(scaled.container, around))
      throw_bad_input({case_path.string()},
                      "the container of the fit is '{}', that of the case is '{}'; give the fit "
                      "that `viscontact swimmer` made from this case",
                      scaled.container, around);
  });
  if (!last.stroke && !last.optimal)
    throw Error(ErrorKind::kWrongUsage, "the case has neither [stroke] nor [optimal]");
  sweep::Study study;
  for (const auto result : kSwimmerResults)
    if (last.stroke) study.results.emplace_back(result);
  for (const auto result : kSwimmerResults)
    if (last.optimal) study.results.push_back("optimal." + std::string(result));
  std::string identity = sweep::text_of(points);
  // `identity` must hold all that determines the rows, so that rows of another sweep are not kept.
  const auto files = files_of(last);  // the first is the case, whose hash the head has
  for (std::size_t i = 1; i < files.size(); ++i) identity += read_file(files[i]);
  study.comments =
      sweep::head_of("sweep of a swimmer", cases.text(), points, identity, version, last.units);
  study.comments["fit"] = sha256(write_resistance_fit(fit));
  study.run = [cases, points, fit](std::uint64_t index, const StopToken& stop) {
    sweep::RowResults results;
    sweep::add_part(results,
                    [&] { results = swim_strokes(cases.with(points.numbers(index)), fit, stop); });
    return results;
  };
  study.points = std::move(points);
  return study;
}

}  // namespace viscontact::swimmer
