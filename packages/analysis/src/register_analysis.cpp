#include <culm/analysis/buckling.hpp>
#include <culm/analysis/campbell.hpp>
#include <culm/analysis/dynamics.hpp>
#include <culm/analysis/matrices.hpp>
#include <culm/analysis/modal.hpp>
#include <culm/analysis/path_following.hpp>
#include <culm/analysis/register_analysis.hpp>
#include <culm/analysis/statics.hpp>

namespace culm::analysis {

void register_analyses(AnalysisRegistry& registry) {
  registry.add("Static", Statics::schema(), Statics::make);
  registry.add("Path", PathFollowing::schema(), PathFollowing::make);
  registry.add("Dynamic", Dynamics::schema(), Dynamics::make);
  registry.add("Modal", Modal::schema(), Modal::make);
  registry.add("Buckling", Buckling::schema(), Buckling::make);
  registry.add("Campbell", Campbell::schema(), Campbell::make);
  registry.add("Matrices", Matrices::schema(), Matrices::make);
}

}  // namespace culm::analysis
