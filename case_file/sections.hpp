// The readers of the sections of a case file, and what they share. Lengths, masses and times are in
// the units of the case. Each reader checks its section and applies the defaults.
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

/// Calls `check`, which tests a value in another part of the program, and gives its error the key
/// and the line of this file.
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

/// Reads [motion], but for its models, and the sections of the models' parameters from the root.
/// Appends the files of the external force to `force_files`.
reduced_model::Motion read_motion(const TomlSection& root, const TomlSection& section, double mass,
                                  double radius, const std::filesystem::path& case_folder,
                                  std::vector<std::filesystem::path>& force_files);

}  // namespace viscontact::case_file
