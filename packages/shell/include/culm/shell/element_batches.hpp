/// The batches of shell elements, compiled where `elements` makes them, once in this package:
/// include this where it is called.
#pragma once

#include <culm/model/element_batch.hpp>
#include <culm/shell/elastic_shell.hpp>
#include <culm/shell/hyperelastic_shell.hpp>
#include <culm/shell/linear_shell.hpp>

namespace culm::model {

extern template ElementBatch<shell::ElasticShell>& elements(Model&, const Effect&,
                                                            const StrainDamping&);
extern template ElementBatch<shell::HyperelasticShell>& elements(Model&, const Effect&,
                                                                 const StrainDamping&);
extern template ElementBatch<shell::LinearShell>& elements(Model&, const Effect&,
                                                           const StrainDamping&);

}  // namespace culm::model
