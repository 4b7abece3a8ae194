/// What run.h5 knows of a structure before there are states.
#pragma once

#include <culm/output/picture_mesh.hpp>
#include <culm/output/state_tables.hpp>

#include "hdf5_file.hpp"

namespace culm::output {

/// Makes the group of a structure, as at Recorder. @param number  among the structures, whose
/// fields stand in the tables of states
void write_mesh(Hdf5File& file, hid_t parent, const StructureMesh& mesh, int number,
                const StateTables& tables);

}  // namespace culm::output
