#include <culm/shell/element_batches.hpp>
#include <culm/shell/free_strains.hpp>
#include <culm/shell/layer_quadrature.hpp>

#include "heat_elements.hpp"

#include <algorithm>
#include <variant>

namespace culm::heat {
namespace {

// The strain of a wall that is free, without its growth across the thickness: what leaves no stress
// there.
Vec6 strain_in_plane(const material::Layer& layer, double temperature) {
  const Mat6& C = std::get<material::StVenantKirchhoff>(layer.material.law).C;
  Vec6 strain = Vec6::Zero();
  strain.head<2>() = temperature * layer.material.expansion.head<2>();
  strain[2] = -C.row(2).head<2>().dot(strain.head<2>()) / C(2, 2);
  return strain;
}

// Across the thickness the director can only be strained by a line in ζ. What layers would like
// beyond the best one has no stress in a wall that is free, so it must not have any here.
shell::LayerStrain free_strain(const Temperature& temperature, const material::Layup& layup) {
  const double value = temperature.value;
  const double gradient = temperature.gradient[0];
  const auto at = [=](double zeta) { return value + zeta * gradient; };
  const double t = layup.thickness();
  double mean = 0.0;
  double slope = 0.0;
  shell::visit_thickness(layup, 2, [&](const material::Layer& layer, double zeta, double weight) {
    const double growth =
        at(zeta) * layer.material.expansion[2] - strain_in_plane(layer, at(zeta))[2];
    mean += weight * growth / t;
    slope += 12.0 * weight * zeta * growth / (t * t * t);
  });
  return [=](const material::Layer& layer, double zeta) {
    Vec6 strain = strain_in_plane(layer, at(zeta));
    strain[2] += mean + slope * zeta;
    return strain;
  };
}

const shell::ShellForms::Strain& stress_of(const shell::ElasticShell&,
                                           const shell::ShellForms::Strain& stress) {
  return stress;
}
shell::LinearShell::Strain stress_of(const shell::LinearShell& element,
                                     const shell::ShellForms::Strain& stress) {
  return element.seen_from_frame(stress);
}

template <class Shell>
HeatedElement<Shell> heat_element(const Shell& element, int item,
                                  const shell::LayerStrain& free_strain) {
  const shell::FreeStrains free(element.wall(), free_strain);
  return {item, {stress_of(element, free.stress)}, free.energy, free.resultants, free.layer_states};
}

bool expands(const material::Layup& layup) {
  return std::any_of(layup.layers.begin(), layup.layers.end(), [](const material::Layer& layer) {
    return !layer.material.expansion.isZero(0.0);
  });
}

template <class Shell>
bool heat_shell(const HeatRequest& request) {
  const model::Cell& first = request.structure.cells.front();
  auto* batch = batch_of<Shell>(first, request.context.model);
  if (batch == nullptr) return false;
  if (!has_gradients(1, "shell", request)) return true;
  const Shell any = batch->make_element(first.item);
  const material::Layup& layup = any.layup();
  const Where where = request.options.where("Structure");
  const std::string shell = "shell '" + request.structure.name + "' ";
  if (!expands(layup)) {
    request.context.issues.add(
        where, shell + "does not expand: its materials need an 'Expansion' or 'Expansions'");
  } else if (!batch->relaxation_times().empty()) {
    request.context.issues.add(where, shell + "relaxes; heat acts on shells without 'Relaxation'");
  } else if (structure::yields(*batch, first.item)) {
    request.context.issues.add(where, shell + "yields; heat acts on shells without 'Plasticity'");
  } else {
    const Eigen::Vector4d centre = Eigen::Vector4d::Constant(0.25);
    add_heat(request, *batch, [&](const model::Cell& cell, const TemperatureAt& temperature_at) {
      const Temperature temperature =
          temperature_at(place_of(cell.nodes, centre, request.context.model));
      return heat_element(batch->make_element(cell.item), cell.item,
                          free_strain(temperature, layup));
    });
  }
  return true;
}

}  // namespace

bool heat_shells(const HeatRequest& request) {
  if (heat_shell<shell::ElasticShell>(request) || heat_shell<shell::LinearShell>(request))
    return true;
  const model::Cell& first = request.structure.cells.front();
  if (batch_of<shell::HyperelasticShell>(first, request.context.model) == nullptr) return false;
  request.context.issues.add(request.options.where("Structure"),
                             "shell '" + request.structure.name +
                                 "' has a material for large strains; heat acts on shells of "
                                 "'Isotropic' and 'Orthotropic' materials");
  return true;
}

}  // namespace culm::heat
