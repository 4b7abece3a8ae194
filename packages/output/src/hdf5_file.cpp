#include "hdf5_file.hpp"

#include <culm/base/error.hpp>
#include <culm/base/read_file.hpp>
#include <culm/output/checksum.hpp>

#include "journal_driver.hpp"
#include "replace_file.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <system_error>

namespace culm::output {

namespace {

herr_t keep_first(unsigned number, const H5E_error2_t* entry, void* text) {
  if (number == 0) *static_cast<std::string*>(text) = entry->desc != nullptr ? entry->desc : "";
  return 0;
}

// Walking upward starts where the error arose, which is what helps a user: "errno = 28, ...".
std::string innermost_error() {
  std::string reason;
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, keep_first, &reason);
  return reason.empty() ? "HDF5 gives no reason" : reason;
}

[[noreturn]] void throw_file_error(const std::filesystem::path& path, std::string_view action) {
  throw FileError(path.string(), fmt::format("cannot {}: {}", action, innermost_error()));
}

// H5Fflush walks over everything in the metadata cache, clean or not. The default cache grows to
// 32 MB, which makes a flush take milliseconds; this one keeps it at some microseconds.
void limit_cache(const std::filesystem::path& path, hid_t access) {
  constexpr std::size_t size = 128 * 1024;
  H5AC_cache_config_t config;
  config.version = H5AC__CURR_CACHE_CONFIG_VERSION;
  bool done = H5Pget_mdc_config(access, &config) >= 0;
  config.set_initial_size = true;
  config.initial_size = size;
  config.min_size = size;
  config.max_size = size;
  config.incr_mode = H5C_incr__off;
  config.flash_incr_mode = H5C_flash_incr__off;
  config.decr_mode = H5C_decr__off;
  done = done && H5Pset_mdc_config(access, &config) >= 0;
  if (!done) throw_file_error(path, "set up the metadata cache");
}

}  // namespace

Hdf5File::Hdf5File(std::filesystem::path path, Handle file)
    : path_(std::move(path)),
      file_(std::move(file)),
      group_creation_(H5Pcreate(H5P_GROUP_CREATE), H5Pclose) {
  // What a structure has stands in the header of its group. Beyond 8 links or attributes HDF5 would
  // make a heap and a tree for them, of some kB.
  constexpr unsigned in_header = 32;
  const hid_t group = group_creation_.id();
  check(H5Pset_link_phase_change(group, in_header, in_header - 2), "make groups");
  check(H5Pset_attr_phase_change(group, in_header, in_header - 2), "make groups");
}

Hdf5File Hdf5File::create(const std::filesystem::path& path) {
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  // From this format on HDF5 guards its own tables with checksums; without them it reads what is
  // damaged as it is, and may write beyond its memory. The next one marks files as open, so that
  // nobody can read them after a kill.
  if (use_journal_driver(access.id()) < 0 ||
      H5Pset_libver_bounds(access.id(), H5F_LIBVER_V18, H5F_LIBVER_V18) < 0) {
    throw_file_error(path, "set file access");
  }
  limit_cache(path, access.id());
  Handle file(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access.id()), H5Fclose);
  if (!file.is_open()) throw_file_error(path, "create file");
  return {path, std::move(file)};
}

Hdf5File Hdf5File::open(const std::filesystem::path& path) {
  const std::string objection = file_objection(path);
  if (!objection.empty()) throw FileError(path.string(), objection);
  recover(path);
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  if (H5Pset_file_locking(access.id(), false, true) < 0) throw_file_error(path, "set file access");
  Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, access.id()), H5Fclose);
  if (!file.is_open()) throw_file_error(path, "open file");
  return {path, std::move(file)};
}

void Hdf5File::fail(std::string_view action) const {
  // after a write that failed HDF5 stumbles over what it does not find in the file
  const JournaledFile* const file = file_.is_open() ? journaled_file(file_.id()) : nullptr;
  if (file != nullptr && !file->failure().empty()) {
    throw FileError(path_.string(), "cannot write file: " + file->failure());
  }
  throw_file_error(path_, action);
}

void Hdf5File::move_to(const std::filesystem::path& path) {
  // The journal of an older file must not be taken for ours.
  std::error_code error;
  std::filesystem::remove(JournaledFile::journal_path(path), error);
  move_into_place(path_, path);
  path_ = path;
  identity_.emplace(path);
  start_journal();
}

