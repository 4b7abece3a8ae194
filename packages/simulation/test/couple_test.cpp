#include <culm/base/error.hpp>
#include <culm/simulation/couple.hpp>

#include "live_deck.hpp"

#include <gtest/gtest.h>

#include <map>
#include <string>

namespace culm::simulation {
namespace {

const std::string gust = R"(<ParameterList name="Loads"><ParameterList name="gust">
  <Parameter name="Type" value="Force"/> <Parameter name="Node" value="beam/last"/>
  <Parameter name="Force" value="{0.1, 0.5, -0.2}"/> <Parameter name="Function" value="Constant"/>
</ParameterList></ParameterList>)";

const std::string port = R"(<ParameterList name="Ports"><ParameterList name="tip">
  <Parameter name="Type" value="Points"/> <Parameter name="Points" value="{beam/last}"/>
  <Parameter name="Offset" value="{0.1, 0.05, 0}"/>
</ParameterList></ParameterList>)";

// The same mass in the model.
std::string mass_of(double mass) {
  return R"(<ParameterList name="Masses"><ParameterList name="tip">
  <Parameter name="Type" value="Point Mass"/> <Parameter name="Node" value="beam/last"/>
  <Parameter name="Mass" value=")" +
         std::to_string(mass) + R"("/> <Parameter name="Offset" value="{0.1, 0.05, 0}"/>
</ParameterList></ParameterList>)";
}

Vec3 tip_of(Simulation& simulation) {
  return simulation.position(simulation.nodes("beam/last").front());
}

// A mass on a lever behind the port is a mass in the model, however heavy it is, and the energy
// that crosses the port is the same on both sides.
TEST(Couple, AMassBehindAPortIsAMassInTheModel) {
  for (const double mass : {0.1, 1.0, 100.0}) {
    Live together(beam_deck(clamp + mass_of(mass) + gust));
    analysis::run(together.simulation.begin("motion"));
    const Vec3 expected = tip_of(together.simulation);
    EXPECT_GT((expected - Vec3::UnitX()).norm(), 1e-3);
    const auto compare = [&](const std::string& name, double relaxation, double most) {
      Live split(beam_deck(clamp + gust + port));
      const auto partner = coupling::make_added_mass(mass);
      const auto scheme = coupling::find_scheme(name, relaxation);
      analysis::Stepper& stepper = split.simulation.begin("motion");
      const CouplingReport report =
          couple(split.simulation, stepper, "tip", *partner, *scheme, {1e-11, 200});
      EXPECT_EQ(report.windows, 10);
      EXPECT_LE(report.attempts, most * report.windows) << name << ", " << mass << " kg";
      EXPECT_LT((tip_of(split.simulation) - expected).norm(), 1e-10) << name << ", " << mass;
      EXPECT_LT(std::abs(report.gap()), 1e-10 * report.exchanged) << name << ", " << mass;
      for (const auto& [what, value] : stepper.finish().numbers) {
        if (what == "relative energy drift") {
          EXPECT_LT(value, 1e-11);
        }
      }
    };
    compare("quasi-newton", 0.01, 20);
    if (mass < 1.0) compare("aitken", 0.5, 40);
  }
}

// Loose coupling with a heavy mass gains energy from nowhere; the gap says so.
TEST(Couple, LooseCouplingWithAHeavyPartnerLosesTheBalance) {
  Live split(beam_deck(clamp + gust + port));
  const auto partner = coupling::make_added_mass(2.0);
  coupling::Explicit scheme;
  analysis::Stepper& stepper = split.simulation.begin("motion");
  double gap = 1.0;
  try {
    const CouplingReport report = couple(split.simulation, stepper, "tip", *partner, scheme);
    gap = std::abs(report.gap()) / report.exchanged;
  } catch (const NumericalError&) {  // or there is no step any more
  }
  EXPECT_GT(gap, 0.1);
}

TEST(Couple, SaysWhereStructureAndPartnerDoNotAgree) {
  Live split(beam_deck(clamp + gust + port));
  const auto partner = coupling::make_added_mass(3.0);
  coupling::ConstantRelaxation scheme(1.0);
  analysis::Stepper& stepper = split.simulation.begin("motion");
  try {
    couple(split.simulation, stepper, "tip", *partner, scheme, {1e-8, 5});
    FAIL();
  } catch (const NumericalError& error) {
    EXPECT_NE(std::string(error.what()).find("did not agree in 5 attempts of the step from 0 s to"),
              std::string::npos)
        << error.what();
  }
  Live fresh(beam_deck(clamp + gust + port));
  analysis::Stepper& statics = fresh.simulation.begin("bending");
  EXPECT_THROW(couple(fresh.simulation, statics, "tip", *partner, scheme), UsageError);
}

}  // namespace
}  // namespace culm::simulation
