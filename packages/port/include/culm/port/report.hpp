/// What a port looks like, in words.
#pragma once

#include <culm/model/model.hpp>
#include <culm/port/port.hpp>

#include <string>
#include <vector>

namespace culm::port {

/// How many points lie on which structures, how far away and past their ends, and how many nodes of
/// these structures no point moves with. One line without full stop.
std::string describe(const Port& port, const model::Model& model);

/// What may be wrong with it, each with a count and the first point of its kind: points about as
/// near to another place, and points where cross-sections overlap.
std::vector<std::string> doubts(const Port& port, const model::Model& model);

}  // namespace culm::port
