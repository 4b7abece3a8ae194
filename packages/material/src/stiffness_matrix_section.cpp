#include <culm/material/expansion.hpp>
#include <culm/material/outline.hpp>
#include <culm/material/placement.hpp>
#include <culm/material/stiffness_matrix_section.hpp>
#include <culm/material/stiffness_values_section.hpp>

#include <fmt/format.h>

namespace culm::material {

namespace {

// 36 values row by row, or 21 of the upper triangle row by row.
Mat6 read_matrix(const std::vector<double>& values) {
  Mat6 C;
  std::size_t next = 0;
  for (int i = 0; i < 6; ++i) {
    for (int j = values.size() == 36 ? 0 : i; j < 6; ++j) {
      C(i, j) = values[next++];
      if (values.size() == 21) C(j, i) = C(i, j);
    }
  }
  return C;
}

using Mistakes = std::vector<std::string> (*)(const Mat6& matrix);

void check_matrix(const std::string& name, Mistakes mistakes, const Options& options,
                  InputIssues& issues) {
  const auto& values = options.numbers(name);
  if (values.size() != 36 && values.size() != 21) {
    issues.add(
        options.where(name),
        fmt::format("must have 36 values (rows) or 21 values (upper triangle by rows), got {}",
                    values.size()));
    return;
  }
  for (const auto& message : mistakes(read_matrix(values))) {
    issues.add(options.where(name), message);
  }
}

void check_stiffness(const Options& options, InputIssues& issues) {
  check_matrix("Stiffness", stiffness_mistakes, options, issues);
}

// The mass by its matrix, or by its values.
void check_mass(const Options& options, InputIssues& issues) {
  if (!options.has("Mass")) {
    check_mass_values(options, issues);
    return;
  }
  const Schema values = mass_values_schema();
  for (const std::string& value : values.field_names()) {
    if (!options.given(value)) continue;
    issues.add(options.where(value), "the mass is given by 'Mass' already");
    return;
  }
  check_matrix("Mass", full_mass_mistakes, options, issues);
}

Mat3 read_mass(const Options& options) {
  if (!options.has("Mass")) return mass_matrix(read_mass_values(options));
  const Mat6 M = read_matrix(options.numbers("Mass"));
  return plane_mass(0.5 * (M + M.transpose()));
}

}  // namespace

Schema StiffnessMatrixSection::schema() {
  Schema schema("Stiffness Matrix", "Section by its symmetric 6x6 stiffness and mass.");
  schema
      .add(
          numbers("Stiffness", "",
                  "Stiffness against (shear 1, shear 2, stretch, curvature 1, curvature 2, twist): "
                  "36 values by rows, or the 21 of the upper triangle by rows; N, N m, N m^2.")
              .min_size(21))
      .add(
          numbers("Mass", "",
                  "Mass against the velocities along d1, d2, d3 and the angular velocities about "
                  "them, values as those of 'Stiffness', of a plane section: m 1, -m [c]; m [c], J "
                  "with J33 = J11 + J22; kg/m, kg, kg m. Instead of rhoA and its like.")
              .min_size(21)
              .optional())
      .add_all(mass_values_schema())
      .add(expansion_field())
      .add_all(placement_schema())
      .add_all(outline_schema())
      .check(check_stiffness)
      .check(check_mass);
  return schema;
}

Section StiffnessMatrixSection::make(const Options& options) {
  Section section;
  const Mat6 C = read_matrix(options.numbers("Stiffness"));
  section.stiffness = 0.5 * (C + C.transpose());
  section.mass = read_mass(options);
  section.outline = read_outline(options);
  section.expansion = options.number("Expansion");
  return place(section, options);
}

}  // namespace culm::material
