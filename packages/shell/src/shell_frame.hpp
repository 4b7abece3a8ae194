/// The frame that a linear shell is seen from.
#pragma once

#include <culm/model/model.hpp>

#include <string>
#include <vector>

namespace culm::shell {

/// Adds a triad node without mass that moves along with the nodes of a shell, as structure
/// "NAME frame". It follows some of the nodes, far from one another: it stays at their mean, and
/// its directors are those of their affine motion: of their principal axes m_1, m_2, the two
/// largest, d1 along m_1 and d3 normal to both. Six constraints that are products of slots, hence
/// objective, one for each of its unknowns. So a shell deformed near one node is not seen turned.
/// @param nodes  of the shell, not all on a line
/// @return number of the node
int add_frame(const std::string& shell, const std::vector<int>& nodes, model::Model& model);

}  // namespace culm::shell
