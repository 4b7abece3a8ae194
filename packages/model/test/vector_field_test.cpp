#include <culm/base/error.hpp>
#include <culm/model/vector_field.hpp>

#include <culm_kit/deck_list.hpp>
#include <culm_kit/temporary_folder.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <string>
#include <vector>

namespace culm::model {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class Fields : public testing::Test {
 protected:
  Fields() { register_vector_fields(registry_); }

  SharedField make(const std::string& type, const kit::GivenValues& values) const {
    const Schema schema = registry_.variants().at(type);
    const Options options = kit::deck_list(schema, values, "field");
    EXPECT_THAT(kit::mistakes_in(schema, options), ElementsAre());
    return registry_.make(type, options);
  }
  std::string file(const std::string& text) const {
    const auto path = folder_ / "grid.csv";
    std::ofstream(path) << text;
    return path.string();
  }
  static Mat3 differences(const VectorField& field, const Vec3& x, double t) {
    Mat3 gradient;
    for (int j = 0; j < 3; ++j) {
      const Vec3 step = 1e-4 * Vec3::Unit(j);
      gradient.col(j) = (field.value(x + step, t) - field.value(x - step, t)) / 2e-4;
    }
    return gradient;
  }

 private:
  Registry<SharedField> registry_;
  kit::TemporaryFolder folder_;
};

TEST_F(Fields, UniformIsTheSameEverywhere) {
  const SharedField field = make("Uniform", {{"Vector", std::vector{1.0, -2.0, 3.0}}});
  EXPECT_EQ(field->value(Vec3(4.0, 5.0, 6.0), 7.0), Vec3(1.0, -2.0, 3.0));
  EXPECT_TRUE(field->gradient(Vec3::Ones(), 0.0).isZero(0.0));
}

TEST_F(Fields, FormulasKnowPlaceAndTime) {
  const SharedField field =
      make("Formula", {{"X", std::string("8*(z/10)^0.2*cos(t)")}, {"Z", std::string("x*y - t")}});
  const Vec3 x(0.3, -1.2, 20.0);
  EXPECT_NEAR(field->value(x, 0.5)[0], 8.0 * std::pow(2.0, 0.2) * std::cos(0.5), 1e-14);
  EXPECT_EQ(field->value(x, 0.5)[1], 0.0);
  EXPECT_NEAR(field->value(x, 0.5)[2], -0.86, 1e-15);
  EXPECT_LT((field->gradient(x, 0.5) - differences(*field, x, 0.5)).norm(), 1e-8);
}

TEST_F(Fields, FormulasMustBeFormulasAndFinite) {
  Registry<SharedField> registry;
  register_vector_fields(registry);
  const Schema schema = registry.variants().at("Formula");
  EXPECT_THAT(kit::mistakes_in(schema, kit::deck_list(schema, {{"X", std::string("x +")}}, "f")),
              ElementsAre(HasSubstr("must be a formula in x, y, z and t")));
  const SharedField field = make("Formula", {{"Y", std::string("1/z")}});
  EXPECT_THROW((void)field->value(Vec3::Zero(), 0.0), InputError);
}

// A grid reproduces what is linear along each axis, and keeps its border beyond.
TEST_F(Fields, GridIsLinearBetweenItsPoints) {
  const auto exact = [](double t, const Vec3& x) {
    return Vec3(1.0 + t * x[0] * x[2], x[2] - t, 2.0 * x[0]);
  };
  std::string text = "# t, x, y, z, X, Y, Z\n";
  for (const double z : {-1.0, 0.5, 3.0}) {
    for (const double x : {0.0, 2.0}) {
      for (const double t : {0.0, 1.0}) {
        const Vec3 v = exact(t, Vec3(x, 0.0, z));
        for (const double one : {t, x, 0.0, z, v[0], v[1]}) text += std::to_string(one) + ", ";
        text += std::to_string(v[2]) + "\n";
      }
    }
  }
  const SharedField field = make("Grid", {{"File Name", file(text)}});
  for (const Vec3& x : {Vec3(0.4, 0.0, 2.0), Vec3(1.7, 5.0, -0.3)}) {
    EXPECT_LT((field->value(x, 0.3) - exact(0.3, x)).norm(), 1e-14);
    EXPECT_LT((field->gradient(x, 0.3) - differences(*field, x, 0.3)).norm(), 1e-10);
  }
  EXPECT_LT((field->value(Vec3(9.0, 0.0, 9.0), 9.0) - exact(1.0, Vec3(2.0, 0.0, 3.0))).norm(),
            1e-14);
}

TEST_F(Fields, GridWithHolesIsRefused) {
  EXPECT_THROW(make("Grid", {{"File Name", file("0, 0, 0, 1, 1, 1\n1, 0, 1, 1, 1, 1\n")}}),
               InputError);
  EXPECT_THROW(make("Grid", {{"File Name", file("0, 0, 0, 1, 1\n")}}), InputError);
}

}  // namespace
}  // namespace culm::model
