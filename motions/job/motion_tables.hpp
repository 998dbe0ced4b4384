// The tables of a tabulation of several motions of a pair, as the stage tabulate computes them. The
// commands `tabulate` and `rolling` ask for these tables.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "viscontact/motions/tabulation/motion_table_plan.hpp"
#include "viscontact/pipeline/tabulate/tabulate_stage.hpp"

namespace viscontact::motions {

/// The tables of all motions of a tabulation, whose case is the file `case_path` with the content
/// `case_text`. `path_of` gives the file of the table of a motion. A table of sliding has that of
/// rolling as its companion.
std::vector<pipeline::CaseTable> case_tables(const std::filesystem::path& case_path,
                                             const std::string& case_text,
                                             const freefem_axi::Tabulation& tabulation,
                                             const TablePath& path_of);

}  // namespace viscontact::motions
