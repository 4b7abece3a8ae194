#include <culm/model/mass_properties.hpp>

namespace culm::model {

MassProperties& MassProperties::operator+=(const MassProperties& other) {
  mass += other.mass;
  first += other.first;
  second += other.second;
  return *this;
}

Mat3 MassProperties::inertia() const {
  const Mat3 about_centre = second - first * first.transpose() / mass;
  return about_centre.trace() * Mat3::Identity() - about_centre;
}

std::vector<MassProperties> mass_properties(const Model& model, const Coordinates& q) {
  // masses do not couple structures, so one product serves all of them
  Coordinates ones(q.size(), 0.0);
  for (int node = 0; node < model.nodes().size(); ++node) NodeTable::slots(ones, node)(0, 0) = 1.0;
  const Coordinates masses = model.mass_times(ones);
  const Coordinates moments = model.mass_times(q);
  std::vector<MassProperties> result;
  for (const Structure& structure : model.structures()) {
    MassProperties properties;
    for (int node : structure.nodes) {
      const auto p = NodeTable::slots(moments, node);
      properties.mass += NodeTable::slots(masses, node)(0, 0);
      properties.first += p.col(0);
      properties.second += NodeTable::slots(q, node) * p.transpose();
    }
    // symmetric but for round-off
    properties.second = (0.5 * (properties.second + properties.second.transpose())).eval();
    result.push_back(properties);
  }
  return result;
}

}  // namespace culm::model
