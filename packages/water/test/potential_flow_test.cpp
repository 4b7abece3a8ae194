#include <culm/base/error.hpp>
#include <culm/water/potential_body.hpp>
#include <culm/water/radiation_fit.hpp>

#include <Eigen/Eigenvalues>
#include <culm_kit/temporary_folder.hpp>
#include <gmock/gmock.h>

#include <cmath>
#include <fstream>
#include <numbers>

namespace culm::water {
namespace {

using testing::HasSubstr;
using Complex = std::complex<double>;

// Two oscillations in surge and pitch that only take energy: K(t) = C exp(-a t) cos b t + ...
RadiationModel known() {
  RadiationModel model;
  RadiationModel::Term first, second;
  first.pole = {-0.4, 0.9};
  second.pole = {-0.7, 1.9};
  Vec6 u = Vec6::Zero(), v = Vec6::Zero();
  u[0] = 3.0;
  u[4] = -1.0;
  v[0] = 1.0;
  v[4] = 2.0;
  first.residue = (u * u.transpose()).cast<Complex>();
  second.residue = (v * v.transpose()).cast<Complex>();
  model.terms = {first, second};
  return model;
}

PotentialBody body_of(const RadiationModel& model) {
  PotentialBody body;
  body.infinite_mass(0, 0) = 5.0;
  body.infinite_mass(4, 4) = 7.0;
  for (int i = 1; i <= 40; ++i) {
    const double w = 0.1 * i;
    const auto K = model.at(w);
    body.radiation.push_back({w, body.infinite_mass + K.imag() / w, K.real()});
  }
  return body;
}

TEST(RadiationFit, FindsPolesAndResiduesOfSuchAModel) {
  const RadiationModel wanted = known();
  const RadiationModel found = fit_radiation(body_of(wanted), 2);
  EXPECT_LT(found.error, 1e-8);
  for (const double w : {0.05, 0.7, 1.9, 6.0}) {
    EXPECT_LT((found.at(w) - wanted.at(w)).norm(), 1e-6 * wanted.at(w).norm());
  }
}

TEST(RadiationFit, NeverMakesEnergy) {
  RadiationModel model = known();
  // damping in one combination of motions only, as of waves with one heading
  model.terms.pop_back();
  PotentialBody body = body_of(model);
  for (Radiation& one : body.radiation) one.damping *= 1.0 + 0.01 * std::sin(7.0 * one.frequency);
  const RadiationModel found = fit_radiation(body, 4);
  EXPECT_GT(found.creates, 0.0);
  EXPECT_LT(found.creates, 0.02);
  for (int i = 1; i < 400; ++i) {
    const Mat6 damping = found.at(0.05 * i).real() + found.extra;
    EXPECT_GE(Eigen::SelfAdjointEigenSolver<Mat6>(damping).eigenvalues()[0],
              -1e-9 * damping.norm());
  }
}

TEST(RadiationFit, HasNoTermsWhereNothingIsRadiated) {
  EXPECT_TRUE(fit_radiation(PotentialBody{}, 3).terms.empty());
}

class WamitFiles : public testing::Test {
 protected:
  WamitFiles() {
    write("1",
          "0 1 1 2.0\n0 1 5 1.0\n0 5 1 1.0\n-1 1 1 9.0\n6.283185307179586 1 1 3.0 0.5\n"
          "6.283185307179586 1 5 4.0 0.25\n6.283185307179586 5 1 4.0 0.25\n");
    write("3",
          "6.283185307179586 0 1 5 0 3.0 4.0\n6.283185307179586 90 1 1 0 1.0 0.0\n"
          "3.141592653589793 0 1 7 0 7.0 0.0\n3.141592653589793 90 1 1 0 1.0 0.0\n");
    write("hst", "3 3 10.0\n5 5 20.0\n");
  }

  void write(const std::string& ending, const std::string& text) const {
    std::ofstream(folder_ / ("body." + ending)) << text;
  }
  PotentialBody read() const {
    return read_wamit((folder_ / "body.1").string(), {1000.0, 10.0, 2.0}, {"deck.xml", 3, "Loads"});
  }
  std::string message() const {
    try {
      read();
    } catch (const Error& error) {
      return error.what();
    }
    return "no error";
  }

