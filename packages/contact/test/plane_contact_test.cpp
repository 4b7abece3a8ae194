#include <culm/contact/plane_contact.hpp>

#include "contact_laws.hpp"

#include <gtest/gtest.h>

#include <memory>

namespace culm::contact {
namespace {

struct PlaneCase {
  double height;  ///< of the plane
  Penalty penalty;
  Friction friction;
};

// Pressed all the time, through the plane within the step, damped, sliding, sticking.
const PlaneCase plane_cases[] = {{9.0, {3.0, 0.0, 0.0}, {}},
                                 {0.3, {3.0, 4.0, 0.0}, {}},
                                 {9.0, {3.0, 0.5, 0.1}, {}},
                                 {9.0, {3.0, 0.5, 0.1}, {0.4, 2.0}},
                                 {9.0, {3.0, 0.5, 0.0}, {0.4, 50.0}}};

/// A point between two nodes, off their axis, and a sphere about a third.
void fill_with_plane(model::Model& model, const PlaneCase& data, bool with_slave) {
  for (const int seed : {10, 11, 12}) model.nodes().add(kit::random_node(seed));
  const Vec3 normal = Vec3(0.1, -0.3, 1.0).normalized();
  auto load = std::make_unique<PlaneContact>(
      effect, model.nodes(), Plane{data.height * normal, normal}, data.penalty, data.friction);
  load->add({{{0, 1}, {0.3, 0.7}, Vec3(0.2, -0.1, 0.4)}, 0.5, 1.7});
  load->add({model::marker_at(2), 0.3, 0.6});
  model.add_load(std::move(load));
  if (with_slave) model.add_rigid_link("link", 0, model.nodes().add(kit::random_node(20)));
}

TEST(PlaneContact, ObeysTheLawsOfBatches) { expect_laws_of_batches(plane_cases, fill_with_plane); }

TEST(PlaneContact, WorkOfAStepIsAccountedFor) {
  expect_work_is_accounted_for(plane_cases, fill_with_plane, [](const auto&...) {});
}

TEST(PlaneContact, TellsWhatTouches) {
  model::Model model;
  const int node = model.nodes().add(kit::random_node(10));
  PlaneContact contact(effect, model.nodes(), {Vec3::Zero(), Vec3::UnitZ()}, {3.0, 0.0, 0.0}, {});
  contact.add({model::marker_at(node), 0.5, 2.0});
  model::Coordinates q = model.nodes().reference();
  q[2] = 0.1;
  EXPECT_NEAR(contact.touch(q).depth, 0.4, 1e-15);
  EXPECT_NEAR(contact.touch(q).force, 2.4, 1e-15);
  EXPECT_EQ(contact.touch(q).area, 2.0);
  q[2] = 0.6;
  EXPECT_NEAR(contact.touch(q).depth, -0.1, 1e-15);
  EXPECT_EQ(contact.touch(q).force, 0.0);
}

}  // namespace
}  // namespace culm::contact
