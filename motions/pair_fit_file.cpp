// Reads and writes the file of a PairFit (docs/file-formats.md): one object per entry, each of
// which has the keys of a fit file.
#include <fmt/format.h>

#include "viscontact/common/equal_up_to_rounding.hpp"
#include "viscontact/common/error.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/lubrication/fit/json_object.hpp"
#include "viscontact/motions/pair_fit.hpp"

namespace viscontact::motions {
namespace {

const std::string kPairFit = "pair fit";

/// Throws Error(kBadInput) if the entry was made for another pair than `fit`.
void check_same_pair(const lubrication::JsonObject& object, const lubrication::Fit& entry,
                     const PairFit& fit) {
  if (!equal_up_to_rounding(entry.viscosity, fit.viscosity))
    object.fail("viscosity", "differs from that of the file");
  if (!equal_up_to_rounding(entry.radius, fit.radius))
    object.fail("radius", "differs from that of the file");
  if (entry.geometry != fit.geometry) object.fail("geometry", "differs from that of the file");
  if (entry.reference_velocity != -1)
    object.fail("reference_velocity",
                fmt::format("is {}; it must be -1", entry.reference_velocity));
}

}  // namespace

bool is_pair_fit(const std::filesystem::path& path) {
  return std::filesystem::is_regular_file(path) &&
         read_file(path).find(fmt::format("\"kind\": \"{}\"", kPairFit)) != std::string::npos;
}

PairFit read_pair_fit(const std::filesystem::path& path) {
  const auto document = JsonDocument::parse(read_file(path), path.string());
  const lubrication::JsonObject root(document);
  root.allow_only("kind viscosity radius geometry gap_interval entries versions provenance");
  if (root.text("kind") != kPairFit)
    root.fail("kind", fmt::format("is '{}'; it must be '{}'", root.text("kind"), kPairFit));
  PairFit fit;
  fit.viscosity = root.number_above("viscosity", 0, false);
  fit.radius = root.number_above("radius", 0, false);
  fit.geometry = root.text("geometry");
  const Json& interval = root.array("gap_interval");
  if (interval.size() != 2) root.fail("gap_interval", "must be two gaps");
  fit.gap_interval = {root.finite("gap_interval[0]", interval[0]),
                      root.finite("gap_interval[1]", interval[1])};
  if (!(fit.gap_interval[0] > 0 && fit.gap_interval[1] > fit.gap_interval[0]))
    root.fail("gap_interval", "must be two gaps with 0 < first < second");
  const lubrication::JsonObject entries = root.object("entries");
  std::string names;
  for (const auto& entry : pair_entries()) names += std::string(entry.name) + " ";
  entries.allow_only(names);
  for (std::size_t i = 0; i < pair_entries().size(); ++i) {
    const std::string name(pair_entries()[i].name);
    if (!entries.has(name)) continue;
    const lubrication::JsonObject object = entries.object(name);
    EntryFit entry;
    if (object.has("theory")) entry.theory = object.number("theory");
    entry.fit = lubrication::read_fit_object(object, "theory");
    check_same_pair(object, entry.fit, fit);
    fit.entries[static_cast<PairEntry>(i)] = std::move(entry);
  }
  if (fit.entries.empty()) root.fail("entries", "is empty; a fit must have at least one entry");
  (void)root.object("versions");
  for (const auto& [program, version] : root.at("versions").items())
    if (version.is_string()) fit.versions[program] = version.get<std::string>();
  return fit;
}

std::string write_pair_fit(const PairFit& fit) {
  Json json;
  json["kind"] = kPairFit;
  json["viscosity"] = fit.viscosity;
  json["radius"] = fit.radius;
  json["geometry"] = fit.geometry;
  json["gap_interval"] = fit.gap_interval;
  for (const auto& [entry, one] : fit.entries) {
    auto& object =
        json["entries"][std::string(pair_entries()[static_cast<std::size_t>(entry)].name)];
    object = Json::parse(lubrication::write_fit(one.fit));
    if (one.theory) object["theory"] = *one.theory;
  }
  json["versions"] = fit.versions;
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace viscontact::motions