 private:
  kit::TemporaryFolder folder_;
};

// Lengths to the third power, and one more for each rotation; damping times the frequency.
TEST_F(WamitFiles, NumbersGetTheirUnits) {
  const PotentialBody body = read();
  EXPECT_DOUBLE_EQ(body.infinite_mass(0, 0), 1000.0 * 8.0 * 2.0);
  ASSERT_EQ(body.radiation.size(), 1U);
  EXPECT_DOUBLE_EQ(body.radiation[0].frequency, 1.0);
  EXPECT_DOUBLE_EQ(body.radiation[0].added_mass(0, 4), 1000.0 * 16.0 * 4.0);
  EXPECT_DOUBLE_EQ(body.radiation[0].damping(0, 0), 1000.0 * 8.0 * 0.5);
  EXPECT_DOUBLE_EQ(body.hydrostatics(2, 2), 1000.0 * 10.0 * 4.0 * 10.0);
  EXPECT_DOUBLE_EQ(body.hydrostatics(4, 4), 1000.0 * 10.0 * 16.0 * 20.0);
  EXPECT_EQ(excitation_of(body, 1.0, 0.0)[0], 40000.0 * Complex(3.0, 4.0));
  const Complex between = excitation_of(body, 1.5, 0.25 * std::numbers::pi)[0];
  EXPECT_NEAR(std::abs(between - 40000.0 * Complex(3.0, 1.0)), 0.0, 1e-6);
}

TEST_F(WamitFiles, MistakesHaveTheirPlace) {
  write("1", "6.28 1 1 3.0 0.5\n");
  EXPECT_THAT(message(),
              HasSubstr("body.1: lacks the added mass at infinite frequency, of period 0"));
  write("1", "0 1 1 2.0\n6.28 7 1 3.0 0.5\n");
  EXPECT_THAT(message(), HasSubstr("body.1:2: directions are 1 to 6, got 7"));
  write("1", "0 1 1 2.0\n6.28 1 1 x 0.5\n");
  EXPECT_THAT(message(), HasSubstr("body.1:2: must be 4 numbers, or more"));
  write("1", "0 1 1 2.0\n6.28 1 1 3.0 0.5\n");
  write("3", "6.28 0 1 5 0 3.0 4.0\n3.14 90 1 5 0 3.0 4.0\n");
  EXPECT_THAT(message(), HasSubstr("body.3: lacks the heading 90 at the period 6.28 s"));
}

TEST_F(WamitFiles, HeadingsCountWholeTurns) {
  const PotentialBody body = read();
  constexpr double turn = 2.0 * std::numbers::pi;
  EXPECT_EQ(heading_in(body, 0.5), 0.5);
  EXPECT_EQ(heading_in(body, 0.5 - turn), 0.5 - turn + turn);
  EXPECT_FALSE(heading_in(body, -0.5));
}

TEST_F(WamitFiles, EntriesComeInPairs) {
  write("1", "0 1 1 2.0\n0 1 5 1.0\n6.28 1 1 3.0 0.5\n6.28 1 5 1.0 0.5\n");
  EXPECT_THAT(message(), HasSubstr("body.1:2: has the entry 1 5 here, but the entry 5 1 nowhere"));
}

// What is missing would be zero, and of what is there twice the last would count.
TEST_F(WamitFiles, NothingIsMissingOrThereTwice) {
  write("1", "0 1 1 2.0\n6.28 1 1 3.0 0.5\n3.14 1 1 3.0 0.5\n3.14 5 5 3.0 0.5\n");
  EXPECT_THAT(message(), HasSubstr("body.1:4: has the entry 5 5 here, but not at the period 0 s"));
  write("1", "0 1 1 2.0\n6.28 1 1 3.0 0.5\n6.28 1 1 99 0.5\n");
  EXPECT_THAT(message(), HasSubstr("body.1:3: has the entry 1 1 at the period 6.28 s again, after "
                                   "line 2"));
  write("1", "0 1 1 2.0\n6.28 1 1 3.0 0.5\n");
  write("3", "6.28 0 1 5 0 3.0 4.0\n3.14 0 1 5 0 3.0 4.0\n3.14 0 5 5 0 3.0 4.0\n");
  EXPECT_THAT(message(), HasSubstr("body.3:3: has the direction 5 here, but not at the period 6.28 "
                                   "s and the heading 0"));
  write("3", "6.28 0 1 5 0 3.0 4.0\n6.28 0 1 5 0 9.0 4.0\n");
  EXPECT_THAT(message(), HasSubstr("body.3:2: has the direction 1 at the period 6.28 s and the "
                                   "heading 0 again, after line 1"));
  write("3", "6.28 0 1 5 0 3.0 4.0\n");
  write("hst", "3 3 10.0\n3 3 99\n");
  EXPECT_THAT(message(), HasSubstr("body.hst:2: has the entry 3 3 again, after line 1"));
}

TEST_F(WamitFiles, NumbersStayInRange) {
  write("1", "0 1 1 2.0\n1e-320 1 1 3.0 0.5\n");
  EXPECT_THAT(message(), HasSubstr("body.1:2: is beyond the range of numbers in SI units"));
  write("1", "0 1 1 2.0\n6.28 1 1 1e308 0.5\n");
  EXPECT_THAT(message(), HasSubstr("body.1:2: is beyond the range of numbers in SI units"));
}

}  // namespace
}  // namespace culm::water
