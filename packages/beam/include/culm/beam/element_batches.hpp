/// The batches of beam elements, compiled where `elements` makes them, once in this package:
/// include this where it is called.
#pragma once

#include <culm/beam/director_pack.hpp>
#include <culm/beam/helical_beam.hpp>
#include <culm/model/element_batch.hpp>

namespace culm::model {

extern template ElementBatch<beam::DirectorBeam<1>>& elements(Model&, const Effect&,
                                                              const StrainDamping&);
extern template ElementBatch<beam::DirectorBeam<2>>& elements(Model&, const Effect&,
                                                              const StrainDamping&);
extern template ElementBatch<beam::DirectorBeam<3>>& elements(Model&, const Effect&,
                                                              const StrainDamping&);
extern template ElementBatch<beam::HelicalBeam>& elements(Model&, const Effect&,
                                                          const StrainDamping&);

}  // namespace culm::model
