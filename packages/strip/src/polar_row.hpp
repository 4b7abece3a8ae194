/// Rows of polars, and files that hold them.
#pragma once

#include <culm/base/issue.hpp>
#include <culm/strip/airfoil.hpp>

#include <string>
#include <vector>

namespace culm::strip {

struct PolarRow {
  double alpha = 0.0;  ///< [rad]
  Coefficients coefficients = Coefficients::Zero();
};

/// The table of a file of an airfoil for AeroDyn, without a moment where there is no column for it.
/// Throws FileError, or InputError for a file with several tables or a line that is not one of
/// them.
/// @param where  the place of the name in the deck, to whose folder it is relative
/// @param path   of the file
std::vector<PolarRow> read_aerodyn_polar(const std::string& name, const Where& where,
                                         std::string& path);

}  // namespace culm::strip
