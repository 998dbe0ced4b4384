// The readers of the long sections of a case file, and a function that they share. Lengths, masses
// and times are in the units of the case. Each reader checks its section and applies the defaults.
#pragma once

#include <fmt/format.h>

#include <filesystem>
#include <string_view>
#include <vector>

#include "viscontact/case_file/toml_section.hpp"
#include "viscontact/common/error.hpp"
#include "viscontact/freefem_axi/tabulation.hpp"
#include "viscontact/reduced_model/motion.hpp"

namespace viscontact::case_file {

/// Calls `check`, with which another part of the program tests the value of `key`. If it throws an
/// Error, throws one that also names the key and its line in the case file.
template <class Check>
auto at_key(const TomlSection& section, std::string_view key, const Check& check) {
  try {
    return check();
  } catch (const Error& error) {
    section.fail(key, fmt::format("is not accepted: {}", error.what()));
  }
}

/// Reads [tabulation].
freefem_axi::Tabulation read_tabulation(const TomlSection& section, double viscosity,
                                        double radius);

/// Reads [motion] except its key `models`, and the sections with parameters of models, which are
/// tables of `root`. Appends the files of the external force to `force_files`.
reduced_model::Motion read_motion(const TomlSection& root, const TomlSection& section, double mass,
                                  double radius, const std::filesystem::path& case_folder,
                                  std::vector<std::filesystem::path>& force_files);

}  // namespace viscontact::case_file