void Hdf5File::start_journal() {
  JournaledFile* const file = journaled_file(file_.id());
  if (file == nullptr) fail("start journal");
  try {
    file->start_journal(path_);
  } catch (const std::system_error& reason) {
    throw FileError(path_.string(), fmt::format("cannot start journal: {}", reason.what()));
  }
}

bool Hdf5File::recover(const std::filesystem::path& path) {
  try {
    return JournaledFile::recover(path);
  } catch (const std::system_error& reason) {
    throw FileError(path.string(), fmt::format("cannot recover: {}", reason.what()));
  }
}

void Hdf5File::flush() {
  check(H5Fflush(file_.id(), H5F_SCOPE_GLOBAL), "write file");
  if (identity_) identity_->check(path_);
}

void Hdf5File::close() {
  flush();  // which reports what could not be written; closing does not
  check(file_.close(), "close file");
}

Handle Hdf5File::make_group(hid_t where, const std::string& name) {
  sum_.add_group(name);
  return {check(H5Gcreate2(where, name.c_str(), H5P_DEFAULT, group_creation_.id(), H5P_DEFAULT),
                "create group " + name),
          H5Gclose};
}

void Hdf5File::remove_if_present(hid_t where, const std::string& name) {
  if (check(H5Lexists(where, name.c_str(), H5P_DEFAULT), "look for " + name) > 0) {
    check(H5Ldelete(where, name.c_str(), H5P_DEFAULT), "remove " + name);
  }
}

Handle Hdf5File::text_type() const {
  Handle type(check(H5Tcopy(H5T_C_S1), "make text type"), H5Tclose);
  check(H5Tset_size(type.id(), H5T_VARIABLE), "make text type");
  check(H5Tset_cset(type.id(), H5T_CSET_UTF8), "make text type");
  return type;
}

Handle Hdf5File::simple_space(const Shape& shape) const {
  return {check(H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr),
                "make data space"),
          H5Sclose};
}

Handle Hdf5File::make_dataset(hid_t where, const std::string& name, hid_t type, const Shape& shape,
                              hid_t creation) {
  const Handle space = shape.empty()
                           ? Handle(check(H5Screate(H5S_SCALAR), "make data space"), H5Sclose)
                           : simple_space(shape);
  return {
      check(H5Dcreate2(where, name.c_str(), type, space.id(), H5P_DEFAULT, creation, H5P_DEFAULT),
            "create dataset " + name),
      H5Dclose};
}

void Hdf5File::write(hid_t where, const std::string& name, std::span<const double> values,
                     const Shape& shape) {
  add_to_sum(name, shape, sum_of_numbers(values));
  fill(make_dataset(where, name, H5T_IEEE_F64LE, shape), values);
}

Handle Hdf5File::make_table(hid_t where, const std::string& name, const Shape& shape) {
  const Handle creation(check(H5Pcreate(H5P_DATASET_CREATE), "make dataset"), H5Pclose);
  check(H5Pset_alloc_time(creation.id(), H5D_ALLOC_TIME_EARLY), "make dataset");
  check(H5Pset_fill_time(creation.id(), H5D_FILL_TIME_NEVER), "make dataset");
  return make_dataset(where, name, H5T_IEEE_F64LE, shape, creation.id());
}

std::optional<std::uint64_t> Hdf5File::room_of(const Handle& table) const {
  const haddr_t place = H5Dget_offset(table.id());
  JournaledFile* const file = journaled_file(file_.id());
  if (place == HADDR_UNDEF || file == nullptr || place < file->committed_size()) return {};
  try {
    // a full disk is found here, and not by one of those who write
    file->reserve(place, H5Dget_storage_size(table.id()));
  } catch (const std::system_error& reason) {
    throw FileError(path_.string(), fmt::format("cannot write file: {}", reason.what()));
  }
  return place;
}

