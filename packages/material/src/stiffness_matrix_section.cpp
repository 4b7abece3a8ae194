#include <culm/material/placement.hpp>
#include <culm/material/stiffness_matrix_section.hpp>
#include <culm/material/stiffness_values_section.hpp>

#include <fmt/format.h>

namespace culm::material {

namespace {

// 36 values row by row, or 21 of the upper triangle row by row.
Mat6 read_stiffness(const std::vector<double>& values) {
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

void check_stiffness(const Options& options, InputIssues& issues) {
  const auto& values = options.numbers("Stiffness");
  if (values.size() != 36 && values.size() != 21) {
    issues.add(
        options.where("Stiffness"),
        fmt::format("must have 36 values (rows) or 21 values (upper triangle by rows), got {}",
                    values.size()));
    return;
  }
  for (const auto& message : stiffness_mistakes(read_stiffness(values))) {
    issues.add(options.where("Stiffness"), message);
  }
}

}  // namespace

Schema StiffnessMatrixSection::schema() {
  Schema schema("Stiffness Matrix", "Section by its symmetric 6x6 stiffness.");
  schema
      .add(
          numbers("Stiffness", "",
                  "Stiffness against (shear 1, shear 2, stretch, curvature 1, curvature 2, twist): "
                  "36 values by rows, or the 21 of the upper triangle by rows; N, N m, N m^2.")
              .min_size(21))
      .add_all(mass_values_schema())
      .add_all(placement_schema())
      .check(check_stiffness)
      .check(check_mass_values);
  return schema;
}

Section StiffnessMatrixSection::make(const Options& options) {
  Section section;
  const Mat6 C = read_stiffness(options.numbers("Stiffness"));
  section.stiffness = 0.5 * (C + C.transpose());
  section.mass = mass_matrix(read_mass_values(options));
  return place(section, options);
}

}  // namespace culm::material
