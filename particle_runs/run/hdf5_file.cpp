// particles.h5, docs/file-formats.md. A failure that can lose data is caught by checked().
#include "viscontact/common/error.hpp"
#include "viscontact/particle_runs/run/particles_pages.hpp"

#ifdef VISCONTACT_HAS_HDF5

#include <hdf5.h>

#include <array>
#include <cassert>
#include <cstdint>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "viscontact/common/files/file.hpp"
#include "viscontact/common/vtk/vtk_xml.hpp"
#include "viscontact/particle_runs/io/vtk.hpp"
#include "viscontact/particles/pair_memory.hpp"

namespace viscontact::particles {
namespace {

namespace fs = std::filesystem;

/// While an object of this class exists, the C library prints no errors, because they are thrown.
/// Afterwards it prints errors as before, for other code of the process such as h5py.
class SilentErrors {
 public:
  SilentErrors() {
    H5Eget_auto2(H5E_DEFAULT, &print_, &data_);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  }
  SilentErrors(const SilentErrors&) = delete;
  SilentErrors& operator=(const SilentErrors&) = delete;
  ~SilentErrors() { H5Eset_auto2(H5E_DEFAULT, print_, data_); }

 private:
  H5E_auto2_t print_ = nullptr;
  void* data_ = nullptr;
};

/// The cause of the last error of the C library: the message of the operating system, such as "No
/// space left on device", or otherwise the message of the library.
std::string cause_of_error() {
  std::string cause;  // the walk begins at the innermost function that failed
  H5Ewalk2(
      H5E_DEFAULT, H5E_WALK_UPWARD,
      [](unsigned, const H5E_error2_t* error, void* text) -> herr_t {
        auto& first = *static_cast<std::string*>(text);
        if (first.empty() && error->desc != nullptr) first = error->desc;
        return 0;
      },
      &cause);
  return std::string(between(cause, "error message = '", "'").value_or(cause));
}

/// Returns `result`, a return value of the C library. Throws Error(kBadInput) with the name of the
/// file and the cause if it is an error (< 0).
template <class Result>
Result checked(Result result, const fs::path& file) {
  if (result < 0) throw_bad_input({file.string()}, "cannot be written ({})", cause_of_error());
  return result;
}

/// An object of the C library. Its data must have been flushed before the destructor, which ignores
/// errors.
class Handle {
 public:
  /// `closing` is the function that closes the object `id`. Throws as checked() does.
  Handle(hid_t id, herr_t (*closing)(hid_t), const fs::path& file)
      : id_(checked(id, file)), close_(closing) {}
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  Handle& operator=(Handle&&) = delete;
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  void close(const fs::path& file) { checked(close_(std::exchange(id_, -1)), file); }
  operator hid_t() const { return id_; }  // NOLINT: the C library takes it

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

template <class Number>
hid_t type_of() {
  if constexpr (std::is_same_v<Number, double>)
    return H5T_NATIVE_DOUBLE;
  else if constexpr (std::is_same_v<Number, std::int32_t>)
    return H5T_NATIVE_INT32;
  else
    return H5T_NATIVE_INT64;
}

/// A data set with rows of `columns` numbers each (1 to 8192), to which rows are appended.
template <class Number>
class Rows {
 public:
  Rows(hid_t group, const std::string& name, std::size_t columns, fs::path file)
      : file_(std::move(file)), columns_(columns), set_(create(group, name)) {}

  void append(const std::vector<Number>& numbers) {
    assert(numbers.size() % columns_ == 0);
    const hsize_t count = numbers.size() / columns_;
    if (count == 0) return;
    const std::array<hsize_t, 2> begin = {rows_, 0}, part = {count, columns_};
    rows_ += count;
    const std::array<hsize_t, 2> all = {rows_, columns_};
    checked(H5Dset_extent(set_, all.data()), file_);
    const Handle space(H5Dget_space(set_), H5Sclose, file_);
    checked(H5Sselect_hyperslab(space, H5S_SELECT_SET, begin.data(), nullptr, part.data(), nullptr),
            file_);
    const Handle memory(H5Screate_simple(rank(), part.data(), nullptr), H5Sclose, file_);
    checked(H5Dwrite(set_, type_of<Number>(), memory, space, H5P_DEFAULT, numbers.data()), file_);
  }

 private:
  int rank() const { return columns_ == 1 ? 1 : 2; }
  Handle create(hid_t group, const std::string& name) {
    assert(columns_ >= 1 && columns_ <= 8192);
    const std::array<hsize_t, 2> none = {0, columns_}, most = {H5S_UNLIMITED, columns_};
    const Handle space(H5Screate_simple(rank(), none.data(), most.data()), H5Sclose, file_);
    const Handle properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, file_);
    // Chunks of 64 kB (32 kB of whole numbers) are read fast, and small files stay small.
    const std::array<hsize_t, 2> chunk = {8192 / columns_, columns_};
    checked(H5Pset_chunk(properties, rank(), chunk.data()), file_);
    checked(H5Pset_shuffle(properties), file_);
    checked(H5Pset_deflate(properties, 4), file_);
    return {H5Dcreate2(group, name.c_str(), type_of<Number>(), space, H5P_DEFAULT, properties,
                       H5P_DEFAULT),
            H5Dclose, file_};
  }

