// Finds the files in the command of a fluid solver (solver_files.hpp).
#include "viscontact/case_file/fluid/solver_files.hpp"

#include <system_error>

namespace viscontact::case_file {

std::vector<std::string> with_absolute_files(std::vector<std::string> command,
                                             const std::filesystem::path& folder) {
  for (auto& word : command) {
    const bool is_name_of_program =
        &word == &command.front() && word.find('/') == std::string::npos;
    const auto file = std::filesystem::absolute(folder) / word;
    std::error_code ignored;
    if (!is_name_of_program && std::filesystem::is_regular_file(file, ignored))
      word = file.lexically_normal().string();
  }
  return command;
}

}  // namespace viscontact::case_file
