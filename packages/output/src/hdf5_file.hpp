#pragma once

#include <culm/output/file_identity.hpp>

#include "content_sum.hpp"
#include "hdf5_handle.hpp"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace culm::output {

/// Lengths of a dataset, slowest index first.
using Shape = std::vector<hsize_t>;

/// An HDF5 file with the few things we put into one or read from one. Every failure throws
/// FileError with the path and HDF5's innermost reason. `where` is the file or a group of it.
class Hdf5File {
 public:
  /// Creates a file, replacing one of this name.
  static Hdf5File create(const std::filesystem::path& path);
  /// Opens an existing file for reading, after recover().
  static Hdf5File open(const std::filesystem::path& path);
  hid_t id() const { return file_.id(); }
  const std::filesystem::path& path() const { return path_; }

  /// Completes what a killed process left undone in a file. Returns whether that was needed.
  static bool recover(const std::filesystem::path& path);

  /// Gives the open file its final name. From then on each flush takes effect as a whole or, if the
  /// process is killed, not at all; see JournaledFile.
  void move_to(const std::filesystem::path& path);
  /// Hands everything written so far to the operating system. Throws FileError also if somebody
  /// removed or replaced the file, once it has its final name.
  void flush();
  void close();

  Handle make_group(hid_t where, const std::string& name);
  void remove_if_present(hid_t where, const std::string& name);

  void write(hid_t where, const std::string& name, std::span<const double> values,
             const Shape& shape);
  void write(hid_t where, const std::string& name, std::span<const int> values);
  void write(hid_t where, const std::string& name, const std::string& text);
  /// A table of doubles, which come by fill(), or from other processes into its room.
  Handle make_table(hid_t where, const std::string& name, const Shape& shape);
  /// Where the numbers of such a table begin in the file [bytes], if others can write there until
  /// the next flush; not where that would overwrite what counts today.
  std::optional<std::uint64_t> room_of(const Handle& table) const;
  void fill(const Handle& table, std::span<const double> values);
  /// Adds a table to the sum. @param sum  of its numbers, by sum_of_numbers()
  void add_to_sum(const std::string& name, const Shape& shape, std::uint64_t sum) {
    sum_.add_dataset(name, shape, sum);
  }
  /// An empty table of doubles that grows by append_rows().
  Handle make_growing_table(hid_t where, const std::string& name, hsize_t columns);
  /// @param first   number of rows so far
  /// @param values  row after row
  void append_rows(hid_t table, hsize_t first, hsize_t columns, std::span<const double> values);

  void set_attribute(hid_t where, const std::string& name, double value);
  void set_attribute(hid_t where, const std::string& name, int value);
  void set_attribute(hid_t where, const std::string& name, const std::string& text);
  void set_attribute(hid_t where, const std::string& name, std::span<const std::string> texts);

  /// The sum of all that was written since this was last asked for, rows of tables that grow and
  /// tables that others fill excepted.
  /// @see sum_of_group
  std::uint64_t take_sum() { return std::exchange(sum_, {}).value(); }

  /// Returns an identifier or status unchanged, or throws FileError: cannot `action`.
  template <class T>
  T check(T status, std::string_view action) const {
    if (status < 0) fail(action);
    return status;
  }

 private:
  Hdf5File(std::filesystem::path path, Handle file);

  [[noreturn]] void fail(std::string_view action) const;
  void start_journal();
  Handle make_dataset(hid_t where, const std::string& name, hid_t type, const Shape& shape,
                      hid_t creation = H5P_DEFAULT);
  void write_attribute(hid_t where, const std::string& name, hid_t type, hid_t space,
                       const void* data);
  Handle text_type() const;
  Handle simple_space(const Shape& shape) const;

  std::filesystem::path path_;
  std::optional<FileIdentity> identity_;  // of a file that grows under its final name
  Handle file_;
  Handle group_creation_;  // how groups are made
  ContentSum sum_;
};

}  // namespace culm::output
