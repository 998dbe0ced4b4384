// Copies the arrays of all frames of a run into one HDF5 file, particles.h5 (write_hdf5() in
// particles_pages.hpp), with the names and units of docs/file-formats.md, "HDF5".
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "viscontact/common/error.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/common/system/module.hpp"
#include "viscontact/common/vtk/vtk_xml.hpp"
#include "viscontact/particle_runs/io/contact_columns.hpp"
#include "viscontact/particle_runs/io/particle_columns.hpp"
#include "viscontact/particle_runs/io/vtk.hpp"
#include "viscontact/particle_runs/run/module/hdf5_module.hpp"
#include "viscontact/particle_runs/run/particles_pages.hpp"

namespace viscontact::particles {
namespace {

namespace fs = std::filesystem;

/// viscontact_create_hdf5() of the module hdf5. Throws Error(kWrongUsage) if the module cannot be
/// loaded.
auto* load_create_hdf5() {
  try {
    return function_of_module<decltype(viscontact_create_hdf5)>("hdf5", "viscontact_create_hdf5");
  } catch (const Error& error) {
    throw Error(ErrorKind::kWrongUsage, "--hdf5 needs a build with libhdf5-dev: {}", error.what());
  }
}

template <class Number>
constexpr Hdf5Number type_of() {
  if constexpr (std::is_same_v<Number, double>)
    return Hdf5Number::kDouble;
  else if constexpr (std::is_same_v<Number, std::int32_t>)
    return Hdf5Number::kInt32;
  else
    return Hdf5Number::kInt64;
}

/// A data set with rows of `columns` numbers each, to which rows are appended.
template <class Number>
class Rows {
 public:
  Rows(Hdf5File& file, const std::string& path, std::size_t columns)
      : file_(file), columns_(columns), set_(file.add_rows(path, type_of<Number>(), columns)) {}
  void append(const std::vector<Number>& numbers) {
    file_.append(set_, numbers.data(), numbers.size() / columns_);
  }

 private:
  Hdf5File& file_;
  std::size_t columns_;
  std::size_t set_;
};

/// An array: its section and name in a frame, and its name and number of columns in the HDF5 file.
struct Array {
  std::string_view section, name;
  std::string target;
  std::size_t columns;
};

/// Arrays with numbers of one type, and their rows in a group of the file. Of the arrays `all` only
/// those are copied that the last frame has: an earlier frame may lack the masses that a source
/// adds.
template <class Number>
class Arrays {
 public:
  Arrays(Hdf5File& file, const std::string& group, const std::vector<Array>& all,
         const VtkReader& last) {
    for (const auto& array : all)
      if (last.has_array(array.section, array.name))
        arrays_.emplace_back(array, Rows<Number>(file, group + array.target, array.columns));
  }
  /// Appends the arrays of a frame; an array that the frame lacks has zeros. Throws
  /// Error(kBadInput) if an array does not have `count` rows.
  void append(const VtkReader& frame, std::size_t count) {
    for (auto& [array, rows] : arrays_) {
      const auto numbers = frame.has_array(array.section, array.name)
                               ? frame.array<Number>(array.section, array.name)
                               : std::vector<Number>(count * array.columns);
      if (numbers.size() != count * array.columns) frame.refuse();
      rows.append(numbers);
    }
  }

 private:
  std::vector<std::pair<Array, Rows<Number>>> arrays_;
};

/// A group of the file with the rows of the particles, or of the contacts, of all frames. Its data
/// set `begin` has the number of the first row of each frame, and last the number of all rows.
class Table {
 public:
  Table(Hdf5File& file, const std::string& group, const std::vector<Array>& decimal,
        const std::vector<Array>& whole, const VtkReader& last)
      : decimal_(file, group, decimal, last),
        whole_(file, group, whole, last),
        begins_(file, group + "begin", 1) {
    begins_.append({0});
  }
  void append(const VtkReader& frame, std::size_t count) {
    decimal_.append(frame, count);
    whole_.append(frame, count);
    end_ += static_cast<std::int64_t>(count);
    begins_.append({end_});
  }

 private:
  Arrays<double> decimal_;
  Arrays<std::int32_t> whole_;
  Rows<std::int64_t> begins_;
  std::int64_t end_ = 0;
};

/// The arrays of `columns` in a section of the frames: first those of decimal numbers, then those
/// of whole numbers.
template <class AnyColumn>
std::array<std::vector<Array>, 2> arrays_of(const std::vector<AnyColumn>& columns,
                                            std::string_view section, int dimension) {
  std::array<std::vector<Array>, 2> arrays;
  RunFacts run = kAllFacts;
  run.dimension = dimension;
  for (const auto* column : columns_in(Output::kFrames, columns, run))
    arrays[column->is_whole() ? 1 : 0].push_back({section, column->name,
                                                  std::string(column->name_in_hdf5()),
                                                  column->count_in_frames(dimension)});
  return arrays;
}

/// Copies the frames of a run in `folder` into `file`. Throws Error(kBadInput) if there is no
/// frame, or if a frame cannot be read.
void copy_frames(const ParticlesCase& c, const fs::path& folder, Hdf5File& file) {
  const auto frames = read_pvd(folder / "particles.pvd");
  if (frames.empty()) throw_bad_input({(folder / "particles.pvd").string()}, "has no frame");
  const auto last_text = read_file(folder / frames.back().second);
  const VtkReader last(last_text, (folder / frames.back().second).string(), "frame");
  Rows<double> times(file, "time", 1);
  std::optional<Rows<double>> periods;
  if (last.has_array("FieldData", "periods")) periods.emplace(file, "periods", 9);
  auto of_points = arrays_of(particle_columns(), "PointData", c.particles.dimension);
  of_points[0].insert(of_points[0].begin(), {"Points", "Points", "position", 3});
  Table particles(file, "particles/", of_points[0], of_points[1], last);
  const auto of_contacts = arrays_of(contact_columns(), "CellData", c.particles.dimension);
  Table contacts(file, "contacts/", of_contacts[0], of_contacts[1], last);
  for (const auto& [time, name] : frames) {
    const auto text = read_file(folder / name);
    const VtkReader frame(text, (folder / name).string(), "frame");
    times.append({time});
    if (periods) periods->append(frame.array<double>("FieldData", "periods"));
    particles.append(frame, frame.array<double>("PointData", "radius").size());
    contacts.append(frame, frame.array<double>("CellData", "gap").size());
  }
}

}  // namespace

void require_hdf5() { load_create_hdf5(); }

void write_hdf5(const ParticlesCase& c, const fs::path& folder,
                const results::Provenance& provenance) {
  const auto create = load_create_hdf5();
  const fs::path name = folder / "particles.h5";
  const auto made = results::output_text(name, TextKind::kHashComment, "", provenance);
  write_file_by(name, [&](const fs::path& place) {
    std::unique_ptr<Hdf5File> file;
    create(place, name, file);
    file->add_text("provenance", made);
    file->add_text("title", c.title);
    copy_frames(c, folder, *file);
    file->close();
  });
}

}  // namespace viscontact::particles
