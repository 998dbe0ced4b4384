// Computes the strokes of a sweep (swimmer_sweep.hpp).
#include "viscontact/sweep/swimmer_sweep.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "viscontact/common/error.hpp"
#include "viscontact/common/hash/sha256.hpp"
#include "viscontact/common/text/number.hpp"
#include "viscontact/reduced_model/swimmer/swim.hpp"

namespace viscontact::sweep {
namespace {

constexpr std::string_view kResults[] = {"displacement", "energy", "energy_at_constant_power",
                                         "efficiency"};

std::string fields_of(const reduced_model::SwimSums& sums) {
  return fmt::format(",{},{},{},{}", format_number(sums.displacement), format_number(sums.energy),
                     format_number(sums.energy_at_constant_power), format_number(sums.efficiency));
}

const std::string kNoResults = std::string(std::size(kResults), ',');

/// Throws Error(kWrongUsage) if the key is not one of a stroke or the viscosity.
void check_key(const std::string& key) {
  if (key.starts_with("stroke.") || key.starts_with("optimal.") || key == "fluid.viscosity") return;
  throw Error(ErrorKind::kWrongUsage,
              fmt::format("{} cannot be varied with one fit, because it changes the table; keys of "
                          "[stroke], [optimal] and fluid.viscosity can, and `viscontact swimmer` "
                          "makes another table",
                          key));
}

}  // namespace

SwimmerSweep::SwimmerSweep(SwimmerSweepPlan plan) : plan_(std::move(plan)), case_(plan_.case_path) {
  if (plan_.variations.empty())
    throw Error(ErrorKind::kWrongUsage, "there is nothing to vary; give --vary KEY=FROM:TO:COUNT");
  for (std::size_t i = 0; i < plan_.variations.size(); ++i) {
    check_key(plan_.variations[i].key);
    for (std::size_t j = 0; j < i; ++j)
      if (plan_.variations[i].key == plan_.variations[j].key)
        throw Error(ErrorKind::kWrongUsage,
                    fmt::format("the key {} is given twice", plan_.variations[i].key));
  }
  for (const std::uint64_t index : {std::uint64_t{0}, size() - 1}) {
    const auto c = case_.with(point(index));
    has_stroke_ = c.stroke.has_value();
    has_optimal_ = c.optimal.has_value();
    if (c.spheres.radii != plan_.fit.radii)
      throw_bad_input({plan_.case_path.string()},
                      "swimmer.radii differ from the radii of the fit; give the fit that "
                      "`viscontact swimmer` made from this case");
  }
  if (!has_stroke_ && !has_optimal_)
    throw Error(ErrorKind::kWrongUsage, "the case has neither [stroke] nor [optimal]");
}

std::uint64_t SwimmerSweep::size() const {
  return plan_.samples > 0 ? plan_.samples : grid_size(plan_.variations);
}

std::vector<std::pair<std::string, double>> SwimmerSweep::point(std::uint64_t index) const {
  return plan_.samples > 0 ? random_point(plan_.variations, index, plan_.seed)
                           : grid_point(plan_.variations, index);
}

std::vector<std::string> SwimmerSweep::columns() const {
  std::vector<std::string> columns;
  for (const auto& variation : plan_.variations) columns.push_back(variation.key);
  for (const auto result : kResults)
    if (has_stroke_) columns.emplace_back(result);
  for (const auto result : kResults)
    if (has_optimal_) columns.push_back("optimal." + std::string(result));
  columns.emplace_back("failure");
  return columns;
}

std::string SwimmerSweep::key_fields(std::uint64_t index) const {
  std::string text;
  for (const auto& [key, value] : point(index))
    text += (text.empty() ? "" : ",") + format_number(value);
  return text;
}

std::string SwimmerSweep::row(std::uint64_t index, const StopToken& stop) const {
  std::string text = key_fields(index), failure;
  const auto add = [&](const auto& compute) {
    try {
      text += fields_of(compute());
    } catch (const Error& error) {
      if (error.kind() == ErrorKind::kInterrupted) throw;
      text += kNoResults;
      failure += (failure.empty() ? "" : " | ") + std::string(error.what());
    }
  };
  try {
    const auto c = case_.with(point(index));
    auto fit = plan_.fit;
    fit.viscosity = c.spheres.viscosity;  // R is proportional to it
    const reduced_model::Swimmer swimmer(fit);
    if (has_stroke_) add([&] { return swim_sums(swimmer, *c.stroke); });
    if (has_optimal_)
      add([&] {
        const auto found = reduced_model::find_optimal_stroke(swimmer, *c.optimal, stop);
        return swim_sums(swimmer, reduced_model::stroke_of(found.loop, c.optimal_period));
      });
  } catch (const Error& error) {
    if (error.kind() == ErrorKind::kInterrupted) throw;
    text = key_fields(index) + (has_stroke_ ? kNoResults : "") + (has_optimal_ ? kNoResults : "");
    failure = error.what();
  }
  stop.throw_if_stop_requested();
  return fmt::format("{},{}\n", text, as_field(failure));
}

Rows SwimmerSweep::rows(const std::string& version) const {
  std::string identity = fmt::format("{} {}", plan_.samples, plan_.seed);
  for (const auto& v : plan_.variations) {
    identity += fmt::format(" {} {} {} {} {}", v.key, v.first, v.last, v.logarithmic, v.count);
    for (const double value : v.values) identity += " " + format_number(value);
  }
  return {.size = size(),
          .columns = columns(),
          .keys = plan_.variations.size(),
          .comments = {{"viscontact", "sweep of a swimmer"},
                       {"case", sha256(case_.text())},
                       {"fit", sha256(lubrication::write_resistance_fit(plan_.fit))},
                       {"rows", std::to_string(size())},
                       {"sweep", sha256(identity)},
                       {"version of Viscontact", version}},
          .key_fields = [this](std::uint64_t index) { return key_fields(index); },
          .row = [this](std::uint64_t index, const StopToken& stop) { return row(index, stop); }};
}

}  // namespace viscontact::sweep
