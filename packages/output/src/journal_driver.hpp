#pragma once

#include "journaled_file.hpp"

#include <hdf5.h>

#include <filesystem>

namespace culm::output {

/// Lets HDF5 write through a JournaledFile: H5Fflush becomes a commit. For writing.
/// Returns a negative value if HDF5 refuses.
herr_t use_journal_driver(hid_t access_properties);

/// The file behind an HDF5 file that was created with that driver; null if there is none.
JournaledFile* journaled_file(hid_t file);

}  // namespace culm::output
