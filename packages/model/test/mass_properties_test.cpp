#include <culm/math/rotation.hpp>
#include <culm/model/mass_properties.hpp>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

namespace culm::model {
namespace {

// Three point masses fixed to a node, as its mass matrix.
struct Points {
  std::vector<std::pair<double, Vec3>> all = {
      {2.0, Vec3(0.3, -0.1, 0.2)}, {1.0, Vec3(-0.5, 0.4, 0.1)}, {0.5, Vec3(0.0, 0.7, -0.6)}};

  SlotMatrix<4> mass_matrix() const {
    SlotMatrix<4> M = SlotMatrix<4>::Zero();
    for (const auto& [mass, offset] : all) {
      const Eigen::Vector4d factors(1.0, offset[0], offset[1], offset[2]);
      M += mass * factors * factors.transpose();
    }
    return M;
  }
};

int add_body(Model& model, const std::string& name, const Vec3& position, const Mat3& triad) {
  NodeSlots slots;
  slots << position, triad;
  const int node = model.nodes().add(slots);
  model.add_structure(name).nodes = {node};
  model.masses("bodies").add(node, Points().mass_matrix());
  return node;
}

// From the points themselves.
struct Expected {
  double mass = 0.0;
  Vec3 centre = Vec3::Zero();
  Mat3 inertia = Mat3::Zero();

  void add(const Vec3& position, const Mat3& triad) {
    for (const auto& [m, offset] : Points().all) places.emplace_back(m, position + triad * offset);
  }
  void finish() {
    for (const auto& [m, x] : places) {
      mass += m;
      centre += m * x;
    }
    centre /= mass;
    for (const auto& [m, x] : places) {
      const Vec3 r = x - centre;
      inertia += m * (r.squaredNorm() * Mat3::Identity() - r * r.transpose());
    }
  }
  std::vector<std::pair<double, Vec3>> places;
};

TEST(MassProperties, AreThoseOfThePointsABodyConsistsOf) {
  const Vec3 here(1.0, -2.0, 0.5);
  const Vec3 there(-0.4, 0.3, 2.0);
  const Mat3 turned = exp_rotation(Vec3(0.4, -1.1, 0.7));
  Model model;
  add_body(model, "one", here, turned);
  add_body(model, "two", there, Mat3::Identity());
  const auto found = mass_properties(model, model.nodes().reference());
  ASSERT_EQ(found.size(), 2U);
  Expected one;
  one.add(here, turned);
  one.finish();
  EXPECT_NEAR(found[0].mass, 3.5, 1e-15);
  EXPECT_LT((found[0].centre() - one.centre).norm(), 1e-14);
  EXPECT_LT((found[0].inertia() - one.inertia).norm(), 1e-13);

  Expected both;
  both.add(here, turned);
  both.add(there, Mat3::Identity());
  both.finish();
  MassProperties total = found[0];
  total += found[1];
  EXPECT_LT((total.centre() - both.centre).norm(), 1e-14);
  EXPECT_LT((total.inertia() - both.inertia).norm(), 1e-13);
}

}  // namespace
}  // namespace culm::model
