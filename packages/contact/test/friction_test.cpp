#include <culm/contact/plane_contact.hpp>

#include "contact_laws.hpp"

#include <gtest/gtest.h>

#include <memory>

namespace culm::contact {
namespace {

constexpr double k = 30.0;
constexpr double normal = 8.0;
constexpr Friction friction{0.5, 1e-3};

TEST(Friction, SticksUntilItSlides) {
  EXPECT_EQ(stick(friction, normal, k, Vec3(0.1, 0.0, 0.0)).force, Vec3(-3.0, 0.0, 0.0));
  const Rubbing slides = stick(friction, normal, k, Vec3(0.3, 0.4, 0.0));
  EXPECT_LT((slides.force - Vec3(-2.4, -3.2, 0.0)).norm(), 1e-15);
  EXPECT_EQ(stick(friction, 0.0, k, Vec3(0.1, 0.0, 0.0)).force, Vec3(0.0, 0.0, 0.0));
}

TEST(Friction, DerivativesAreThoseOfTheForce) {
  const auto laws = {+[](double N, const Vec3& way) { return stick(friction, N, k, way); },
                     +[](double N, const Vec3& way) { return rub(friction, N, way, 0.01); }};
  for (const auto& law : laws) {
    for (const Vec3& way : {Vec3(0.1, -0.05, 0.0), Vec3(0.3, 0.4, 0.1)}) {
      const Rubbing found = law(normal, way);
      constexpr double h = 1e-6;
      for (int i = 0; i < 3; ++i) {
        const Vec3 d = h * Vec3::Unit(i);
        const Vec3 slope = (law(normal, way + d).force - law(normal, way - d).force) / (2.0 * h);
        EXPECT_LT((slope - found.by_way.col(i)).norm(), 1e-7);
      }
      const Vec3 slope = (law(normal + h, way).force - law(normal - h, way).force) / (2.0 * h);
      EXPECT_LT((slope - found.by_normal).norm(), 1e-7);
    }
  }
}

constexpr const char* effect_name = "tested";

/// A point without a radius, 0.2 m deep, which moves along the plane in steps of statics.
class Sliding : public testing::Test {
 protected:
  model::Model model;
  std::unique_ptr<kit::DenseAssembly> dense;
  model::Batch* batch = nullptr;
  model::State state;

  Sliding() {
    model::NodeSlots slots;
    slots << Vec3(0.0, 0.0, -0.2), Mat3::Identity();
    model.nodes().add(slots);
    auto load = std::make_unique<PlaneContact>(effect_name, model.nodes(), Plane{},
                                               Penalty{10.0, 0.0, 0.0}, friction);
    load->add({model::marker_at(0), 0.0, 3.0});
    model.add_load(std::move(load));
    model.freeze(model::Form::null_space);
    dense = std::make_unique<kit::DenseAssembly>(model);
    batch = kit::find_batch(model, effect_name);
    state = kit::random_state(model, 3);
    state.prev = state.next = model.nodes().reference();
  }
  /// The friction along x at a place, where the step is accepted.
  double go(double x) {
    state.next[0] = x;
    dense->prepare(state, Stencil::statics());
    const double force = -dense->residual(state, Stencil::statics(), {batch})[0];
    dense->accept(state);
    state.prev = state.next;
    return force;
  }
};

// N = 6, so 3 N of friction, and 30 N/m where it sticks.
TEST_F(Sliding, RemembersWhereItStuck) {
  EXPECT_NEAR(go(0.05), -1.5, 1e-14);
  EXPECT_NEAR(go(1.0), -3.0, 1e-14);
  EXPECT_NEAR(go(0.95), -1.5, 1e-13);
  EXPECT_NEAR(go(0.85), 1.5, 1e-13);
  std::vector<double> memory(batch->memory_size());
  ASSERT_EQ(memory.size(), 3U);
  batch->save(model::Items::owned, memory);
  EXPECT_NEAR(go(-5.0), 3.0, 1e-14);
  batch->restore(memory);
  EXPECT_NEAR(go(-5.05), 3.0, 1e-13);
  EXPECT_NEAR(go(-5.0), 1.5, 1e-12);
}

TEST(FrictionMemory, NothingIsRememberedWithoutFriction) {
  model::Model model;
  model.nodes().add(kit::random_node(10));
  PlaneContact contact(effect_name, model.nodes(), {}, {3.0, 0.0, 0.0}, {});
  contact.add({model::marker_at(0), 0.5, 2.0});
  EXPECT_EQ(contact.memory_size(), 0U);
}

}  // namespace
}  // namespace culm::contact
