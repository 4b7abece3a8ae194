#include "beam_case.hpp"

#include <culm_kit/element_contract.hpp>

namespace culm::kit {

using beam::DirectorBeamCase;
using beam::HelicalBeamCase;
using DirectorBeams = testing::Types<DirectorBeamCase<1>, DirectorBeamCase<2>, DirectorBeamCase<3>>;

INSTANTIATE_TYPED_TEST_SUITE_P(DirectorBeam, ElementContract, DirectorBeams);
using KirchhoffBeams = testing::Types<beam::KirchhoffBeamCase<1>, beam::KirchhoffBeamCase<2>,
                                      beam::KirchhoffBeamCase<3>>;
using LinearBeams = testing::Types<beam::LinearBeamCase<1>, beam::LinearBeamCase<2>>;

INSTANTIATE_TYPED_TEST_SUITE_P(KirchhoffBeam, ElementContract, KirchhoffBeams);
INSTANTIATE_TYPED_TEST_SUITE_P(LinearBeam, ElementContract, LinearBeams);
INSTANTIATE_TYPED_TEST_SUITE_P(HelicalBeam, ElementContract, testing::Types<HelicalBeamCase>);

}  // namespace culm::kit
