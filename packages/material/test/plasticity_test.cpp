#include <culm/material/box_section.hpp>
#include <culm/material/circle_section.hpp>
#include <culm/material/plane_stress_plasticity.hpp>
#include <culm/material/rectangle_section.hpp>
#include <culm/material/tube_section.hpp>
#include <culm/material/uniaxial_plasticity.hpp>

#include <culm_kit/deck_list.hpp>
#include <culm_kit/rigid_motion.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace culm::material {
namespace {

constexpr double E = 200.0, nu = 0.3;
const Plasticity metal{.yield_stress = 1.0, .isotropic = 20.0, .kinematic = 30.0};

struct Fibres {
  using Law = UniaxialPlasticity;
  static Law law(const Plasticity& constants) { return {E, constants}; }
  static Vec<1> elastic(const Law&, const Vec<1>& strain) { return E * strain; }
};
struct Layers {
  using Law = PlaneStressPlasticity;
  static Law law(const Plasticity& constants) { return {E, nu, constants}; }
  static Vec3 elastic(const Law& law, const Vec3& strain) { return law.elastic(strain); }
};

template <class Case>
class PlasticLaw : public testing::Test {
 public:
  static constexpr int L = Case::Law::num_strains;
  using Law = typename Case::Law;
  using Strain = Vec<L>;

  // Some way through strains up to several times that of yielding, and back.
  std::vector<Strain> path() {
    std::vector<Strain> strains{Strain::Zero()};
    for (int i = 0; i < 40; ++i) strains.push_back(0.02 * random.matrix<L, 1>());
    return strains;
  }
  kit::Random random{5};
};
using Cases = testing::Types<Fibres, Layers>;
TYPED_TEST_SUITE(PlasticLaw, Cases);

TYPED_TEST(PlasticLaw, WorkIsStoredOrDissipatedInTheConservingStep) {
  const auto law = TypeParam::law(metal);
  typename TypeParam::Law::Flow flow;
  const auto path = this->path();
  double dissipated = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const auto& e0 = path[i - 1];
    const auto& e1 = path[i];
    const auto stored = [&](const auto& e, const auto& of) {
      return 0.5 * e.dot(TypeParam::elastic(law, e)) + law.energy(e, of);
    };
    const auto step = law.step(e0, e1, flow, 0.5);
    const double work = (TypeParam::elastic(law, 0.5 * (e0 + e1)) - step.relief).dot(e1 - e0);
    EXPECT_NEAR(work, stored(e1, step.next) - stored(e0, flow) + step.dissipation, 1e-14);
    EXPECT_GE(step.dissipation, 0.0);
    dissipated += step.dissipation;
    flow = step.next;
  }
  EXPECT_GT(dissipated, 0.05);
}

TYPED_TEST(PlasticLaw, SlopeIsTheDerivativeOfTheRelief) {
  for (const double theta : {1.0, 0.5, 0.7}) {
    const auto law = TypeParam::law(metal);
    typename TypeParam::Law::Flow flow;
    const auto path = this->path();
    for (std::size_t i = 1; i < path.size(); ++i) {
      const auto& e0 = path[i - 1];
      const auto& e1 = path[i];
      const auto step = law.step(e0, e1, flow, theta);
      constexpr double h = 1e-7;
      for (int k = 0; k < this->L; ++k) {
        typename TypeParam::Law::Flow start = flow;
        auto ahead = e1, behind = e1;
        ahead[k] += h;
        behind[k] -= h;
        const auto slope = ((law.step(e0, ahead, start, theta).relief -
                             law.step(e0, behind, start, theta).relief) /
                            (2.0 * h))
                               .eval();
        EXPECT_LT((slope - step.slope.col(k)).norm(), 1e-5 * E) << "theta " << theta << ", " << i;
      }
      EXPECT_LT((step.slope - step.slope.transpose()).norm(), 1e-12 * E);
      flow = step.next;
    }
  }
}

