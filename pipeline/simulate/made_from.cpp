// Writes and compares the comment lines of trajectories that identify their inputs. A file that
// cannot be read counts as one from other inputs. A change of a key makes `run` simulate again,
// because trajectories of earlier versions lack the key.
#include "viscontact/pipeline/simulate/made_from.hpp"

#include <algorithm>
#include <filesystem>

#include "viscontact/common/error.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/common/hash/sha256.hpp"
#include "viscontact/reduced_model/trajectory.hpp"
#include "viscontact/results/provenance.hpp"

namespace viscontact::pipeline {
namespace {

constexpr const char* kBelowKey = "drag below the fit";
constexpr const char* kAboveKey = "drag above the fit";

}  // namespace

CsvComments identity_of_trajectory(const case_file::Case& c, const std::string& fit_text,
                                   const lubrication::OutsideInterval& outside) {
  CsvComments comments = {
      {"case", sha256(c.text)},
      {"fit", results::content_sha256(fit_text)},
      {"revision of the models", std::to_string(reduced_model::kModelsRevision)},
      {"version of Viscontact", VISCONTACT_VERSION}};
  std::string forces;
  for (const auto& file : c.force_files) forces += read_file(file);
  if (!c.force_files.empty()) comments["force"] = sha256(forces);
  if (outside.below != lubrication::BelowInterval::kError)
    comments[kBelowKey] = outside.below == lubrication::BelowInterval::kTheoryLimit
                              ? "theory's limit"
                              : "lubrication limit";
  if (outside.above != lubrication::AboveInterval::kError) comments[kAboveKey] = "Stokes' limit";
  return comments;
}

bool is_simulated(const results::RunFolder& run, const std::string& model,
                  const CsvComments& identity) {
  const auto file = run.trajectory(model);
  if (!std::filesystem::is_regular_file(file)) return false;
  try {
    const auto made_from = reduced_model::read_trajectory(file).provenance;
    const auto value = [](const CsvComments& of, const std::string& key) {
      const auto found = of.find(key);
      return found == of.end() ? std::string() : found->second;
    };
    const auto same = [&](const std::string& key) {
      return value(made_from, key) == value(identity, key);
    };
    // The two keys of the limits are compared even if `identity` lacks them, which means no limit.
    return same(kBelowKey) && same(kAboveKey) &&
           std::ranges::all_of(identity, [&](const auto& line) { return same(line.first); });
  } catch (const Error&) {  // not a trajectory
    return false;
  }
}

}  // namespace viscontact::pipeline
