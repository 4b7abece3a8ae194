#include "beam_case.hpp"

#include <culm_kit/element_contract.hpp>

namespace culm::kit {

using beam::DirectorBeamCase;
using beam::HelicalBeamCase;
using DirectorBeams = testing::Types<DirectorBeamCase<1>, DirectorBeamCase<2>, DirectorBeamCase<3>>;

INSTANTIATE_TYPED_TEST_SUITE_P(DirectorBeam, ElementContract, DirectorBeams);
INSTANTIATE_TYPED_TEST_SUITE_P(HelicalBeam, ElementContract, testing::Types<HelicalBeamCase>);

}  // namespace culm::kit
