#include <culm/contact/contact_point.hpp>
#include <culm/model/node_table.hpp>

namespace culm::contact {

Vec3 place_of(const model::Marker& marker, const model::Coordinates& q) {
  Vec3 place = Vec3::Zero();
  for (std::size_t a = 0; a < marker.nodes.size(); ++a) {
    const auto slots = model::NodeTable::slots(q, marker.nodes[a]);
    place += marker.weights[a] * (slots.col(0) + slots.rightCols<3>() * marker.offset);
  }
  return place;
}

}  // namespace culm::contact
