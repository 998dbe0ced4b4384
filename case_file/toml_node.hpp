// What a TomlSection refers to. Only the sources of TomlSection include toml++, because it takes
// seconds to compile.
#pragma once

#include <toml++/toml.h>

#include <memory>
#include <set>
#include <string>

#include "viscontact/case_file/toml_section.hpp"

namespace viscontact::case_file {

struct TomlSection::Node {
  std::shared_ptr<const toml::table> root;  // keeps `table` alive
  const toml::table* table = nullptr;
  std::string file;
  std::string path;             // "tabulation.container"; empty for the root
  std::set<std::string> asked;  // keys that were asked for
};

}  // namespace viscontact::case_file
