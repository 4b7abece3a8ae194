/// Shapes that an analysis left in the result file of a run.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace culm::output {

/// A mode or buckling shape: per structure six numbers for each of its nodes, displacement and
/// rotation vector, of a shell node the change of its director; up to a common factor.
using RecordedShape = std::map<std::string, std::vector<double>>;

/// Reads the real part of a shape.
/// @param path    run.h5, or the folder of it
/// @param number  of the shape, from 1
/// Throws FileError if the file cannot be read, has no such analysis or shape, or holds other
/// results of the analysis than were written.
RecordedShape find_recorded_shape(const std::filesystem::path& path, const std::string& analysis,
                                  int number);

}  // namespace culm::output
