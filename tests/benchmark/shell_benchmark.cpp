// What a shell element costs: all that a Newton iteration asks of it, against the number of layers.
// A row of 500 elements is visited in turn, so that their matrices come from memory as in a model.

#include <culm/material/isotropic.hpp>
#include <culm/shell/elastic_shell.hpp>
#include <culm/shell/hyperelastic_shell.hpp>
#include <culm/shell/linear_shell.hpp>

#include <benchmark/benchmark.h>

#include <memory>
#include <vector>

namespace {

using namespace culm;
using namespace culm::shell;

ShellForms::Nodes reference() {
  ShellForms::Nodes q;
  for (int a = 0; a < 4; ++a) {
    const double xi = a == 1 || a == 2 ? 1.0 : -1.0;
    const double eta = a < 2 ? -1.0 : 1.0;
    q.col(2 * a) = Vec3(0.5 * xi, 0.5 * eta, 0.05 * xi * eta);
    q.col(2 * a + 1) = Vec3(0.1 * xi, -0.05 * eta, 1.0).normalized();
  }
  return q;
}

ShellForms::Nodes deformed() {
  ShellForms::Nodes q = reference();
  q.col(4) += Vec3(0.05, -0.02, 0.1);
  q.col(5) += Vec3(-0.1, 0.03, 0.02);
  return q;
}

std::shared_ptr<const material::Layup> layup(const material::Material::Law& law, int layers) {
  material::Layup result;
  for (int l = 0; l < layers; ++l) {
    result.layers.push_back({material::Material{law}, 0.1 / layers, 0.3 * l});
  }
  return std::make_shared<material::Layup>(result);
}

void ElasticShell_Evaluate(benchmark::State& run) {
  const auto law = material::IsotropicMaterial::law(3.0, 0.3);
  const std::vector<ElasticShell> elements(
      500, ElasticShell(reference(), layup(law, static_cast<int>(run.range(0)))));
  ShellForms::Nodes q = deformed();
  ShellForms::Strain y;
  ShellForms::Strain S;
  std::size_t next = 0;
  for (auto _ : run) {
    const ElasticShell& element = elements[next++ % elements.size()];
    ShellForms::Nodes f = ShellForms::Nodes::Zero();
    RowMat<24, 24> K = RowMat<24, 24>::Zero();
    SlotMatrix<8> A = SlotMatrix<8>::Zero();
    element.strain(0, q, y);
    S.noalias() = element.stiffness(0) * y;
    ShellForms::add_force(q, S, f);
    ShellForms::add_stiffness(q, q, element.stiffness(0), 1.0, K);
    element.add_curvature(0, S, A);
    benchmark::DoNotOptimize(f.data());
    benchmark::DoNotOptimize(K.data());
    benchmark::DoNotOptimize(A.data());
    q(0, 4) += 1e-12;
  }
}

// The same of an element seen from a frame: 30 unknowns instead of 24.
void LinearShell_Evaluate(benchmark::State& run) {
  const ElasticShell full(reference(), layup(material::IsotropicMaterial::law(3.0, 0.3), 1));
  const auto with_frame = [](const ShellForms::Nodes& shell) {
    LinearShell::Nodes q = LinearShell::Nodes::Zero();
    q.middleCols<3>(1).setIdentity();
    for (int a = 0; a < 4; ++a) q.middleCols<2>(4 * (a + 1)) = shell.middleCols<2>(2 * a);
    return q;
  };
  const std::vector<LinearShell> elements(500, LinearShell(full, with_frame(reference())));
  LinearShell::Nodes q = with_frame(deformed());
  LinearShell::Strain y;
  LinearShell::Strain S;
  std::size_t next = 0;
  for (auto _ : run) {
    const LinearShell& element = elements[next++ % elements.size()];
    LinearShell::Nodes f = LinearShell::Nodes::Zero();
    RowMat<30, 30> K = RowMat<30, 30>::Zero();
    SlotMatrix<20> A = SlotMatrix<20>::Zero();
    element.strain(0, q, y);
    S.noalias() = element.stiffness(0) * y;
    LinearShell::add_force(q, S, f);
    LinearShell::add_stiffness(q, q, element.stiffness(0), 1.0, K);
    element.add_curvature(0, S, A);
    benchmark::DoNotOptimize(f.data());
    benchmark::DoNotOptimize(K.data());
    benchmark::DoNotOptimize(A.data());
    q(0, 8) += 1e-12;
  }
}

void HyperelasticShell_Respond(benchmark::State& run) {
  const HyperelasticShell element(reference(), layup(material::NeoHooke::from_moduli(3.0, 0.3),
                                                     static_cast<int>(run.range(0))));
  ShellForms::Strain y;
  element.strain(0, deformed(), y);
  HyperelasticShell::Internals internals = HyperelasticShell::Internals::Zero();
  const HyperelasticShell::Internals prev = internals;
  Response<ShellForms::num_strains> response;
  for (auto _ : run) {
    element.respond(0, y, y, prev, Stencil::statics(), internals, response);
    benchmark::DoNotOptimize(response.stress.data());
    y[0] += 1e-12;
  }
}

void ElasticShell_Construct(benchmark::State& run) {
  const auto law = material::IsotropicMaterial::law(3.0, 0.3);
  const auto wall = layup(law, static_cast<int>(run.range(0)));
  for (auto _ : run) {
    const ElasticShell element(reference(), wall);
    benchmark::DoNotOptimize(element.stiffness(0).data());
  }
}

BENCHMARK(ElasticShell_Evaluate)->Arg(1)->Arg(4)->Arg(20);
BENCHMARK(LinearShell_Evaluate);
BENCHMARK(HyperelasticShell_Respond)->Arg(1)->Arg(4)->Arg(20);
BENCHMARK(ElasticShell_Construct)->Arg(1)->Arg(4)->Arg(20);

}  // namespace
