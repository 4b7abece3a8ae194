#include <culm/base/error.hpp>
#include <culm/model/amplitude.hpp>

#include <culm_kit/deck_list.hpp>
#include <culm_kit/temporary_folder.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numbers>
#include <string>
#include <vector>

namespace culm::model {
namespace {

using testing::ElementsAre;
using Numbers = std::vector<double>;

class Functions : public testing::Test {
 protected:
  Registry<Amplitude> registry;
  Functions() { register_amplitudes(registry); }

  Amplitude make(const std::string& type, const kit::GivenValues& values) const {
    const Schema schema = registry.variants().at(type);
    const Options options = kit::deck_list(schema, values, "function");
    EXPECT_THAT(kit::mistakes_in(schema, options), ElementsAre());
    return registry.make(type, options);
  }
  Numbers values(const std::string& type, const kit::GivenValues& given,
                 const Numbers& times) const {
    const Amplitude amplitude = make(type, given);
    Numbers result;
    for (double time : times) result.push_back(amplitude.at(time));
    return result;
  }
  static double in_step(const Amplitude& amplitude, double start, double end, double theta) {
    State state;
    state.time_prev = start;
    state.time = end;
    return amplitude.in_step(state, {end - start, theta, theta});
  }
};

// @source formulation 3.5, with t0 = 2 and a = 3
TEST_F(Functions, HaveTheShapesOfTheFormulation) {
  const Numbers times = {-1.0, 0.0, 0.5, 1.0, 1.5, 2.0, 3.0};
  const auto shape = [&](const char* type, const char* span) {
    return values(type, {{span, 2.0}, {"Intensity", 3.0}}, times);
  };
  EXPECT_THAT(shape("Linear", "Duration"), ElementsAre(-1.5, 0.0, 0.75, 1.5, 2.25, 3.0, 4.5));
  EXPECT_THAT(shape("Linear Then Zero", "Duration"),
              ElementsAre(-1.5, 0.0, 0.75, 1.5, 2.25, 3.0, 0.0));
  EXPECT_THAT(shape("Linear Then Constant", "Duration"),
              ElementsAre(-1.5, 0.0, 0.75, 1.5, 2.25, 3.0, 3.0));
  EXPECT_THAT(shape("Triangle", "Duration"), ElementsAre(0.0, 0.0, 1.5, 3.0, 1.5, 0.0, 0.0));
  EXPECT_THAT(shape("Square", "Duration"), ElementsAre(3.0, 3.0, 3.0, 3.0, 3.0, 3.0, 0.0));
  EXPECT_THAT(shape("Heaviside", "Start"), ElementsAre(0.0, 0.0, 0.0, 0.0, 0.0, 3.0, 3.0));
  EXPECT_THAT(values("Constant", {{"Intensity", 3.0}}, {-1.0, 5.0}), ElementsAre(3.0, 3.0));
  EXPECT_NEAR(make("Sinusoidal", {{"Period", 2.0}}).at(0.25), std::numbers::sqrt2 / 2.0, 1e-15);
}

TEST_F(Functions, RampIsTheLoadParameter) {
  EXPECT_EQ(Amplitude::ramp().at(-0.5), 0.0);
  EXPECT_EQ(Amplitude::ramp().at(0.3), 0.3);
  EXPECT_EQ(Amplitude::ramp().at(7.0), 1.0);
}

TEST_F(Functions, ThatOfAPathHasNoBounds) {
  EXPECT_EQ(Amplitude::level().at(-0.5), -0.5);
  EXPECT_EQ(Amplitude::level().at(7.0), 7.0);
}

TEST_F(Functions, ActInAStepAtTheta) {
  const Amplitude amplitude = make("Linear", {{"Duration", 1.0}});
  EXPECT_DOUBLE_EQ(in_step(amplitude, 0.2, 0.6, 0.5), 0.4);
  EXPECT_DOUBLE_EQ(in_step(amplitude, 0.2, 0.6, 1.0), 0.6);
}

TEST_F(Functions, DeltaHasTheSameImpulseForAnyStep) {
  const Amplitude delta = make("Delta", {{"Time", 0.5}, {"Intensity", 3.0}});
  for (int steps : {1, 7, 10, 64}) {
    double impulse = 0.0;
    for (int i = 0; i < steps; ++i) {
      const double start = static_cast<double>(i) / steps;
      const double end = static_cast<double>(i + 1) / steps;
      impulse += in_step(delta, start, end, 0.5) * (end - start);
    }
    EXPECT_NEAR(impulse, 3.0, 1e-15);
  }
  EXPECT_FALSE(delta.is_function_of_time());
}

TEST_F(Functions, RandomDrawsOncePerStepAndRepeatably) {
  const Amplitude one = make("Random", {{"Seed", 1}});
  const Amplitude other = make("Random", {{"Seed", 2}});
  EXPECT_EQ(in_step(one, 0.1, 0.2, 0.5), in_step(one, 0.1, 0.15, 1.0));
  EXPECT_NE(in_step(one, 0.1, 0.2, 0.5), in_step(other, 0.1, 0.2, 0.5));
  EXPECT_FALSE(one.is_function_of_time());
}

// Mean 0, variance 1/3, no correlation of neighbours; over n draws their standard deviations are
// sqrt(1 / 3 n), sqrt(4 / 45 n) and 1 / (3 sqrt(n)). The draws are fixed: no failure by chance.
TEST_F(Functions, RandomIsUniform) {
  const Amplitude noise = make("Random", {{"Seed", 5}});
  constexpr int n = 10000;
  double sum = 0.0;
  double squares = 0.0;
  double previous = 0.0;
  double products = 0.0;
  for (int i = 0; i < n; ++i) {
    const double x = in_step(noise, 0.01 * i, 0.01 * (i + 1), 0.5);
    ASSERT_LE(std::abs(x), 1.0);
    sum += x;
    squares += x * x;
    products += x * previous;
    previous = x;
  }
  EXPECT_LT(std::abs(sum / n), 5.0 * std::sqrt(1.0 / (3.0 * n)));
  EXPECT_LT(std::abs(squares / n - 1.0 / 3.0), 5.0 * std::sqrt(4.0 / (45.0 * n)));
  EXPECT_LT(std::abs(products / n), 5.0 / (3.0 * std::sqrt(n)));
}

TEST_F(Functions, TablesAreLinearInsideAndConstantOutside) {
  EXPECT_THAT(values("Table",
                     {{"Times", Numbers{1.0, 2.0, 4.0}},
                      {"Values", Numbers{0.0, 1.0, -1.0}},
                      {"Intensity", 2.0}},
                     {0.0, 1.0, 1.5, 2.0, 3.0, 4.0, 9.0}),
              ElementsAre(0.0, 0.0, 1.0, 2.0, 0.0, -2.0, -2.0));
}

TEST_F(Functions, TablesHaveIncreasingTimesAndAsManyValues) {
  const Schema schema = registry.variants().at("Table");
  const auto mistakes = [&](const Numbers& times, const Numbers& table_values) {
    return kit::mistakes_in(schema,
                            kit::deck_list(schema, {{"Times", times}, {"Values", table_values}}));
  };
  EXPECT_THAT(mistakes({1.0, 2.0}, {1.0}),
              ElementsAre("must have as many items as Values, got 2 and 1"));
  EXPECT_THAT(mistakes({1.0, 2.5, 2.5}, {1.0, 2.0, 3.0}),
              ElementsAre("must increase, got 2.5 before 2.5"));
}

TEST_F(Functions, ExpressionsAreFormulasInTime) {
  EXPECT_THAT(values("Expression",
                     {{"Expression", std::string("t < 1 ? t^2 : 2*t - 1")}, {"Intensity", 2.0}},
                     {-1.0, 0.5, 1.0, 3.0}),
              ElementsAre(2.0, 0.5, 2.0, 10.0));
  EXPECT_THAT(values("Expression", {{"Expression", std::string("cos(pi*t) + e^0")}}, {1.0, 2.0}),
              ElementsAre(0.0, 2.0));
}

TEST_F(Functions, MistakesInExpressionsAreNamedWithTheirPlace) {
  const Schema schema = registry.variants().at("Expression");
  const auto mistake = [&](const std::string& text) {
    return kit::mistakes_in(schema, kit::deck_list(schema, {{"Expression", text}}));
  };
  EXPECT_THAT(mistake("3 + omega*t"),
              ElementsAre(testing::StartsWith("must be a formula in t, got '3 + omega*t': mistake "
                                              "at character 5, 'omega' (")));
  EXPECT_THAT(mistake("3*(t + 1"), ElementsAre(testing::HasSubstr("mistake at character 10")));
  EXPECT_THAT(mistake("t, 2"), ElementsAre("must be one formula in t, got 't, 2'"));
  EXPECT_THAT(mistake(" "), ElementsAre("must be a formula in t, got ''"));
  EXPECT_THAT(mistake("sin(t)"), ElementsAre());
}

TEST_F(Functions, AnExpressionThatIsNotFiniteIsAMistakeOfTheDeck) {
  const Amplitude pole = make("Expression", {{"Expression", std::string("1/t")}});
  EXPECT_EQ(pole.at(2.0), 0.5);
  EXPECT_THROW(pole.at(0.0), InputError);
}

class FunctionFile : public Functions {
 protected:
  const kit::TemporaryFolder folder;

