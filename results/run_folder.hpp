// The names of the files in the folder of a run (docs/file-formats.md). app/, pipeline/, report/,
// particles/, rolling/ and swimmer/ use these names. A change must keep the names, because users,
// scripts and later versions rely on them. Nothing is thrown, and whether a file exists is not
// checked. No value here has a unit.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace viscontact::results {

/// The end of the message if another process of Viscontact has locked a folder, because it writes
/// files there.
inline constexpr const char* kFolderIsLocked =
    "another viscontact writes into it; wait until it has ended, or write elsewhere";

/// The folder of a run; each function returns the path of a file or sub-folder in it.
struct RunFolder {
  std::filesystem::path path;  ///< path of the folder

  /// The copy of the case that was run.
  std::filesystem::path case_file() const { return path / "case.toml"; }
  /// The copy of a file that the case names, with the name of `file` and without its folders.
  std::filesystem::path beside_case(const std::filesystem::path& file) const {
    return path / file.filename();
  }
  std::filesystem::path table() const { return path / "table.csv"; }  ///< table of forces
  std::filesystem::path fit() const { return path / "fit.json"; }     ///< fit of the table
  /// The folder of the trajectories.
  std::filesystem::path trajectories() const { return path / "trajectories"; }
  /// The file of the trajectory of a model; `model` is the name of the model.
  std::filesystem::path trajectory(std::string_view model) const {
    return trajectories() / (std::string(model) + ".csv");
  }
  /// The comparison of the trajectories.
  std::filesystem::path comparison() const { return path / "comparison.json"; }
  /// How the errors of the fit change the smallest and the last gap; not every run has this file.
  std::filesystem::path uncertainty() const { return path / "uncertainty.json"; }
  /// The models that failed, with reasons; exists only if a model failed.
  std::filesystem::path failed_models() const { return path / "failed_models.json"; }
  /// The picture with this name, which is given without its ending.
  std::filesystem::path plot(const std::string& name) const {
    return path / "plots" / (name + ".svg");
  }
  std::filesystem::path report() const { return path / "report.html"; }  ///< page of the run
};

}  // namespace viscontact::results
