#include <culm/beam/element_batches.hpp>
#include <culm/beam/held_beam.hpp>
#include <culm/beam/linear_beam.hpp>
#include <culm/math/lagrange.hpp>
#include <culm/math/quadrature.hpp>

#include "heat_elements.hpp"

namespace culm::heat {
namespace {

// Of (Γ1, Γ2, Γ3, K1, K2, K3): a fibre at (xi1, xi2) is stretched by Γ3 + K1 xi2 - K2 xi1.
Vec6 free_strain(const Temperature& temperature) {
  Vec6 e = Vec6::Zero();
  e[2] = temperature.value;
  e[3] = temperature.gradient[1];
  e[4] = -temperature.gradient[0];
  return e;
}

template <class Beam>
HeatedElement<Beam> heat_element(const model::ElementBatch<Beam>& batch, const model::Cell& cell,
                                 const TemperatureAt& temperature_at, const model::Model& model) {
  const Beam beam = batch.make_element(cell.item);
  const Vec<Beam::num_points> expansion = batch.expansion(cell.item);
  const auto rule = gauss_legendre(Beam::num_points);
  HeatedElement<Beam> heated;
  heated.item = cell.item;
  heated.resultants.setZero();
  for (int p = 0; p < Beam::num_points; ++p) {
    const auto N = Lagrange<Beam::num_points>::values(rule[static_cast<std::size_t>(p)].xi);
    const Temperature temperature = temperature_at(place_of(cell.nodes, N, model));
    const Vec<Beam::num_strains> e =
        expansion[p] * free_strain(temperature).template head<Beam::num_strains>();
    auto& stress = heated.stress[static_cast<std::size_t>(p)];
    stress = beam.stiffness(p) * e;
    heated.energy += 0.5 * e.dot(stress);
    heated.resultants -= beam.resultants(p, e) / Beam::num_points;
  }
  return heated;
}

template <class Beam>
bool heat_beam(const HeatRequest& request) {
  auto* batch = batch_of<Beam>(request.structure.cells.front(), request.context.model);
  if (batch == nullptr) return false;
  if (!has_gradients(2, "beam", request)) return true;
  const Where where = request.options.where("Structure");
  const std::string& name = request.structure.name;
  bool expands = false;
  for (const model::Cell& cell : request.structure.cells) {
    expands = expands || !batch->expansion(cell.item).isZero(0.0);
  }
  if (!expands) {
    request.context.issues.add(
        where, "beam '" + name + "' does not expand: its sections need an 'Expansion'");
  } else if (!batch->relaxation_times().empty()) {
    request.context.issues.add(
        where, "beam '" + name + "' relaxes; heat acts on beams without 'Relaxation'");
  } else if (structure::yields(*batch, request.structure.cells.front().item)) {
    request.context.issues.add(
        where, "beam '" + name + "' yields; heat acts on beams without 'Plasticity'");
  } else {
    add_heat(request, *batch, [&](const model::Cell& cell, const TemperatureAt& temperature) {
      return heat_element(*batch, cell, temperature, request.context.model);
    });
  }
  return true;
}

// Whether shear and extension of the beam are held.
template <int Order>
bool holds_length(const HeatRequest& request) {
  const model::Cell& cell = request.structure.cells.front();
  return batch_of<beam::KirchhoffBeam<Order>>(cell, request.context.model) != nullptr ||
         batch_of<beam::UntwistedKirchhoffBeam<Order>>(cell, request.context.model) != nullptr;
}

template <int Order>
bool heat_order(const HeatRequest& request) {
  return heat_beam<beam::DirectorBeam<Order>>(request) ||
         heat_beam<beam::LinearBeam<Order>>(request) ||
         heat_beam<beam::UntwistedBeam<Order>>(request);
}

}  // namespace

bool heat_beams(const HeatRequest& request) {
  if (heat_order<1>(request) || heat_order<2>(request) || heat_order<3>(request)) return true;
  const model::Model& model = request.context.model;
  const Where where = request.options.where("Structure");
  const std::string beam = "beam '" + request.structure.name + "' ";
  if (holds_length<1>(request) || holds_length<2>(request) || holds_length<3>(request)) {
    request.context.issues.add(where, beam +
                                          "holds its length, so it cannot expand: take "
                                          "'Fidelity' = 'Full' or 'Linear'");
    return true;
  }
  if (batch_of<beam::HelicalBeam>(request.structure.cells.front(), model) != nullptr) {
    request.context.issues.add(where,
                               beam + "has helical elements; heat acts on 'Element' = 'Director'");
    return true;
  }
  return false;
}

}  // namespace culm::heat