// In statics the end of a step lies on the yield surface.
TEST(PlaneStressPlasticity, EndsOnTheYieldSurface) {
  const PlaneStressPlasticity law(E, nu, {1.0, 20.0, 0.0});
  PlaneStressPlasticity::Flow flow;
  kit::Random random(3);
  Vec3 before = Vec3::Zero();
  for (int i = 0; i < 20; ++i) {
    const Vec3 strain = 0.02 * random.vector();
    const auto step = law.step(before, strain, flow, 1.0);
    const double found = PlaneStressPlasticity::equivalent(law.elastic(strain) - step.relief);
    EXPECT_LE(found, (1.0 + 20.0 * step.next.accumulated) * (1.0 + 1e-13));
    if (step.dissipation > 0.0) {
      EXPECT_NEAR(found, 1.0 + 20.0 * step.next.accumulated, 1e-13);
    }
    flow = step.next;
    before = strain;
  }
}

// Stress in one direction alone: the plane law is the uniaxial one.
TEST(PlaneStressPlasticity, IsUniaxialUnderOneStress) {
  const PlaneStressPlasticity plane(E, nu, metal);
  const UniaxialPlasticity fibre(E, metal);
  PlaneStressPlasticity::Flow flow;
  UniaxialPlasticity::Flow along;
  double before = 0.0;
  for (const double e : {0.004, 0.012, -0.003, -0.02, 0.001}) {
    const auto expected = fibre.step(Vec<1>(before), Vec<1>(e), along, 1.0);
    // the strain across, by which nothing is stressed there, by Newton's method
    Vec3 strain(e, -nu * e, 0.0);
    PlasticStep<3> step;
    for (int i = 0; i < 20; ++i) {
      step = plane.step(strain, strain, flow, 1.0);
      const double across = plane.elastic(strain)[1] - step.relief[1];
      strain[1] -= across / (plane.elastic(Vec3::Unit(1))[1] - step.slope(1, 1));
    }
    EXPECT_NEAR(plane.elastic(strain)[0] - step.relief[0], E * e - expected.relief[0], 1e-12);
    EXPECT_NEAR(step.next.strain[0], expected.next.strain[0], 1e-13);
    EXPECT_NEAR(step.next.strain[1], -0.5 * expected.next.strain[0], 1e-13);
    flow = step.next;
    along = expected.next;
    before = e;
  }
}

// A step there and the way back in between: the stress of the conserving step is the mean over an
// even growth, whatever the number of steps it is cut into.
TEST(UniaxialPlasticity, TheMeanIsExact) {
  const UniaxialPlasticity law(E, metal);
  UniaxialPlasticity::Flow flow;
  flow.strain[0] = 0.003;
  flow.accumulated = 0.004;
  const double from = 0.004, to = -0.03;
  const auto whole = law.step(Vec<1>(from), Vec<1>(to), flow, 0.5);
  constexpr int parts = 1000;
  double mean = 0.0;
  for (int i = 0; i < parts; ++i) {
    const double a = from + (to - from) * i / parts;
    const double b = from + (to - from) * (i + 1) / parts;
    const auto part = law.step(Vec<1>(a), Vec<1>(b), flow, 0.5);
    mean += part.relief[0] / parts;
    flow = part.next;
  }
  EXPECT_NEAR(whole.relief[0], mean, 1e-13);
  EXPECT_NEAR(whole.next.strain[0], flow.strain[0], 1e-15);
  EXPECT_NEAR(whole.next.accumulated, flow.accumulated, 1e-15);
}

// Stretch and bending of the bundle, against those of the section.
void expect_same_stiffness(const Section& section) {
  Mat3 sum = Mat3::Zero();
  for (const Fibre& fibre : section.fibres) {
    const Vec3 map(1.0, fibre.place[1], -fibre.place[0]);
    sum += fibre.area * E * map * map.transpose();
  }
  const Mat3 expected = section.stiffness.block<3, 3>(2, 2);
  EXPECT_LT((sum - expected).norm(), 1e-13 * expected.norm());
}

