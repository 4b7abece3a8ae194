#include "journal_driver.hpp"

#include <algorithm>
#include <exception>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>

namespace culm::output {

namespace {

// HDF5 allocates by moving the end of addresses (eoa) and owns the base part.
struct DriverFile : H5FD_t {
  DriverFile(const char* name, JournaledFile::Mode mode) : H5FD_t{}, file(name, mode) {}
  JournaledFile file;
  haddr_t eoa = 0;
};

DriverFile& self(H5FD_t* file) { return *static_cast<DriverFile*>(file); }
const DriverFile& self(const H5FD_t* file) { return *static_cast<const DriverFile*>(file); }

// HDF5 is C: errors cross it on its error stack.
template <class Action>
herr_t guarded(const char* function, Action action) {
  try {
    action();
    return 0;
  } catch (const std::exception& error) {
    H5Epush2(H5E_DEFAULT, __FILE__, function, __LINE__, H5E_ERR_CLS, H5E_VFL, H5E_WRITEERROR, "%s",
             error.what());
    return -1;
  }
}

// HDF5 cannot close a file whose last bytes it cannot write, and crashes for that at the end of the
// program. So a failure is kept for the next flush, and the content stays that of the last commit.
template <class Action>
herr_t write_once(H5FD_t* file, Action action) {
  DriverFile& f = self(file);
  if (!f.file.failure().empty()) return 0;
  try {
    action(f.file);
  } catch (const std::exception& error) {
    f.file.set_failure(error.what());
  }
  return 0;
}

H5FD_t* open_driver(const char* name, unsigned flags, hid_t, haddr_t) {
  const bool is_new = (flags & (H5F_ACC_CREAT | H5F_ACC_TRUNC)) != 0;
  const auto mode = is_new ? JournaledFile::Mode::create : JournaledFile::Mode::existing;
  std::unique_ptr<DriverFile> file;
  guarded("open_driver", [&] { file = std::make_unique<DriverFile>(name, mode); });
  return file.release();
}

herr_t close_driver(H5FD_t* file) {
  const std::unique_ptr<DriverFile> owned(&self(file));
  return write_once(file, [](JournaledFile& f) { f.commit(); });
}

herr_t query(const H5FD_t*, unsigned long* flags) {
  if (flags != nullptr) {
    *flags = H5FD_FEAT_AGGREGATE_METADATA | H5FD_FEAT_ACCUMULATE_METADATA | H5FD_FEAT_DATA_SIEVE |
             H5FD_FEAT_AGGREGATE_SMALLDATA;
  }
  return 0;
}

haddr_t get_eoa(const H5FD_t* file, H5FD_mem_t) { return self(file).eoa; }

herr_t set_eoa(H5FD_t* file, H5FD_mem_t, haddr_t address) {
  self(file).eoa = address;
  return 0;
}

haddr_t get_eof(const H5FD_t* file, H5FD_mem_t) { return self(file).file.size(); }

herr_t get_handle(H5FD_t* file, hid_t, void** handle) {
  *handle = &self(file).file;
  return 0;
}

herr_t read(H5FD_t* file, H5FD_mem_t, hid_t, haddr_t address, size_t size, void* buffer) {
  return guarded("read", [&] {
    self(file).file.read(address, std::span(static_cast<std::byte*>(buffer), size));
  });
}

herr_t write(H5FD_t* file, H5FD_mem_t, hid_t, haddr_t address, size_t size, const void* buffer) {
  return write_once(file, [&](JournaledFile& f) {
    f.write(address, std::span(static_cast<const std::byte*>(buffer), size));
  });
}

herr_t flush(H5FD_t* file, hid_t, hbool_t closing) {
  write_once(file, [](JournaledFile& f) { f.commit(); });
  const std::string& failure = self(file).file.failure();
  if (closing || failure.empty()) return 0;
  return guarded("flush", [&] { throw std::runtime_error(failure); });
}

herr_t truncate(H5FD_t* file, hid_t, hbool_t) {
  return write_once(file, [&](JournaledFile& f) { f.resize(self(file).eoa); });
}

H5FD_class_t make_driver_class() {
  H5FD_class_t driver{};
  driver.name = "culm_journal";
  driver.maxaddr = (haddr_t{1} << 62) - 1;
  driver.fc_degree = H5F_CLOSE_WEAK;
  driver.open = open_driver;
  driver.close = close_driver;
  driver.query = query;
  driver.get_eoa = get_eoa;
  driver.set_eoa = set_eoa;
  driver.get_eof = get_eof;
  driver.get_handle = get_handle;
  driver.read = read;
  driver.write = write;
  driver.flush = flush;
  driver.truncate = truncate;
  const H5FD_mem_t map[H5FD_MEM_NTYPES] = H5FD_FLMAP_DICHOTOMY;
  std::copy(std::begin(map), std::end(map), driver.fl_map);
  return driver;
}

}  // namespace

herr_t use_journal_driver(hid_t access_properties) {
  // HDF5 keeps a pointer to the class, so it must outlive all files.
  static const H5FD_class_t driver_class = make_driver_class();
  static const hid_t driver = H5FDregister(&driver_class);
  return driver < 0 ? -1 : H5Pset_driver(access_properties, driver, nullptr);
}

JournaledFile* journaled_file(hid_t file) {
  void* handle = nullptr;
  return H5Fget_vfd_handle(file, H5P_DEFAULT, &handle) < 0 ? nullptr
                                                           : static_cast<JournaledFile*>(handle);
}

}  // namespace culm::output
