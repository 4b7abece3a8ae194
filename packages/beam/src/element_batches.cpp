#include <culm/beam/element_batches.hpp>

namespace culm::model {

template ElementBatch<beam::DirectorBeam<1>>& elements(Model&, const Effect&, const StrainDamping&);
template ElementBatch<beam::DirectorBeam<2>>& elements(Model&, const Effect&, const StrainDamping&);
template ElementBatch<beam::DirectorBeam<3>>& elements(Model&, const Effect&, const StrainDamping&);
template ElementBatch<beam::HelicalBeam>& elements(Model&, const Effect&, const StrainDamping&);

}  // namespace culm::model