template <class Type>
Section yielding(const Type&, kit::GivenValues values) {
  values.insert(values.end(), {{"Young Modulus", E},
                               {"Poisson Ratio", nu},
                               {"Offset", std::vector<double>{0.1, -0.3}},
                               {"Angle", 0.4}});
  Options options = kit::deck_list(Type::schema(), values);
  options.add_list(kit::deck_list(*Type::schema().find_slot("Plasticity")->find(""),
                                  {{"Yield Stress", 1.0}}, "Plasticity"));
  return Type::make(options);
}

TEST(Fibres, HaveTheStiffnessOfTheirSection) {
  expect_same_stiffness(yielding(RectangleSection{}, {{"Width", 0.3}, {"Height", 0.7}}));
  expect_same_stiffness(yielding(CircleSection{}, {{"Radius", 0.3}}));
  expect_same_stiffness(yielding(TubeSection{}, {{"Outer Radius", 0.3}, {"Wall Thickness", 0.1}}));
  expect_same_stiffness(yielding(
      BoxSection{},
      {{"Width", 0.3}, {"Height", 0.7}, {"Flange Thickness", 0.05}, {"Web Thickness", 0.02}}));
}

// Else a part of the moment would never yield.
TEST(Fibres, HaveTheStiffnessOfSectionsInBetween) {
  const Section thick = yielding(RectangleSection{}, {{"Width", 0.3}, {"Height", 0.7}});
  Section thin = yielding(RectangleSection{}, {{"Width", 0.2}, {"Height", 0.3}});
  thin = shifted(rotated(thin, 0.3), {0.05, 0.1});
  for (const double t : {0.0, 0.3, 0.5, 1.0}) expect_same_stiffness(interpolate(thick, thin, t));
}

TEST(Fibres, AreInTheMiddleOfTwoSectionsInBetween) {
  Section thin, thick;
  thin.fibres = rectangle_fibres({-1.0, -1.0}, {1.0, 1.0}, {1, 1});
  thick.fibres = rectangle_fibres({-2.0, -2.0}, {2.0, 2.0}, {1, 1});
  thin.plasticity = {E, metal};
  thick.plasticity = {3.0 * E, {.yield_stress = 3.0, .isotropic = 60.0, .kinematic = 90.0}};
  const Section middle = interpolate(thin, thick, 0.5);
  ASSERT_EQ(middle.fibres.size(), 4u);
  EXPECT_NEAR(middle.fibres[0].place[0], -1.5 / std::sqrt(3.0), 1e-15);
  EXPECT_NEAR(middle.fibres[0].area, 2.5, 1e-15);
  const UniaxialPlasticity expected(2.0 * E,
                                    {.yield_stress = 2.0, .isotropic = 40.0, .kinematic = 60.0});
  const auto step = middle.plasticity.step(Vec<1>(0.0), Vec<1>(0.02), {}, 1.0);
  EXPECT_NEAR(step.relief[0], expected.step(Vec<1>(0.0), Vec<1>(0.02), {}, 1.0).relief[0], 1e-13);
}

TEST(Fibres, OfRingsNeedSomeDirections) {
  Options options = kit::deck_list(CircleSection::schema(),
                                   {{"Young Modulus", E}, {"Poisson Ratio", nu}, {"Radius", 0.3}});
  const auto mistakes = [&](int around) {
    Options with = options;
    with.add_list(kit::deck_list(*CircleSection::schema().find_slot("Plasticity")->find(""),
                                 {{"Yield Stress", 1.0}, {"Cells", std::vector<int>{around, 2}}},
                                 "Plasticity"));
    return kit::mistakes_in(CircleSection::schema(), with).size();
  };
  EXPECT_EQ(mistakes(3), 1u);
  EXPECT_EQ(mistakes(4), 0u);
}

// Even numbers of cells give the plastic moment of a rectangle, b h^2 / 4.
TEST(Fibres, BundlesHaveThePlasticMoment) {
  double moment = 0.0;
  for (const Fibre& fibre : rectangle_fibres({-0.1, -0.4}, {0.1, 0.4}, {1, 2})) {
    moment += fibre.area * std::abs(fibre.place[1]);
  }
  EXPECT_NEAR(moment, 0.2 * 0.64 / 4.0, 1e-16);
}

}  // namespace
}  // namespace culm::material
