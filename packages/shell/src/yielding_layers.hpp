/// Layers of shells that yield.
#pragma once

#include <culm/shell/elastic_shell.hpp>
#include <culm/structure/plastic_batch.hpp>

#include <string>
#include <vector>

namespace culm::shell {

using YieldingShell = structure::YieldingElement<ElasticShell, material::PlaneStressPlasticity>;

/// Whether a layer of a wall yields.
bool yields(const material::Layup& layup);

/// The layers of an element that yield, in plane stress at 2 x 2 points of its surface and those of
/// Simpson's rule across each layer. Enhanced strains follow the forms as in the elastic element,
/// which is what keeps the energy; transverse shear and the strain across the thickness are those
/// of the elastic law.
YieldingShell yielding_shell(int item, const ElasticWall& wall);

/// Lets the elements of a structure yield, if their layers do.
void add_yielding_layers(model::ElementBatch<ElasticShell>& batch, const std::vector<int>& items,
                         const std::string& structure, model::Model& model);

}  // namespace culm::shell
