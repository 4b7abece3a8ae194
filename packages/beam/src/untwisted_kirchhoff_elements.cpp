#include "held_elements.hpp"

namespace culm::beam {

template <int Order>
ReferenceState add_untwisted_kirchhoff(const std::string& effect, const Place& to) {
  return add_held_elements<UntwistedKirchhoffBeam<Order>>(effect, to);
}

template ReferenceState add_untwisted_kirchhoff<1>(const std::string&, const Place&);
template ReferenceState add_untwisted_kirchhoff<2>(const std::string&, const Place&);
template ReferenceState add_untwisted_kirchhoff<3>(const std::string&, const Place&);

}  // namespace culm::beam
