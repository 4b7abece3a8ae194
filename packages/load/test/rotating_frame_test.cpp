#include <culm/load/rotating_frame.hpp>

#include <culm_kit/load_contract.hpp>

#include <array>
#include <memory>

namespace culm::load {
namespace {

// A full symmetric mass between the slots of two nodes, in a frame with an oblique axis.
void fill_with_frame(model::Model& model, bool with_slave) {
  for (int node = 0; node < 2; ++node) {
    kit::add_random_node(model.nodes(), NodeKind::node12, 10 + node);
  }
  Eigen::MatrixXd mass(8, 8);
  for (int i = 0; i < 8; ++i) {
    for (int j = 0; j < 8; ++j) mass(i, j) = 1.0 / (1.0 + i + j) + (i == j ? 1.0 : 0.0);
  }
  auto load =
      std::make_unique<RotatingFrame>("Rotating Frame", model.nodes(), model::Amplitude::constant(),
                                      Vec3(0.7, -1.1, 2.3).normalized(), 2.6, Vec3(0.4, 0.1, -0.2));
  load->add(std::array{0, 1}, mass);
  model.add_load(std::move(load));
  if (with_slave) model.add_rigid_link("link", 0, model.nodes().add(kit::random_node(20)));
}

// In statics and, with Coriolis forces, in steps.
TEST(RotatingFrame, TangentIsDerivativeOfResidual) {
  for (const bool with_slave : {false, true}) {
    kit::expect_tangent_is_derivative(
        [&](model::Model& model) { fill_with_frame(model, with_slave); }, "Rotating Frame");
  }
}

TEST(RotatingFrame, NullSpaceResidualIsProjected) {
  for (const bool with_slave : {false, true}) {
    kit::expect_residual_is_projected(
        [&](model::Model& model) { fill_with_frame(model, with_slave); }, "Rotating Frame");
  }
}

}  // namespace
}  // namespace culm::load
