/// Director elements on a chain, and those that are made of them.
#pragma once

#include <culm/beam/director_beam.hpp>

#include "element_chain.hpp"

#include <fmt/format.h>

namespace culm::beam {

template <int Order>
DirectorBeam<Order> make_element(const Stretch<DirectorBeam<Order>>& stretch,
                                 const SectionTable& sections) {
  std::array<Mat6, Order> stiffness;
  const auto rule = gauss_legendre(Order);
  for (std::size_t g = 0; g < stiffness.size(); ++g) {
    stiffness[g] = stretch.section_at(sections, rule[g].xi).stiffness;
  }
  return {stretch.slots, stiffness, stretch.template masses<Order + 1>(sections)};
}

template <int Order>
double jacobian(const Stretch<DirectorBeam<Order>>& stretch, const SectionTable&, double xi) {
  return stretch.jacobian(xi);
}

/// Adds families of orders 1 to 3: add(effect, place) by order, with the effect in the ledger.
template <class AddOfOrder>
void add_director_families(ElementFamilies& families, ElementFamily family, const std::string& kind,
                           AddOfOrder add_of_order) {
  const auto add_one = [&]<int Order>(std::integral_constant<int, Order> order) {
    family.element = "Director";
    family.order = Order;
    const std::string effect = fmt::format("Beam, {}, order {}", kind, Order);
    family.add = [=](const Place& to) { return add_of_order(order, effect, to); };
    families.add(family);
  };
  add_one(std::integral_constant<int, 1>{});
  add_one(std::integral_constant<int, 2>{});
  add_one(std::integral_constant<int, 3>{});
}

}  // namespace culm::beam
