// The stages after the tabulation, one by one, on a table of the exact drag of a plane.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <string>

#include "tests/common/temporary_folder.hpp"
#include "tests/program/program.hpp"
#include "tests/program/sample_files.hpp"
#include "viscontact/reduced_model/comparison.hpp"
#include "viscontact/reduced_model/models/models.hpp"
#include "viscontact/reduced_model/trajectory.hpp"

namespace viscontact {

inline std::size_t number_of_models() {
  return static_cast<std::size_t>(std::ranges::distance(reduced_model::default_models()));
}

class Stages : public ::testing::Test {
 protected:
  Stages() {
    put("case.toml", lecture_case_text());
    put("table.csv", exact_table_text());
  }
  void put(const std::string& name, const std::string& text) const { put_text(path(name), text); }
  std::string path(const std::string& name) const { return (scratch_.path() / name).string(); }

  void fit(const std::string& basis) const {
    expect_done(
        run_viscontact({"fit", path("table.csv"), "-o", path("fit.json"), "--basis", basis}));
  }
  /// Fits with the asymptotic basis and simulates the default models into the folder run/.
  void simulate() const {
    fit("asymptotic");
    simulate_into("run");
  }
  /// Simulates with the fit fit.json, which must exist, into a folder.
  void simulate_into(const std::string& folder) const {
    expect_done(run_viscontact(
        {"simulate", path("case.toml"), "--fit", path("fit.json"), "-o", path(folder)}));
  }
  reduced_model::Trajectory trajectory(const std::string& model) const {
    return reduced_model::read_trajectory(path("run/trajectories/" + model + ".csv"));
  }
  reduced_model::ModelComparison comparison_of(const std::string& model) const {
    for (const auto& entry : reduced_model::read_comparison(path("run/comparison.json")).models)
      if (entry.model == model) return entry;
    throw std::invalid_argument("not compared: " + model);
  }

  TemporaryFolder scratch_;
};

}  // namespace viscontact
