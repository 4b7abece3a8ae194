/// Whether a file is whole, for modules whose files end with a line of their own.
#pragma once

#include <culm/openfast/input_file.hpp>
#include <culm/openfast/report.hpp>

namespace culm::openfast {

/// Tells the report where there is no line END: what is behind the place of a cut is not missed
/// otherwise where files of some years do not have it.
void check_end(const InputFile& file, Report& report);

}  // namespace culm::openfast
