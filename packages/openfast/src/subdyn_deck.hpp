/// A deck from SubDyn's file.
#pragma once

#include <culm/openfast/report.hpp>
#include <culm/openfast/subdyn.hpp>

#include <string>

namespace culm::openfast {

/// The members as beams, joined rigidly or by joints, under their weight, and their modes.
std::string write_deck(const SubDyn& sub, Report& report);

}  // namespace culm::openfast
