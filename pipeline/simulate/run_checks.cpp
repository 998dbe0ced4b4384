// The number of gaps, the parameters of the models, and the gaps that the motion reaches.
#include "viscontact/pipeline/simulate/run_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <set>

#include "viscontact/common/error.hpp"
#include "viscontact/reduced_model/models/models.hpp"
#include "viscontact/terminal/progress.hpp"

namespace viscontact::pipeline {
namespace {

/// The exact drag of a plane, below the wall opposite if the case tabulates a container.
lubrication::LubricationForce exact_drag(const case_file::Case& c) {
  const auto exact = lubrication::LubricationForce::exact_plane(c.viscosity, c.radius);
  if (!c.tabulation) return exact;
  const auto wall =
      lubrication::second_wall(freefem_axi::geometry_in_words(*c.tabulation),
                               freefem_axi::container_in_words(*c.tabulation), c.radius);
  return wall ? exact.below_wall(wall->largest_gap) : exact;
}

}  // namespace

void check_parameters(const case_file::Case& c, const std::vector<std::string>& models) {
  const auto exact = exact_drag(c);
  in_file(c.path.string(), [&] {
    for (const auto& name : models)
      reduced_model::check_model(reduced_model::find_model(name), case_file::required_motion(c),
                                 exact);
  });
}

void check_run(const case_file::Case& c, const std::vector<std::string>& models) {
  const auto& gaps = case_file::required_tabulation(c).gaps;
  const auto& request = case_file::required_fit(c);
  const auto& motion = case_file::required_motion(c);
  const auto exact = exact_drag(c);
  assert(!gaps.empty());
  const std::size_t different = std::set(gaps.begin(), gaps.end()).size();
  const std::size_t terms =
      request.settings.basis.terms.size() - (request.settings.fix_leading ? 1 : 0);
  if (different < terms)
    throw_bad_input({c.path.string(), 0, "tabulation.gaps"},
                    "tabulation.gaps has {} gap(s); the basis {} needs at least {}", different,
                    request.settings.basis.name, terms);
  const auto [smallest, largest] = std::ranges::minmax(gaps);
  const auto refuse = [&](const std::string& model, const char* what, double bound,
                          const char* remedy) {
    throw_bad_input({c.path.string(), 0, "motion.initial_gap"},
                    "motion.initial_gap is {}, which is {} gap of tabulation.gaps, {}; the model "
                    "{} needs the drag there: tabulate further, or write {} into the section [fit]",
                    motion.initial_gap, what, bound, model, remedy);
  };
  for (const auto& name : models) {
    const auto choice = reduced_model::find_model(name);
    const bool makes_contact = choice.model->contact != nullptr;
    if (!choice.exact_drag && !makes_contact && motion.initial_gap < smallest &&
        request.outside.below == lubrication::BelowInterval::kError)
      refuse(name, "below the smallest", smallest, "below = \"lubrication_limit\"");
    check_parameters(c, {name});
    // A contact model needs the drag here only if it resolves the drag between contacts.
    if (!choice.exact_drag && motion.initial_gap > largest &&
        request.outside.above == lubrication::AboveInterval::kError &&
        (!makes_contact || reduced_model::contact_model_of(choice, motion, exact).drag))
      refuse(name, "above the largest", largest, "above = \"stokes_limit\"");
  }
}

void warn_of_gaps_outside(const case_file::Case& c, const std::vector<std::string>& models,
                          const StopToken& stop) {
  constexpr double kMostSteps = 1e6;  // so many steps take about a second per model
  const auto& tabulation = case_file::required_tabulation(c);
  const auto& request = case_file::required_fit(c);
  reduced_model::Motion motion = case_file::required_motion(c);
  motion.stop = stop;
  if (!freefem_axi::find_geometry(tabulation.geometry).has_exact_drag) return;
  for (const auto& parameter : reduced_model::model_parameters())
    if (parameter.is_time_step && motion.end_time > kMostSteps * motion.parameter(parameter))
      return;
  assert(!tabulation.gaps.empty());
  const auto [smallest, largest] = std::ranges::minmax(tabulation.gaps);
  const auto exact = exact_drag(c);
  std::string below, above;
  double lowest = smallest, highest = largest;
  const auto add = [](std::string& names, const std::string& name) {
    names += fmt::format("{}{}", names.empty() ? "" : ", ", name);
  };
  for (const auto& name : models) {
    const auto choice = reduced_model::find_model(name);
    if (choice.exact_drag) continue;
    const auto reached = reduced_model::reached_gaps(choice, motion, exact);
    if (!reached) continue;
    if (reached->smallest && *reached->smallest < smallest) add(below, name);
    if (reached->largest > largest) add(above, name);
    lowest = std::min(lowest, reached->smallest.value_or(smallest));
    highest = std::max(highest, reached->largest);
  }
  constexpr std::string_view kWarning =
      "simulate: warning: the motion will leave tabulation.gaps, and these models will fail: {}. "
      "With the exact drag of a plane the gap {} to {:.3g}, the {} of tabulation.gaps is {:.3g}. "
      "Tabulate further, or write {} into the section [fit]";
  if (!below.empty() && request.outside.below == lubrication::BelowInterval::kError)
    terminal::warn(fmt::format(kWarning, below, "falls", lowest, "smallest", smallest,
                               "below = \"lubrication_limit\""));
  if (!above.empty() && request.outside.above == lubrication::AboveInterval::kError)
    terminal::warn(fmt::format(kWarning, above, "rises", highest, "largest", largest,
                               "above = \"stokes_limit\""));
}

}  // namespace viscontact::pipeline
