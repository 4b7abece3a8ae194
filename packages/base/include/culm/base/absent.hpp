#pragma once

namespace culm {

/// Stands in tables for a number that does not exist in its row, such as the force of a load that
/// does not act: netCDF's fill value for doubles, which no result has. Files say so: an empty cell
/// in text, attribute _FillValue in HDF5.
inline constexpr double absent = 9.9692099683868690e+36;

}  // namespace culm
