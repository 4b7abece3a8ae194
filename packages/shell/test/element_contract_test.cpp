#include "shell_case.hpp"

#include <culm_kit/element_contract.hpp>

namespace culm::kit {

using Shells = testing::Types<shell::ElasticShellCase, shell::PlainShellCase,
                              shell::FullyEnhancedShellCase, shell::LinearShellCase>;

INSTANTIATE_TYPED_TEST_SUITE_P(ElasticShell, ElementContract, Shells);

}  // namespace culm::kit