  std::string write(const std::string& text) const {
    const std::string path = (folder / "gust.csv").string();
    std::ofstream(path) << text;
    return path;
  }
  /// The function of "gust.csv" beside the deck.
  Amplitude read(const std::string& name = "gust.csv") const {
    const Where where{(folder / "deck.xml").string(), 7, "Functions / gust / File Name"};
    const Schema schema = registry.variants().at("File");
    Options options = kit::deck_list(schema);
    options.set("File Name", name, true, where);
    return registry.make("File", options);
  }
  template <class Error>
  std::string message() const {
    try {
      read();
    } catch (const Error& error) {
      return error.what();
    }
    return "nothing was thrown";
  }
};

TEST_F(FunctionFile, LiesBesideTheDeck) {
  const std::string path = write("# time, value\n0, 1\n\n 1.0 , -2e0 # turn\n3,4\r\n");
  EXPECT_EQ(read().at(0.5), -0.5);
  EXPECT_EQ(read().at(3.5), 4.0);
  EXPECT_EQ(read(path).at(2.0), 1.0);  // an absolute name stays as it is
}

TEST_F(FunctionFile, MistakesNameFileAndLine) {
  const std::string path = write("0, 1\n1; 2\n1, x\n2, 3, 4\n3, 1\n3, 2\n");
  EXPECT_EQ(message<InputError>(), path + ":2: must be 'time, value', got '1; 2'\n" +      //
                                       path + ":3: must be 'time, value', got '1, x'\n" +  //
                                       path + ":4: must be 'time, value', got '2, 3, 4'\n" + path +
                                       ":6: times must increase, got 3 after 3");
}

TEST_F(FunctionFile, AnEmptyFileIsNoFunction) {
  const std::string path = write("# nothing\n");
  EXPECT_EQ(message<InputError>(), path + ": holds no points");
}

TEST_F(FunctionFile, AMissingFileIsNamedWithThePlaceThatAsksForIt) {
  const std::string deck = (folder / "deck.xml").string();
  EXPECT_EQ(message<FileError>(), (folder / "gust.csv").string() + ": there is no such file; " +
                                      deck + ":7: Functions / gust / File Name asks for it");
}

}  // namespace
}  // namespace culm::model
