/// Widths that loads of water and soil are told, beside those of the sections.
#pragma once

#include <culm/base/options.hpp>
#include <culm/model/model.hpp>

#include <string>
#include <vector>

namespace culm::simulation {

/// A sentence for each load of an analysis whose diameter is far from the width of the section of
/// its structure, where this has a shape: one of both is likely a radius, or in another unit.
std::vector<std::string> widths_that_differ(const Options& deck, const Options& analysis,
                                            const model::Model& model);

}  // namespace culm::simulation