  fs::path file_;
  std::size_t columns_;
  hsize_t rows_ = 0;
  Handle set_;
};

void add_text(hid_t object, const char* name, const std::string& text, const fs::path& file) {
  const Handle type(H5Tcopy(H5T_C_S1), H5Tclose, file);
  checked(H5Tset_size(type, H5T_VARIABLE), file);  // h5py then gives str in place of bytes
  checked(H5Tset_cset(type, H5T_CSET_UTF8), file);
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose, file);
  const Handle attribute(H5Acreate2(object, name, type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose,
                         file);
  const char* const begin = text.c_str();
  checked(H5Awrite(attribute, type, &begin), file);
}

/// An array has a section and a name in a frame, and a name and number of columns in the HDF5 file.
struct Array {
  std::string_view section, name;
  std::string target;
  std::size_t columns;
};

/// Only arrays that the last frame has are copied: an earlier one may lack the masses that a source
/// adds.
template <class Number>
class Arrays {
 public:
  Arrays(const std::vector<Array>& all, const VtkReader& last, hid_t group, const fs::path& file) {
    for (const auto& array : all)
      if (last.has_array(array.section, array.name))
        arrays_.emplace_back(array, Rows<Number>(group, array.target, array.columns, file));
  }
  /// An array that the frame lacks has zeros. Throws Error(kBadInput) for other than `count` rows.
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

/// A group with the rows of the particles, or of the contacts, of all frames. Its data set `begin`
/// has the number of the first row of each frame, and last the number of all rows.
class Table {
 public:
  Table(hid_t file_id, const char* name, const std::vector<Array>& decimal,
        const std::vector<Array>& whole, const VtkReader& last, const fs::path& file)
      : group_(H5Gcreate2(file_id, name, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose, file),
        decimal_(decimal, last, group_, file),
        whole_(whole, last, group_, file),
        begins_(group_, "begin", 1, file) {
    begins_.append({0});
  }
  void append(const VtkReader& frame, std::size_t count) {
    decimal_.append(frame, count);
    whole_.append(frame, count);
    end_ += static_cast<std::int64_t>(count);
    begins_.append({end_});
  }

 private:
  Handle group_;
  Arrays<double> decimal_;
  Arrays<std::int32_t> whole_;
  Rows<std::int64_t> begins_;
  std::int64_t end_ = 0;
};

std::vector<Array> arrays_of_contacts() {
  std::vector<Array> arrays = {{"CellData", "gap", "gap", 1},
                               {"CellData", "gamma", "gamma", 1},
                               {"CellData", "normal_force", "normal_force", 1},
                               {"CellData", "tangential_force", "tangential_force", 3}};
  for (const auto& field : kMemoryFields)
    if (field.is_shown) arrays.push_back({"CellData", field.name, std::string(field.name), 1});
  arrays.push_back({"CellData", "solid_force", "solid_force", 1});
  return arrays;
}

/// Copies the frames into the new file `id`, and flushes it. `file` is its name in messages. Throws
/// Error(kBadInput) if there is no frame, or if a frame cannot be read.
void copy_frames(const ParticlesCase& c, const fs::path& folder, hid_t id, const fs::path& file) {
  const auto frames = read_pvd(folder / "particles.pvd");
  if (frames.empty()) throw_bad_input({(folder / "particles.pvd").string()}, "has no frame");
  const auto last_text = read_file(folder / frames.back().second);
  const VtkReader last(last_text, (folder / frames.back().second).string(), "frame");
  const bool is_flat = c.particles.dimension < 3;  // then the angular velocity is one number
  Rows<double> times(id, "time", 1, file);
  Table particles(id, "particles",
                  {{"Points", "Points", "position", 3},
                   {"PointData", "velocity", "velocity", 3},
                   {"PointData", "radius", "radius", 1},
                   {"PointData", "mass", "mass", 1},
                   {"PointData", "angle", "angle", 1},
                   {"PointData", "orientation", "orientation", 4},
                   {"PointData", "angular_velocity", "angular_velocity", is_flat ? 1U : 3U}},
                  {{"PointData", "id", "id", 1}, {"PointData", "body", "body", 1}}, last, file);
  Table contacts(id, "contacts", arrays_of_contacts(),
                 {{"CellData", "i", "first", 1},
                  {"CellData", "j", "second", 1},
                  {"CellData", "image", "image", 1},
                  {"CellData", "friction", "friction", 1}},
                 last, file);
  for (const auto& [time, name] : frames) {
    const auto text = read_file(folder / name);
    const VtkReader frame(text, (folder / name).string(), "frame");
    times.append({time});
    particles.append(frame, frame.array<double>("PointData", "radius").size());
    contacts.append(frame, frame.array<double>("CellData", "gap").size());
  }
  checked(H5Fflush(id, H5F_SCOPE_GLOBAL), file);
}

}  // namespace

void require_hdf5() {}

void write_hdf5(const ParticlesCase& c, const fs::path& folder,
                const results::Provenance& provenance) {
  // After an error of writing, version 1.10 of the library crashes when it closes the file again at
  // the end of the process. A file that was closed without an error needs nothing at the end.
  H5dont_atexit();
  const SilentErrors silent;
  const fs::path file = folder / "particles.h5";
  const auto made = results::output_text(file, TextKind::kHashComment, "", provenance);
  write_file_by(file, [&](const fs::path& place) {
    Handle id(H5Fcreate(place.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), H5Fclose, file);
    add_text(id, "provenance", made, file);
    add_text(id, "title", c.title, file);
    copy_frames(c, folder, id, file);
    id.close(file);
  });
}

}  // namespace viscontact::particles

#else

namespace viscontact::particles {

void require_hdf5() {
  throw Error(ErrorKind::kWrongUsage,
              "--hdf5 needs libhdf5, and this program was built without it; install libhdf5-dev "
              "and build the program again");
}

void write_hdf5(const ParticlesCase&, const std::filesystem::path&, const results::Provenance&) {
  require_hdf5();
}

}  // namespace viscontact::particles

#endif