void Hdf5File::fill(const Handle& table, std::span<const double> values) {
  check(H5Dwrite(table.id(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()),
        "write dataset");
}

void Hdf5File::write(hid_t where, const std::string& name, std::span<const int> values) {
  const Shape shape{values.size()};
  sum_.add_dataset(name, shape, values);
  const Handle dataset = make_dataset(where, name, H5T_STD_I32LE, shape);
  check(H5Dwrite(dataset.id(), H5T_NATIVE_INT, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()),
        "write dataset " + name);
}

void Hdf5File::write(hid_t where, const std::string& name, const std::string& text) {
  const Handle type = text_type();
  const Handle dataset = make_dataset(where, name, type.id(), {});
  // A text is converted: by default in buffers of 1 MB, which are filled with zeros first.
  const Handle transfer(check(H5Pcreate(H5P_DATASET_XFER), "write text"), H5Pclose);
  constexpr std::size_t enough = 1024;
  check(H5Pset_buffer(transfer.id(), enough, nullptr, nullptr), "write text");
  const char* const data = text.c_str();
  check(H5Dwrite(dataset.id(), type.id(), H5S_ALL, H5S_ALL, transfer.id(), &data),
        "write dataset " + name);
}

Handle Hdf5File::make_growing_table(hid_t where, const std::string& name, hsize_t columns) {
  // Each flush writes the last chunk again, so chunks are small: 1024 numbers, 8 kB.
  const std::array<hsize_t, 2> chunk{std::max<hsize_t>(1, 1024 / columns), columns};
  const std::array<hsize_t, 2> start{0, columns};
  const std::array<hsize_t, 2> limit{H5S_UNLIMITED, columns};
  const Handle space(check(H5Screate_simple(2, start.data(), limit.data()), "make data space"),
                     H5Sclose);
  const Handle creation(check(H5Pcreate(H5P_DATASET_CREATE), "make dataset"), H5Pclose);
  check(H5Pset_chunk(creation.id(), 2, chunk.data()), "make dataset");
  return {check(H5Dcreate2(where, name.c_str(), H5T_IEEE_F64LE, space.id(), H5P_DEFAULT,
                           creation.id(), H5P_DEFAULT),
                "create dataset " + name),
          H5Dclose};
}

void Hdf5File::append_rows(hid_t table, hsize_t first, hsize_t columns,
                           std::span<const double> values) {
  const std::array<hsize_t, 2> count{values.size() / columns, columns};
  const std::array<hsize_t, 2> size{first + count[0], columns};
  check(H5Dset_extent(table, size.data()), "extend table");
  const Handle file_space(check(H5Dget_space(table), "extend table"), H5Sclose);
  const std::array<hsize_t, 2> start{first, 0};
  check(H5Sselect_hyperslab(file_space.id(), H5S_SELECT_SET, start.data(), nullptr, count.data(),
                            nullptr),
        "extend table");
  const Handle rows_space = simple_space({count[0], count[1]});
  check(H5Dwrite(table, H5T_NATIVE_DOUBLE, rows_space.id(), file_space.id(), H5P_DEFAULT,
                 values.data()),
        "write table rows");
}

void Hdf5File::write_attribute(hid_t where, const std::string& name, hid_t type, hid_t space,
                               const void* data) {
  const Handle attribute(
      check(H5Acreate2(where, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT),
            "create attribute " + name),
      H5Aclose);
  // An empty list has no data, and HDF5 refuses to write none.
  if (data != nullptr) check(H5Awrite(attribute.id(), type, data), "write attribute " + name);
}

void Hdf5File::set_attribute(hid_t where, const std::string& name, double value) {
  sum_.add_attribute(name, std::as_bytes(std::span(&value, 1)));
  const Handle space(check(H5Screate(H5S_SCALAR), "make data space"), H5Sclose);
  write_attribute(where, name, H5T_NATIVE_DOUBLE, space.id(), &value);
}

void Hdf5File::set_attribute(hid_t where, const std::string& name, int value) {
  sum_.add_attribute(name, std::as_bytes(std::span(&value, 1)));
  const Handle space(check(H5Screate(H5S_SCALAR), "make data space"), H5Sclose);
  write_attribute(where, name, H5T_NATIVE_INT, space.id(), &value);
}

void Hdf5File::set_attribute(hid_t where, const std::string& name, const std::string& text) {
  const std::string content = joined(std::span(&text, 1));
  sum_.add_attribute(name, std::as_bytes(std::span(content)));
  const Handle space(check(H5Screate(H5S_SCALAR), "make data space"), H5Sclose);
  const char* const data = text.c_str();
  write_attribute(where, name, text_type().id(), space.id(), &data);
}

void Hdf5File::set_attribute(hid_t where, const std::string& name,
                             std::span<const std::string> texts) {
  const std::string content = joined(texts);
  sum_.add_attribute(name, std::as_bytes(std::span(content)));
  std::vector<const char*> data;
  for (const std::string& text : texts) data.push_back(text.c_str());
  write_attribute(where, name, text_type().id(), simple_space({texts.size()}).id(), data.data());
}

}  // namespace culm::output
