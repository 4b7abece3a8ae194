#pragma once

#include "hdf5_file.hpp"

#include <string>

namespace culm::output {

/// Writes a group of another file with all in it anew, under the same name. HDF5 could copy it as
/// it lies on the disk, but what is damaged there, and is no content, would come along or end the
/// process.
void copy_group(const Hdf5File& from, hid_t group, Hdf5File& to, hid_t where,
                const std::string& name);

}  // namespace culm::output
