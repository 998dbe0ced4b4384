// The tables of one or several cases: computed here, computed in shares by the tasks of a cluster's job,
// or put together from what those have finished.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "viscontact/case_file/case_file.hpp"
#include "viscontact/freefem_axi/row_record.hpp"

namespace viscontact {

/// A case and the file that its table goes to.
struct CaseTable {
  Case c;
  std::filesystem::path table;

  const Tabulation& tabulation() const { return required_tabulation(c); }
  std::string hash() const { return tabulation_hash(tabulation()); }
};

/// One case: its table is `output`. Several: `output` is a folder, and the tables are named after
/// the case files. Throws Error(kWrongUsage) if two would be the same, Error(kBadInput) as
/// read_case does.
std::vector<CaseTable> read_case_tables(const std::vector<std::string>& case_files,
                                        const std::filesystem::path& output);

/// Task `number` of `count`: every row whose number over all tables' grids is congruent to it.
struct Share {
  std::size_t number = 0, count = 1;
};

/// "K/T" with 0 <= K < T. Throws Error(kWrongUsage).
Share parse_share(const std::string& text);

/// For each table, the points of its grid that are in the share.
std::vector<std::vector<GridPoint>> points_of(const std::vector<CaseTable>& tables,
                                              const Share& share);

/// Tabulates what is missing, one table after the other, `jobs` rows at once; tables of the same
/// inputs that are there already stay. Rows that fail stop neither the others nor the other tables:
/// Error(kExternalProgram) at the end names them.
void tabulate_stage(const std::vector<CaseTable>& tables, int jobs);

/// Computes what is missing of a share, into journals of its own; writes no table.
void share_stage(const std::vector<CaseTable>& tables, const Share& share, int jobs);

/// Writes the tables from finished rows, computing none. Throws at the end, with the rows that are
/// missing: Error(kExternalProgram) if some have failed, else Error(kNotConverged). `slurm_folder`
/// is where logs and submitted cases are (slurm.hpp).
void gather_stage(const std::vector<CaseTable>& tables, const std::filesystem::path& slurm_folder);

}  // namespace viscontact
