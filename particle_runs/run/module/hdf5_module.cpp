// The module hdf5: Hdf5File with libhdf5. Each call of the C library whose failure can lose data
// must be in checked().
#include "viscontact/particle_runs/run/module/hdf5_module.hpp"

#include <hdf5.h>

#include <array>
#include <cassert>
#include <string_view>
#include <utility>
#include <vector>

#include "viscontact/common/error.hpp"
#include "viscontact/common/vtk/vtk_xml.hpp"

namespace viscontact::particles {
namespace {

namespace fs = std::filesystem;

/// While an object of this class exists, the C library prints no errors, because the code of this
/// file throws them. Afterwards the library prints errors as it did before, because other code of
/// the process may rely on that, such as h5py beside the Python module.
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

/// Returns `result`. Throws Error(kBadInput) with the name of the file if `result`, a return value
/// of the C library, is an error (< 0).
template <class Result>
Result checked(Result result, const fs::path& file) {
  if (result < 0) throw_bad_input({file.string()}, "cannot be written ({})", cause_of_error());
  return result;
}

/// An object of the C library, which the destructor closes. Its data must have been flushed before,
/// because the destructor ignores errors.
class Handle {
 public:
  /// `closing` is the function of the C library that closes the object `id`. Throws
  /// Error(kBadInput), which names `file`, if `id` is an error.
  Handle(hid_t id, herr_t (*closing)(hid_t), const fs::path& file)
      : id_(checked(id, file)), close_(closing) {}
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  Handle& operator=(Handle&&) = delete;
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  /// Closes the object now. Throws Error(kBadInput) if that fails.
  void close(const fs::path& file) { checked(close_(std::exchange(id_, -1)), file); }
  operator hid_t() const { return id_; }  // NOLINT: the C library takes it

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

hid_t type_of(Hdf5Number number) {
  switch (number) {
    case Hdf5Number::kDouble:
      return H5T_NATIVE_DOUBLE;
    case Hdf5Number::kInt32:
      return H5T_NATIVE_INT32;
    case Hdf5Number::kInt64:
      break;
  }
  return H5T_NATIVE_INT64;
}

/// A data set with rows of `columns` numbers each, to which rows are appended.
class Rows {
 public:
  Rows(hid_t place, const std::string& path, Hdf5Number type, std::size_t columns, fs::path file)
      : file_(std::move(file)), type_(type), columns_(columns), set_(create(place, path)) {}

  void append(const void* numbers, hsize_t count) {
    if (count == 0) return;
    const std::array<hsize_t, 2> begin = {rows_, 0}, part = {count, columns_};
    rows_ += count;
    const std::array<hsize_t, 2> all = {rows_, columns_};
    checked(H5Dset_extent(set_, all.data()), file_);
    const Handle space(H5Dget_space(set_), H5Sclose, file_);
    checked(H5Sselect_hyperslab(space, H5S_SELECT_SET, begin.data(), nullptr, part.data(), nullptr),
            file_);
    const Handle memory(H5Screate_simple(rank(), part.data(), nullptr), H5Sclose, file_);
    checked(H5Dwrite(set_, type_of(type_), memory, space, H5P_DEFAULT, numbers), file_);
  }

 private:
  int rank() const { return columns_ == 1 ? 1 : 2; }
  Handle create(hid_t place, const std::string& path) {
    const std::array<hsize_t, 2> none = {0, columns_}, most = {H5S_UNLIMITED, columns_};
    const Handle space(H5Screate_simple(rank(), none.data(), most.data()), H5Sclose, file_);
    const Handle groups(H5Pcreate(H5P_LINK_CREATE), H5Pclose, file_);
    checked(H5Pset_create_intermediate_group(groups, 1), file_);
    const Handle properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, file_);
    // Chunks of 64 kB (32 kB of whole numbers) are read fast, and small files stay small.
    const std::array<hsize_t, 2> chunk = {8192 / columns_, columns_};
    checked(H5Pset_chunk(properties, rank(), chunk.data()), file_);
    checked(H5Pset_shuffle(properties), file_);
    checked(H5Pset_deflate(properties, 4), file_);
    return {H5Dcreate2(place, path.c_str(), type_of(type_), space, groups, properties, H5P_DEFAULT),
            H5Dclose, file_};
  }

  fs::path file_;
  Hdf5Number type_;
  hsize_t columns_;
  hsize_t rows_ = 0;
  Handle set_;
};

class LibraryFile : public Hdf5File {
 public:
  LibraryFile(const fs::path& place, const fs::path& name)
      : name_(name),
        id_(H5Fcreate(place.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), H5Fclose, name) {}

  void add_text(const char* name, const std::string& text) override {
    const Handle type(H5Tcopy(H5T_C_S1), H5Tclose, name_);
    checked(H5Tset_size(type, H5T_VARIABLE), name_);  // h5py then gives str in place of bytes
    checked(H5Tset_cset(type, H5T_CSET_UTF8), name_);
    const Handle space(H5Screate(H5S_SCALAR), H5Sclose, name_);
    const Handle attribute(H5Acreate2(id_, name, type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose,
                           name_);
    const char* const begin = text.c_str();
    checked(H5Awrite(attribute, type, &begin), name_);
  }
  std::size_t add_rows(const std::string& path, Hdf5Number type, std::size_t columns) override {
    assert(columns >= 1 && columns <= 8192);
    sets_.emplace_back(id_, path, type, columns, name_);
    return sets_.size() - 1;
  }
  void append(std::size_t set, const void* numbers, std::size_t rows) override {
    sets_.at(set).append(numbers, rows);
  }
  void close() override {
    checked(H5Fflush(id_, H5F_SCOPE_GLOBAL), name_);
    sets_.clear();
    id_.close(name_);
  }

 private:
  SilentErrors silent_;
  fs::path name_;
  Handle id_;
  std::vector<Rows> sets_;
};

}  // namespace

extern "C" void viscontact_create_hdf5(const fs::path& place, const fs::path& name,
                                       std::unique_ptr<Hdf5File>& file) {
  // After an error of writing, version 1.10 of the library crashes when it closes the file again at
  // the end of the process. A file that was closed without an error needs nothing at the end.
  H5dont_atexit();
  file = std::make_unique<LibraryFile>(place, name);
}

}  // namespace viscontact::particles
