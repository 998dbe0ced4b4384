// The fields of the file of a PairFit (docs/file-formats.md): one object per entry, each of which
// has the keys of a fit file. Numbers have the units of the fit. Every fault is an Error(kBadInput)
// with line and key. A change must keep published files readable.
#include <fmt/format.h>

#include "viscontact/common/equal_up_to_rounding.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/common/text/json_fields.hpp"
#include "viscontact/motions/pair_fit.hpp"

namespace viscontact::motions {
namespace {

const std::string kPairFit = "pair fit";

/// Refuses an entry that was made for another pair than `fit`. `name` is its key.
void check_same_pair(const JsonFields& json, const std::string& name, const lubrication::Fit& entry,
                     const PairFit& fit) {
  const auto differs = [&](const char* key) {
    json.fail("entries." + name + "." + key, "differs from that of the file");
  };
  if (!equal_up_to_rounding(entry.viscosity, fit.viscosity)) differs("viscosity");
  if (!equal_up_to_rounding(entry.radius, fit.radius)) differs("radius");
  if (entry.geometry != fit.geometry) differs("geometry");
  if (entry.reference_velocity != -1)
    json.fail("entries." + name + ".reference_velocity",
              fmt::format("is {}; it must be -1", entry.reference_velocity));
}

}  // namespace

void fields_of(JsonFields& json, EntryFit& entry) {
  fields_of(json, entry.fit);
  json("theory", entry.theory, Absence::kLeftOutIfEmpty);
}

void fields_of(JsonFields& json, std::map<PairEntry, EntryFit>& entries) {
  for (std::size_t i = 0; i < pair_entries().size(); ++i) {
    const auto which = static_cast<PairEntry>(i);
    std::optional<EntryFit> entry;
    if (entries.contains(which)) entry = entries[which];
    json(std::string(pair_entries()[i].name), entry, Absence::kLeftOutIfEmpty);
    if (entry) entries[which] = *entry;
  }
}

void fields_of(JsonFields& json, PairFit& fit) {
  json.constant("kind", kPairFit);
  json("viscosity", fit.viscosity, kPositive);
  json("radius", fit.radius, kPositive);
  json("geometry", fit.geometry);
  json.gap_interval("gap_interval", fit.gap_interval);
  json("entries", fit.entries);
  if (json.reads() && fit.entries.empty())
    json.fail("entries", "is empty; a fit must have at least one entry");
  if (json.reads())
    for (const auto& [which, entry] : fit.entries)
      check_same_pair(json, std::string(pair_entries()[static_cast<std::size_t>(which)].name),
                      entry.fit, fit);
  json("versions", fit.versions);
  json.foreign_object("provenance");
}

bool is_pair_fit(const std::filesystem::path& path) {
  return std::filesystem::is_regular_file(path) &&
         read_file(path).find(fmt::format("\"kind\": \"{}\"", kPairFit)) != std::string::npos;
}

PairFit read_pair_fit(const std::filesystem::path& path) {
  return JsonFields::read<PairFit>(read_file(path), path.string());
}

std::string write_pair_fit(const PairFit& fit) { return JsonFields::text_of(fit); }

}  // namespace viscontact::motions
