/// What a station of a strip feels in a step.
#pragma once

#include <culm/strip/strip_load.hpp>

#include "section_map.hpp"

namespace culm::strip {

/// Forces of a station, and how they change.
struct StripLoad::Evaluation {
  Columns forces = Columns::Zero();          // on axis, chord and normal [N]
  Mat<9, 9> derivative = Mat<9, 9>::Zero();  // by those at the end of the step
  StationEnd end;
};

}  // namespace culm::strip
