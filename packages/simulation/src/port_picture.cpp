#include "port_picture.hpp"

#include <culm/output/file_part.hpp>
#include <culm/output/point_picture.hpp>
#include <culm/port/point_motion.hpp>

#include <vector>

namespace culm::simulation {

std::string port_picture(const std::string& name) {
  return "port_" + output::file_part(name) + ".vtu";
}

void draw_port(const port::Port& port, const model::Model& model,
               const std::filesystem::path& path) {
  const model::Coordinates& reference = model.nodes().reference();
  std::vector<Vec3> points;
  output::NamedArray lever{"lever", 3, {}}, beyond{"beyond", 1, {}}, rival{"rival", 1, {}},
      fibre{"fibre", 1, {}};
  std::vector<int> structures;
  for (const port::Place& place : port.places()) {
    points.push_back(port::position(place.marker, reference));
    const Vec3 arm = port::directors(place.marker, reference) * place.marker.offset;
    lever.values.insert(lever.values.end(), arm.begin(), arm.end());
    structures.push_back(place.structure);
    beyond.values.push_back(place.beyond);
    rival.values.push_back(place.rival);
    fibre.values.push_back(place.fibre);
  }
  std::vector<std::string> names;
  for (const model::Structure& one : model.structures()) names.push_back(one.name);
  output::write_points(path, points, structures, {lever, beyond, rival, fibre}, names);
}

}  // namespace culm::simulation
