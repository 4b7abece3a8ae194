/// Options of other programs without a place in a deck.
#pragma once

#include <culm/openfast/input_file.hpp>
#include <culm/openfast/report.hpp>

#include <initializer_list>

namespace culm::openfast {

/// An option, the value with which it changes nothing, and what is so whatever it says.
struct LeftOut {
  const char* keyword;
  double neutral;
  const char* instead;
};

/// Tells the report of those that are in the file with another value than the neutral one, to one
/// part in a thousand; "default" is neutral.
void tell_left_out(InputFile& file, std::initializer_list<LeftOut> options, Report& report);

}  // namespace culm::openfast
