// The HDF5 file that the module hdf5 writes with libhdf5.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>

namespace viscontact::particles {

/// Type of the numbers of a data set.
enum class Hdf5Number { kDouble, kInt32, kInt64 };

/// An HDF5 file that is being written. All functions but the destructor throw Error(kBadInput),
/// which names the file and says why, if libhdf5 fails.
class Hdf5File {
 public:
  Hdf5File() = default;
  Hdf5File(const Hdf5File&) = delete;
  Hdf5File& operator=(const Hdf5File&) = delete;
  /// Closes the file. It lacks data if close() was not called before.
  virtual ~Hdf5File() = default;

  /// Adds an attribute of the file.
  virtual void add_text(const char* name, const std::string& text) = 0;
  /// Adds a data set with rows of `columns` numbers each (1 to 8192), for example
  /// "particles/radius". Groups that do not exist are made. Returns the number of the data set, by
  /// which append() knows it.
  virtual std::size_t add_rows(const std::string& path, Hdf5Number type, std::size_t columns) = 0;
  /// Appends `rows` rows to the data set `set`. `numbers` points to numbers of its type.
  virtual void append(std::size_t set, const void* numbers, std::size_t rows) = 0;
  /// Writes all data and closes the file. Nothing may be added afterwards.
  virtual void close() = 0;
};

/// Sets `file` to a new HDF5 file at `place`, which replaces an earlier one. Errors name the file
/// `name`.
extern "C" void viscontact_create_hdf5(const std::filesystem::path& place,
                                       const std::filesystem::path& name,
                                       std::unique_ptr<Hdf5File>& file);

}  // namespace viscontact::particles
