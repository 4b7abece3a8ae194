#include <culm/analysis/buckling.hpp>
#include <culm/analysis/campbell.hpp>
#include <culm/analysis/dynamics.hpp>
#include <culm/analysis/flutter.hpp>
#include <culm/analysis/matrices.hpp>
#include <culm/analysis/modal.hpp>
#include <culm/analysis/path_following.hpp>
#include <culm/analysis/register_analysis.hpp>
#include <culm/analysis/statics.hpp>

namespace culm::analysis {

Variants AnalysisRegistry::variants() const {
  Variants all = steppers.variants();
  all.merge(inspections.variants());
  return all;
}

void register_analyses(AnalysisRegistry& registry) {
  registry.steppers.add("Static", Statics::schema(), Statics::make);
  registry.steppers.add("Path", PathFollowing::schema(), PathFollowing::make);
  registry.steppers.add("Dynamic", Dynamics::schema(), Dynamics::make);
  registry.inspections.add("Modal", Modal::schema(), Modal::make);
  registry.inspections.add("Buckling", Buckling::schema(), Buckling::make);
  registry.inspections.add("Campbell", Campbell::schema(), Campbell::make);
  registry.inspections.add("Flutter", Flutter::schema(), Flutter::make);
  registry.inspections.add("Matrices", Matrices::schema(), Matrices::make);
  registry.gives_shapes = {"Modal", "Buckling"};
  registry.follows_path = {"Path"};
}

}  // namespace culm::analysis
