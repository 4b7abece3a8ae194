#include "element_families.hpp"

#include <algorithm>
#include <set>

namespace culm::beam {
namespace {

template <class Name>
std::vector<std::string> each_once(const std::vector<ElementFamily>& families, Name name) {
  std::vector<std::string> names;
  for (const ElementFamily& family : families) {
    if (std::ranges::find(names, family.*name) == names.end()) names.push_back(family.*name);
  }
  return names;
}

}  // namespace

ElementFamilies::ElementFamilies() {
  register_director_elements(*this);
  register_kirchhoff_elements(*this);
  register_linear_elements(*this);
  register_untwisted_elements(*this);
  register_untwisted_kirchhoff_elements(*this);
  register_rigid_elements(*this);
  register_helical_elements(*this);
}

const ElementFamily* ElementFamilies::find(const std::string& element, int order,
                                           const std::string& fidelity, bool twists) const {
  const auto found = std::ranges::find_if(families_, [&](const ElementFamily& family) {
    return family.element == element && family.order == order && family.fidelity == fidelity &&
           family.twists == twists;
  });
  return found == families_.end() ? nullptr : &*found;
}

std::vector<int> ElementFamilies::orders(const std::string& element) const {
  std::set<int> orders;
  for (const ElementFamily& family : families_) {
    if (family.element == element) orders.insert(family.order);
  }
  return {orders.begin(), orders.end()};
}

std::vector<std::string> ElementFamilies::elements() const {
  return each_once(families_, &ElementFamily::element);
}

std::vector<std::string> ElementFamilies::fidelities() const {
  return each_once(families_, &ElementFamily::fidelity);
}

}  // namespace culm::beam
