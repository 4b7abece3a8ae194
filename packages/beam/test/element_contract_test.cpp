#include "beam_case.hpp"

#include <culm_kit/element_contract.hpp>

namespace culm::kit {

using beam::DirectorBeamCase;
using beam::HelicalBeamCase;
using DirectorBeams = testing::Types<DirectorBeamCase<1>, DirectorBeamCase<2>, DirectorBeamCase<3>>;

INSTANTIATE_TYPED_TEST_SUITE_P(DirectorBeam, ElementContract, DirectorBeams);
using HeldBeams = testing::Types<beam::HeldBeamCase<beam::KirchhoffBeam<1>>,
                                 beam::HeldBeamCase<beam::KirchhoffBeam<3>>,
                                 beam::HeldBeamCase<beam::UntwistedBeam<2>>,
                                 beam::HeldBeamCase<beam::UntwistedKirchhoffBeam<2>>>;
using LinearBeams = testing::Types<beam::LinearBeamCase<1>, beam::LinearBeamCase<2>>;

INSTANTIATE_TYPED_TEST_SUITE_P(HeldBeam, ElementContract, HeldBeams);
INSTANTIATE_TYPED_TEST_SUITE_P(LinearBeam, ElementContract, LinearBeams);
INSTANTIATE_TYPED_TEST_SUITE_P(HelicalBeam, ElementContract, testing::Types<HelicalBeamCase>);

}  // namespace culm::kit
