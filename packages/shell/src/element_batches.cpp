#include <culm/shell/element_batches.hpp>

namespace culm::model {

template ElementBatch<shell::ElasticShell>& elements(Model&, const Effect&, const StrainDamping&);
template ElementBatch<shell::HyperelasticShell>& elements(Model&, const Effect&,
                                                          const StrainDamping&);
template ElementBatch<shell::LinearShell>& elements(Model&, const Effect&, const StrainDamping&);

}  // namespace culm::model
