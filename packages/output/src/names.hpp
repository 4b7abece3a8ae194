/// Names of structures and quantities as parts of other texts.
#pragma once

#include <culm/output/file_part.hpp>

#include <string>
#include <string_view>

namespace culm::output {

/// The name of an HDF5 group or dataset. Characters with a meaning in HDF5 or XDMF paths are
/// written as %XX; two different names stay different.
std::string link_name(std::string_view name);

/// Text between XML tags or within XML quotes.
std::string xml_escape(std::string_view text);

/// Name of the group of a step below /steps.
std::string step_name(int index);

}  // namespace culm::output
