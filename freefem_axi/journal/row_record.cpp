// Reads all journals of a table, merges their rows, and removes what a written table contains.
#include "viscontact/freefem_axi/journal/row_record.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>

#include <algorithm>
#include <cerrno>
#include <set>
#include <string_view>
#include <system_error>

#include "viscontact/common/error.hpp"
#include "viscontact/common/files/descriptor.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/common/text/number.hpp"
#include "viscontact/freefem_axi/journal/row_journal.hpp"

namespace viscontact::freefem_axi {
namespace {

namespace fs = std::filesystem;

/// The paths of a table's journals, sorted.
std::vector<fs::path> journals_of(const fs::path& table_path) {
  const fs::path own = journal_path(table_path);
  std::vector<fs::path> journals;
  std::error_code no_folder;
  for (const auto& entry :
       fs::directory_iterator(own.has_parent_path() ? own.parent_path() : ".", no_folder)) {
    const std::string name = entry.path().filename().string();
    const std::string stem = own.filename().string() + ".";
    if (name == own.filename() ||
        (name.starts_with(stem) && is_writer_name(name.substr(stem.size()))))
      journals.push_back(entry.path());
  }
  std::ranges::sort(journals);
  return journals;
}

/// Calls `use` with each complete line of a journal. A journal that another process removes
/// meanwhile counts as empty.
template <class Use>
void for_each_line(const fs::path& journal, const Use& use) {
  std::string text;
  try {
    text = read_file(journal);
  } catch (const Error&) {
    if (fs::exists(journal)) throw;
  }
  for (std::size_t start = 0, end = 0; (end = text.find('\n', start)) != std::string::npos;
       start = end + 1)
    if (const auto line = read_journal_line(std::string_view(text).substr(start, end - start)))
      use(*line);
}

}  // namespace

std::vector<GridPoint> grid_of(const Tabulation& tabulation) {
  std::vector<GridPoint> grid;
  for (const double velocity : tabulation.reference_velocities)
    for (const double gap : tabulation.gaps) grid.push_back({gap, velocity});
  return grid;
}

std::optional<lubrication::ForceTable> find_table(const fs::path& table_path,
                                                  const std::string& tabulation_hash) {
  if (!fs::is_regular_file(table_path)) return {};
  try {
    auto table = lubrication::read_force_table(table_path);
    if (table.case_hash == tabulation_hash) return table;
  } catch (const Error&) {  // the file is not a table
  }
  return {};
}

RowRecord read_row_record(const fs::path& table_path, const std::string& tabulation_hash) {
  RowRecord record;
  for (const auto& journal : journals_of(table_path))
    for_each_line(journal, [&](const JournalLine& line) {
      if (line.tabulation_hash != tabulation_hash) return;
      if (const auto* finished = std::get_if<FinishedRow>(&line.entry))
        record.finished.insert({{finished->row.gap, finished->row.reference_velocity}, *finished});
      else if (const auto* failed = std::get_if<FailedRow>(&line.entry))
        record.failed[failed->point] = failed->reason;
    });
  // The table must be read after the journals, because its writer removes the journals after
  // writing it.
  if (const auto table = find_table(table_path, tabulation_hash)) {
    const auto version = table->versions.find("FreeFEM");
    for (const auto& row : table->rows)
      record.finished.insert({{row.gap, row.reference_velocity},
                              {row, version == table->versions.end() ? "" : version->second}});
  }
  std::erase_if(record.failed,
                [&](const auto& failed) { return record.finished.contains(failed.first); });
  return record;
}

std::vector<GridPoint> missing_points(const RowRecord& record,
                                      const std::vector<GridPoint>& points) {
  std::vector<GridPoint> missing;
  std::ranges::copy_if(points, std::back_inserter(missing),
                       [&](const GridPoint& point) { return !record.finished.contains(point); });
  return missing;
}

lubrication::ForceTable assemble_table(const Tabulation& tabulation, const RowRecord& record) {
  lubrication::ForceTable table;
  table.viscosity = tabulation.viscosity;
  table.radius = tabulation.radius;
  table.geometry = geometry_in_words(tabulation);
  table.neighbour_moves = neighbour_moves(tabulation);
  table.leading_coefficient = leading_coefficient(tabulation);
  table.container = container_in_words(tabulation);
  table.case_hash = tabulation_hash(tabulation);
  std::set<std::string> freefem_versions;
  for (const auto& point : grid_of(tabulation)) {
    const auto& finished = record.finished.at(point);
    table.rows.push_back(finished.row);
    freefem_versions.insert(finished.freefem_version);
  }
  table.versions["FreeFEM"] = fmt::format("{}", fmt::join(freefem_versions, ", "));
  return table;
}

void remove_journals(const fs::path& table_path, const std::string& tabulation_hash) {
  for (const auto& journal : journals_of(table_path)) {
    // The journal is locked while it is read and removed. A process that opens it meanwhile finds
    // that it was removed or replaced, and opens it again.
    const Descriptor file(::open(journal.c_str(), O_RDWR | O_CLOEXEC));
    if (file.get() < 0) continue;
    if (::flock(file.get(), LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) continue;
    std::string others;
    bool has_ours = false;
    for_each_line(journal, [&](const JournalLine& line) {
      if (line.tabulation_hash == tabulation_hash)
        has_ours = true;
      else
        others += write_journal_line(line);
    });
    if (others.empty())
      fs::remove(journal);
    else if (has_ours)
      write_file(journal, others);
  }
}

}  // namespace viscontact::freefem_axi
