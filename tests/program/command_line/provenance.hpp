// A folder with a case and a table, and commands that run there at a fixed time.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "tests/common/temporary_folder.hpp"
#include "tests/program/program.hpp"
#include "tests/program/sample_files.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/common/hash/sha256.hpp"

namespace viscontact {

/// The provenance of a file. It is searched in the text of the file, as another program would do,
/// whatever kind of comment contains it. Fails the test if there is none.
inline nlohmann::json provenance_of(const std::filesystem::path& file) {
  std::istringstream text(read_file(file));
  for (std::string line; std::getline(text, line);)
    if (line.find("provenance") != std::string::npos) {
      const auto begin = line.find("{\"command\":[");
      const auto end = line.rfind('}');
      if (begin != std::string::npos)
        return nlohmann::json::parse(line.substr(begin, end + 1 - begin));
    }
  ADD_FAILURE() << file << " does not say how it was made";
  return {};
}

/// The names of the inputs in the provenance of a file, those that are intermediate or the others.
/// Expects that their hashes are those of the files.
inline std::vector<std::string> inputs_of(const std::filesystem::path& file,
                                          bool intermediate = false) {
  std::vector<std::string> names;
  const nlohmann::json provenance = provenance_of(file);
  for (const auto& input : provenance.at("inputs")) {
    if (input.value("intermediate", false) != intermediate) continue;
    names.push_back(input.at("file"));
    EXPECT_EQ(input.at("sha256"), sha256(read_file(input.at("file").get<std::string>()))) << file;
  }
  return names;
}

class Provenance : public ::testing::Test {
 protected:
  Provenance() {
    put_text(path("case.toml"), lecture_case_text());
    put_text(path("table.csv"), exact_table_text());
  }
  std::string path(const std::string& name) const { return (scratch_.path() / name).string(); }
  ProgramResult run(const std::vector<std::string>& arguments) const {
    return run_viscontact(arguments, {"SOURCE_DATE_EPOCH=1000000000"});
  }
  void fit() const { expect_done(run({"fit", path("table.csv"), "-o", path("fit.json")})); }

  TemporaryFolder scratch_;
};

}  // namespace viscontact
