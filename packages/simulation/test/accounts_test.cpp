#include <culm/base/error.hpp>

#include "live_deck.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

namespace culm::simulation {
namespace {

using Numbers = std::map<std::string, double>;

std::string force(const std::string& name, const std::string& force, const std::string& account) {
  return "<ParameterList name=\"" + name +
         R"("><Parameter name="Type" value="Force"/><Parameter name="Node" value="beam/last"/>
            <Parameter name="Function" value="wave"/><Parameter name="Force" value=")" +
         force + "\"/>" + account + "</ParameterList>";
}

std::string account(const std::string& name) {
  return R"(<Parameter name="Account" value=")" + name + "\"/>";
}

std::string moving(const std::string& loads) {
  return beam_deck(clamp + R"~(<ParameterList name="Functions"><ParameterList name="wave">
      <Parameter name="Type" value="Expression"/><Parameter name="Expression" value="sin(20*t)"/>
    </ParameterList></ParameterList><ParameterList name="Loads">)~" +
                   loads + "</ParameterList>");
}

/// What the certificate says, and the work of unit forces on the end of the beam: one per axis,
/// added up from its way and the function in the middle of the steps.
struct Books {
  explicit Books(const std::string& deck) {
    Live live(deck);
    analysis::Stepper& stepper = live.simulation.begin("motion");
    const int end = live.simulation.nodes("beam/last").front();
    Vec3 before = live.simulation.position(end);
    double time = 0.0;
    while (!stepper.is_at_end()) {
      const analysis::StepReport& report = stepper.attempt(stepper.proposal());
      if (!report.accepted) throw std::runtime_error("a step did not converge");
      const Vec3 now = live.simulation.position(end);
      work += std::sin(20.0 * 0.5 * (time + report.time)) * (now - before);
      before = now;
      time = report.time;
      stepper.accept();
    }
    const analysis::AnalysisReport report = stepper.finish();
    numbers.insert(report.numbers.begin(), report.numbers.end());
    text = report.text;
  }

  Numbers numbers;
  std::string text;
  Vec3 work = Vec3::Zero();
};

int count(const Numbers& numbers, const std::string& part) {
  return static_cast<int>(std::count_if(numbers.begin(), numbers.end(), [&](const auto& number) {
    return number.first.find(part) != std::string::npos;
  }));
}

TEST(Accounts, SumTheWorkOfTheirLoads) {
  const Books books(
      moving(force("a", "{0, 1, 0}", account("engine")) + force("b", "{0, 0, 2}", account("wind")) +
             force("c", "{0, 3, 0}", account("engine")) + force("d", "{4, 0, 0}", "")));
  const double size = std::abs(books.numbers.at("work of loads"));
  EXPECT_GT(size, 1e-4);
  EXPECT_NEAR(books.numbers.at("work of loads, engine"), 4.0 * books.work.y(), 1e-10 * size);
  EXPECT_NEAR(books.numbers.at("work of loads, wind"), 2.0 * books.work.z(), 1e-10 * size);
  EXPECT_NEAR(books.numbers.at("work of loads, others"), 4.0 * books.work.x(), 1e-10 * size);
  EXPECT_NEAR(books.numbers.at("work of loads"),
              4.0 * books.work.y() + 2.0 * books.work.z() + 4.0 * books.work.x(), 1e-10 * size);
  EXPECT_LT(books.numbers.at("relative energy drift"), 1e-10);
  EXPECT_NE(books.text.find("\n    engine "), std::string::npos) << books.text;
}

TEST(Accounts, AreNotThereWhereNobodyNamesOne) {
  const Books books(moving(force("a", "{0, 1, 0}", "")));
  EXPECT_EQ(count(books.numbers, ", "), 0);
  EXPECT_EQ(books.text.find("others"), std::string::npos);
}

TEST(Accounts, OfDampersStandBelowWhatTheyTake) {
  const Books books(
      moving(force("a", "{0, 1, 0}", "") +
             R"(<ParameterList name="brake"><Parameter name="Type" value="Ground Damper"/>
      <Parameter name="Node" value="beam/last"/><Parameter name="Damping" value="0.3"/>
      <Parameter name="Anchor" value="{1, -1, 0}"/>)" +
             account("brake") + "</ParameterList>"));
  EXPECT_GT(books.numbers.at("energy taken by dampers, brake"), 0.0);
  EXPECT_EQ(books.numbers.at("energy taken by dampers, brake"),
            books.numbers.at("energy taken by dampers"));
  EXPECT_EQ(count(books.numbers, "work of loads, "), 0);
}

TEST(Accounts, NeedANameOfTheirOwn) {
  const auto refused = [](const std::string& loads) -> std::string {
    try {
      Live live(moving(loads));
    } catch (const InputError& error) {
      return error.issues().front().message;
    }
    return "";
  };
  EXPECT_EQ(refused(force("a", "{0, 1, 0}", account("others"))),
            "must be a name of its own; 'others' is all that has no account");
  EXPECT_EQ(refused(force("a", "{0, 1, 0}", account(""))),
            "must be a name of its own; 'others' is all that has no account");
}

}  // namespace
}  // namespace culm::simulation
