#include <culm/analysis/books.hpp>
#include <culm/analysis/certificate.hpp>
#include <culm/model/dead_weight.hpp>

#include "motion.hpp"

#include <gtest/gtest.h>

namespace culm::analysis {
namespace {

double number(const Certificate& certificate, const std::string& name) {
  for (const auto& [what, value] : certificate.numbers()) {
    if (what == name) return value;
  }
  throw std::runtime_error("no number " + name);
}

// Gravity on the first node of a chain, or what would be gravity if it did not change.
class Weight final : public model::Batch, public model::DeadWeight {
 public:
  explicit Weight(bool has_potential) : has_potential_(has_potential) {}
  const model::Effect& effect() const override { return effect_; }
  int size() const override { return 1; }
  std::vector<int> blocks(int, const model::UnknownTable& unknowns) const override {
    return {unknowns.node_block(0)};
  }
  bool has_tangent() const override { return false; }
  void place(model::Placement placement, model::Form) override {
    is_owned_ = !placement.items.empty() && placement.owned[0];
  }
  void prepare(const model::State&, const Stencil&) override {}
  Verdict assemble(const model::State&, const Stencil&, Want, model::Target&) override {
    return Verdict::ok;
  }
  void extrapolate(const model::State&, const Stencil&, const model::Coordinates&) override {}
  double stored_energy(const model::Coordinates&) const override { return 0.0; }
  model::StepWork step_work(const model::State&, const Stencil&) const override {
    model::StepWork work;
    if (!is_owned_) return work;
    work.external = has_potential_ ? 0.0 : 3.0;
    work.force = Vec3(0.0, 0.0, -2.0);
    return work;
  }
  bool has_potential() const override { return has_potential_; }

 private:
  model::Effect effect_{"Weight"};
  bool has_potential_;
  bool is_owned_ = false;
};

// Of a load with a potential there is nothing but force and moment to book.
TEST(Books, AskDeadWeightsWhereForcesCount) {
  for (const bool has_potential : {true, false}) {
    const Motion chain([&](model::Model& model) {
      build_free_chain(model);
      model.add_load(std::make_unique<Weight>(has_potential));
    });
    for (const bool with_momenta : {true, false}) {
      Books books(*chain.system, with_momenta);
      const model::StepWork work = books.add(chain.state, Stencil::midpoint(0.1));
      EXPECT_EQ(work.external, has_potential ? 0.0 : 3.0);
      EXPECT_EQ(books.forces(), with_momenta ? 2.0 : 0.0);
    }
  }
}

TEST(Certificate, HoldsForTheConservingScheme) {
  Motion chain(build_free_chain);
  chain.advance(0.05, 50);
  const Certificate& certificate = chain.stepper->certificate();
  EXPECT_LT(number(certificate, "relative energy drift"), 1e-11);
  EXPECT_LT(number(certificate, "relative linear momentum drift"), 1e-11);
  EXPECT_LT(number(certificate, "relative angular momentum drift"), 1e-11);
  EXPECT_NE(certificate.text().find("kept"), std::string::npos);
  EXPECT_EQ(certificate.text().find("BROKEN"), std::string::npos);
  EXPECT_EQ(certificate.broken(), "");
}

TEST(Certificate, SeesEnergyAndMomentumThatAppearFromNowhere) {
  Motion chain(build_free_chain);
  chain.advance(0.05, 5);
  for (double& v : chain.state.velocity) v *= 1.0 + 1e-6;
  chain.advance(0.05, 5);
  const Certificate& certificate = chain.stepper->certificate();
  EXPECT_GT(number(certificate, "relative energy drift"), 1e-7);
  EXPECT_GT(number(certificate, "relative linear momentum drift"), 1e-7);
  EXPECT_NE(certificate.text().find("BROKEN"), std::string::npos);
  EXPECT_NE(certificate.broken().find("energy balance "), std::string::npos);
  EXPECT_NE(certificate.broken().find(" (kept up to 1e-09), linear momentum "), std::string::npos);
  EXPECT_EQ(certificate.broken().find("constraints"), std::string::npos);
}

// A program may end a motion wherever it likes, also between two comparisons.
TEST(Certificate, ComparesWhereAMotionEnds) {
  Motion chain(build_free_chain);
  const auto kinetic_energy = [&] {
    return chain.system->momentum(chain.state.next, chain.state.velocity).kinetic_energy;
  };
  const double at_start = kinetic_energy();
  chain.advance(0.05, 7);
  chain.stepper->finish();
  const double there = kinetic_energy();
  EXPECT_NE(there, at_start);
  const Certificate& certificate = chain.stepper->certificate();
  EXPECT_DOUBLE_EQ(number(certificate, "kinetic energy"), there);
  EXPECT_EQ(certificate.broken(), "");
}

TEST(Certificate, SeesWhatBreaksJustBeforeTheEnd) {
  Motion chain(build_free_chain);
  chain.advance(0.05, 10);
  for (double& v : chain.state.velocity) v *= 1.0 + 1e-6;
  chain.advance(0.05, 3);
  EXPECT_EQ(chain.stepper->certificate().broken(), "");
  chain.stepper->finish();
  EXPECT_NE(chain.stepper->certificate().broken(), "");
}

TEST(Certificate, WhatIsNotANumberIsNotKept) {
  Motion chain(build_free_chain);
  Certificate certificate(*chain.system, true, true);
  certificate.start(chain.state);
  for (double& v : chain.state.velocity) v *= 1e300;  // their energies are beyond all numbers
  certificate.compare(chain.state);
  EXPECT_NE(certificate.broken(), "");
}

TEST(Certificate, PromisesNothingForGeneralisedAlpha) {
  Motion chain(build_free_chain, std::make_unique<GeneralisedAlphaScheme>(0.5));
  chain.advance(0.05, 50);
  const Certificate& certificate = chain.stepper->certificate();
  EXPECT_GT(number(certificate, "relative energy drift"), 1e-6);
  EXPECT_NE(certificate.text().find("not promised"), std::string::npos);
  EXPECT_EQ(certificate.broken(), "");
}

TEST(Certificate, JudgesMomentaThatVanishByTheMotionInside) {
  // spins about its middle: linear momentum is rounding only
  Motion chain([](model::Model& model) {
    kit::add_chain(model, 2);
    for (int node = 0; node <= 2; ++node) {
      const Vec3 middle =
          0.25 * (model::NodeTable::slots(model.nodes().reference(), 0).col(0) +
                  2.0 * model::NodeTable::slots(model.nodes().reference(), 1).col(0) +
                  model::NodeTable::slots(model.nodes().reference(), 2).col(0));
      model.add_initial_velocity({node, Vec3::Zero(), Vec3(0, 0, 1.0), middle});
    }
  });
  chain.advance(0.05, 20);
  const Certificate& certificate = chain.stepper->certificate();
  EXPECT_LT(number(certificate, "relative linear momentum drift"), 1e-11);
}

TEST(Certificate, ReportsTheRatesOfConstraintsAsAShareOfTheVelocity) {
  Motion chain(build_free_chain);
  chain.advance(0.05);
  Certificate certificate = chain.stepper->certificate();
  certificate.finish(0.02, 4.0);
  EXPECT_DOUBLE_EQ(number(certificate, "hidden constraint violation"), 0.005);
}

}  // namespace
}  // namespace culm::analysis
