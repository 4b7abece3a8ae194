#include <culm/material/box_section.hpp>
#include <culm/material/circle_section.hpp>
#include <culm/material/isotropic.hpp>
#include <culm/material/neo_hooke.hpp>
#include <culm/material/orthotropic.hpp>
#include <culm/material/rectangle_section.hpp>
#include <culm/material/register_material.hpp>
#include <culm/material/stiffness_matrix_section.hpp>
#include <culm/material/stiffness_values_section.hpp>
#include <culm/material/tube_section.hpp>

namespace culm::material {

void register_sections(Registry<Section>& registry) {
  registry.add("Box", BoxSection::schema(), BoxSection::make);
  registry.add("Circle", CircleSection::schema(), CircleSection::make);
  registry.add("Rectangle", RectangleSection::schema(), RectangleSection::make);
  registry.add("Stiffness Matrix", StiffnessMatrixSection::schema(), StiffnessMatrixSection::make);
  registry.add("Stiffness Values", StiffnessValuesSection::schema(), StiffnessValuesSection::make);
  registry.add("Tube", TubeSection::schema(), TubeSection::make);
}

void register_materials(Registry<Material>& registry) {
  registry.add("Isotropic", IsotropicMaterial::schema(), IsotropicMaterial::make);
  registry.add("Neo-Hooke", NeoHooke::schema(), NeoHooke::make);
  registry.add("Orthotropic", OrthotropicMaterial::schema(), OrthotropicMaterial::make);
}

}  // namespace culm::material
