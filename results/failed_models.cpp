// Reads and writes failed_models.json, and chooses the reference if models have failed.
#include "viscontact/results/failed_models.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <iterator>
#include <nlohmann/json.hpp>

#include "viscontact/common/files/file.hpp"
#include "viscontact/reduced_model/models/models.hpp"
#include "viscontact/results/exit_code.hpp"

namespace viscontact::results {
namespace {

using Json = nlohmann::ordered_json;

}  // namespace

std::vector<FailedModel> read_failed_models(const std::filesystem::path& path) {
  if (!std::filesystem::exists(path)) return {};
  try {
    std::vector<FailedModel> failed;
    const auto json = Json::parse(read_file(path));
    for (const auto& [name, entry] : json.at("failed_models").items())
      failed.push_back({name, entry.at("reason"), kind_of_exit_code(entry.at("exit_code")),
                        entry.at("made_from").get<CsvComments>()});
    return failed;
  } catch (const std::exception&) {  // not JSON of this form, or an unknown exit code
    throw_bad_input({path.string()},
                    "is not a record of failed models; remove it and simulate again");
  }
}

std::vector<FailedModel> recorded_failures(const RunFolder& run, const CsvComments& made_from) {
  try {
    auto failed = read_failed_models(run.failed_models());
    std::erase_if(failed, [&](const FailedModel& model) { return model.made_from != made_from; });
    return failed;
  } catch (const Error&) {
    return {};
  }
}

std::string write_failed_models(const std::vector<FailedModel>& failed) {
  Json json;
  json["failed_models"] = Json::object();
  for (const auto& model : failed)
    json["failed_models"][model.model] = {{"reason", model.reason},
                                          {"exit_code", exit_code_of(model.kind)},
                                          {"made_from", model.made_from}};
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

Error error_of(const std::vector<FailedModel>& failed, std::size_t computed,
               const std::filesystem::path& case_path) {
  assert(!failed.empty());
  std::string others;
  for (std::size_t i = 1; i < failed.size(); ++i)
    others += fmt::format("{}{}", i == 1 ? "" : ", ", failed[i].model);
  if (!others.empty()) others = fmt::format("; {} more failed ({})", failed.size() - 1, others);
  std::string written;
  if (computed == 1) written = "; 1 other model is computed and written";
  if (computed > 1) written = fmt::format("; {} other models are computed and written", computed);
  return {failed.front().kind,
          fmt::format("{}: model {}: {}{}{}", case_path.string(), failed.front().model,
                      failed.front().reason, others, written)};
}

std::vector<reduced_model::ModelWithoutTrajectory> failures_without(
    const std::vector<reduced_model::Trajectory>& trajectories, const RunFolder& run) {
  std::vector<reduced_model::ModelWithoutTrajectory> failed;
  for (const auto& model : read_failed_models(run.failed_models()))
    if (std::ranges::find(trajectories, model.model, &reduced_model::Trajectory::model) ==
        trajectories.end())
      failed.push_back({model.model, model.reason});
  return failed;
}

std::string reference_without(const std::vector<std::string>& models,
                              const std::vector<FailedModel>& failed) {
  std::vector<std::string> computed;
  std::ranges::copy_if(models, std::back_inserter(computed), [&](const std::string& model) {
    return std::ranges::find(failed, model, &FailedModel::model) == failed.end();
  });
  return reduced_model::reference_of(computed);
}

std::string reference_among(const std::vector<reduced_model::Trajectory>& trajectories,
                            const std::vector<reduced_model::ModelWithoutTrajectory>& failed,
                            const std::string& asked) {
  std::string reference = asked.empty() ? reduced_model::usual_reference() : asked;
  const auto found =
      std::ranges::find(failed, reference, &reduced_model::ModelWithoutTrajectory::model);
  if (found == failed.end()) return reference;
  assert(!asked.empty() || !trajectories.empty());
  if (asked.empty()) return trajectories.front().model;
  throw Error(ErrorKind::kBadInput,
              "the reference model '{}' has no trajectory here, because it failed: {}; choose "
              "another reference",
              reference, found->reason);
}

}  // namespace viscontact::results
