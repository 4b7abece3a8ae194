/// Imports of files of SubDyn, HydroDyn, SeaState and MoorDyn by themselves.
#pragma once

#include <culm/openfast/input_file.hpp>
#include <culm/openfast/report.hpp>

#include <optional>
#include <string>

namespace culm::openfast {

/// The deck of such a file, recognised by what it contains; nothing if it is another one. Throws
/// InputError, FileError.
std::optional<std::string> import_offshore(const InputFile& file, Report& report);

}  // namespace culm::openfast
