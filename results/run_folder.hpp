// The names of the files in the folder of a run (docs/file-formats.md).
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace viscontact::results {

/// The end of the message if another process of Viscontact has locked a folder to write into it.
inline constexpr const char* kFolderIsLocked =
    "another viscontact writes into it; wait until it has ended, or write elsewhere";

/// The folder of a run, and the paths of its files, which need not exist.
struct RunFolder {
  std::filesystem::path path;

  std::filesystem::path case_file() const { return path / "case.toml"; }
  /// The copy of a file that the case names, with the name of `file` and without its folders.
  std::filesystem::path beside_case(const std::filesystem::path& file) const {
    return path / file.filename();
  }
  std::filesystem::path table() const { return path / "table.csv"; }  ///< the table of forces
  std::filesystem::path fit() const { return path / "fit.json"; }     ///< the fit of the table
  std::filesystem::path trajectories() const { return path / "trajectories"; }
  std::filesystem::path trajectory(std::string_view model) const {
    return trajectories() / (std::string(model) + ".csv");
  }
  std::filesystem::path comparison() const { return path / "comparison.json"; }
  /// How the errors of the fit change the smallest and the last gap; not every run has this file.
  std::filesystem::path uncertainty() const { return path / "uncertainty.json"; }
  /// The file exists only if a model failed.
  std::filesystem::path failed_models() const { return path / "failed_models.json"; }
  /// `name` is given without its ending.
  std::filesystem::path plot(const std::string& name) const {
    return path / "plots" / (name + ".svg");
  }
  std::filesystem::path report() const { return path / "report.html"; }  ///< page of the run
};

}  // namespace viscontact::results
