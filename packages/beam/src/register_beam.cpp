#include <culm/beam/beam_structure.hpp>
#include <culm/beam/register_beam.hpp>

namespace culm::beam {

void register_beams(structure::StructureRegistry& registry) {
  registry.add("Beam", beam_schema(), add_beam);
}

}  // namespace culm::beam
