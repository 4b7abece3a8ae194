#include "held_elements.hpp"

namespace culm::beam {

template <int Order>
ReferenceState add_untwisted(const std::string& effect, const Place& to) {
  return add_held_elements<UntwistedBeam<Order>>(effect, to);
}

template ReferenceState add_untwisted<1>(const std::string&, const Place&);
template ReferenceState add_untwisted<2>(const std::string&, const Place&);
template ReferenceState add_untwisted<3>(const std::string&, const Place&);

}  // namespace culm::beam
