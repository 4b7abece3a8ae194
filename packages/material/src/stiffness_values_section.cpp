#include <culm/material/expansion.hpp>
#include <culm/material/outline.hpp>
#include <culm/material/placement.hpp>
#include <culm/material/stiffness_values_section.hpp>

namespace culm::material {

namespace {

StiffnessValues read_stiffness_values(const Options& options) {
  return {.EA = options.number("EA"),
          .GA1 = options.number("GA1"),
          .GA2 = options.number("GA2"),
          .EI1 = options.number("EI1"),
          .EI2 = options.number("EI2"),
          .GIp = options.number("GIp"),
          .ES1 = options.number("ES1"),
          .ES2 = options.number("ES2"),
          .GS1 = options.number("GS1"),
          .GS2 = options.number("GS2"),
          .EI12 = options.number("EI12")};
}

void check_stiffness_values(const Options& options, InputIssues& issues) {
  const Mat6 C = stiffness_matrix(read_stiffness_values(options));
  for (const auto& message : stiffness_mistakes(C)) issues.add(options.where(), message);
}

}  // namespace

void check_mass_values(const Options& options, InputIssues& issues) {
  const Mat3 m = mass_matrix(read_mass_values(options));
  for (const auto& message : mass_mistakes(m)) issues.add(options.where(), message);
}

Schema mass_values_schema() {
  Schema schema("Mass", "Mass of a section per length.");
  schema.add(number("rhoA", "kg/m", "Mass per length.").non_negative().optional(0.0))
      .add(number("rhoI1", "kg m", "Integral of density times xi2^2.").non_negative().optional(0.0))
      .add(number("rhoI2", "kg m", "Integral of density times xi1^2.").non_negative().optional(0.0))
      .add(number("rhoS1", "kg", "Integral of density times xi2.").optional(0.0))
      .add(number("rhoS2", "kg", "Integral of density times xi1.").optional(0.0))
      .add(number("rhoI12", "kg m", "Integral of density times xi1 xi2.").optional(0.0));
  return schema;
}

MassValues read_mass_values(const Options& options) {
  return {.rhoA = options.number("rhoA"),
          .rhoI1 = options.number("rhoI1"),
          .rhoI2 = options.number("rhoI2"),
          .rhoS1 = options.number("rhoS1"),
          .rhoS2 = options.number("rhoS2"),
          .rhoI12 = options.number("rhoI12")};
}

Schema StiffnessValuesSection::schema() {
  Schema schema("Stiffness Values",
                "Section by its stiffness values; coordinates xi1 along d1, xi2 along d2.");
  schema.add(number("EA", "N", "Stiffness against stretch.").non_negative())
      .add(number("GA1", "N", "Stiffness against shear along d1.").non_negative())
      .add(number("GA2", "N", "Stiffness against shear along d2.").non_negative())
      .add(number("EI1", "N m^2", "Bending about d1: integral of E xi2^2.").non_negative())
      .add(number("EI2", "N m^2", "Bending about d2: integral of E xi1^2.").non_negative())
      .add(number("GIp", "N m^2", "Torsion about d3 (St. Venant).").non_negative())
      .add(number("ES1", "N m", "Integral of E xi2.").optional(0.0))
      .add(number("ES2", "N m", "Integral of E xi1.").optional(0.0))
      .add(number("GS1", "N m", "Integral of G xi2.").optional(0.0))
      .add(number("GS2", "N m", "Integral of G xi1.").optional(0.0))
      .add(number("EI12", "N m^2", "Integral of E xi1 xi2.").optional(0.0))
      .add_all(mass_values_schema())
      .add(expansion_field())
      .add_all(placement_schema())
      .add_all(outline_schema())
      .check(check_stiffness_values)
      .check(check_mass_values);
  return schema;
}

Section StiffnessValuesSection::make(const Options& options) {
  Section section;
  section.stiffness = stiffness_matrix(read_stiffness_values(options));
  section.mass = mass_matrix(read_mass_values(options));
  section.outline = read_outline(options);
  section.expansion = options.number("Expansion");
  return place(section, options);
}

}  // namespace culm::material
