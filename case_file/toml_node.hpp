// What a TomlSection refers to. Only the sources of TomlSection include toml++, because it takes
// seconds to compile.
#pragma once

#include <toml++/toml.h>

#include <memory>
#include <set>
#include <string>

#include "viscontact/case_file/toml_section.hpp"

namespace viscontact::case_file {

/// A table, where it stands, and which of its keys were asked for.
struct TomlSection::Node {
  std::shared_ptr<const toml::table> root;  ///< keeps `table` alive
  const toml::table* table = nullptr;       ///< the table of this section, in `root`
  std::string file;                         ///< name of the file in messages
  std::string path;                         ///< "tabulation.container"; empty for the root
  std::set<std::string> asked;              ///< keys that were asked for
};

}  // namespace viscontact::case_file
