#include <culm/base/error.hpp>

#include "live_deck.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <vector>

namespace culm::simulation {
namespace {

using port::Quantity;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

std::string with_ports(const std::string& ports) {
  return R"(<ParameterList name="Ports">)" + ports + "</ParameterList>";
}

const std::string end_port = with_ports(R"(<ParameterList name="end">
  <Parameter name="Type" value="Points"/> <Parameter name="Points" value="{beam/last}"/>
</ParameterList>)");

// A ring of points round the beam in the middle of elements, one of them beyond the end.
const std::vector<double> ring = {0.2, 0.1, 0.0, 0.4,  0.0, 0.1,  0.6, -0.1, 0.05,
                                  0.9, 0.0, 0.0, 0.97, 0.1, -0.1, 1.1, 0.02, 0.03};
const std::string ring_port = with_ports(R"(<ParameterList name="skin">
  <Parameter name="Type" value="Cloud"/>
  <Parameter name="Points" value="{0.2, 0.1, 0.0, 0.4, 0.0, 0.1, 0.6, -0.1, 0.05,
                                   0.9, 0.0, 0.0, 0.97, 0.1, -0.1, 1.1, 0.02, 0.03}"/>
</ParameterList>)");

// Loads that differ from step to step, forces first.
std::vector<double> loads(int step, double size = 0.1) {
  std::vector<double> values;
  for (int i = 0; i < 18; ++i) values.push_back(size * std::sin(1.0 + 2.3 * i + 0.7 * step));
  return values;
}

std::map<std::string, double> finish(analysis::Stepper& stepper) {
  std::map<std::string, double> numbers;
  for (const auto& [name, value] : stepper.finish().numbers) numbers[name] = value;
  return numbers;
}

TEST(LivePorts, LoadsAtANodeActAsThoseOfADeck) {
  const std::string constant = R"(<ParameterList name="force">
  <Parameter name="Type" value="Force"/> <Parameter name="Node" value="beam/last"/>
  <Parameter name="Force" value="{0.1, 0.5, -0.2}"/> <Parameter name="Function" value="Constant"/>
</ParameterList><ParameterList name="moment">
  <Parameter name="Type" value="Moment"/> <Parameter name="Node" value="beam/last"/>
  <Parameter name="Moment" value="{0.3, 0, 0.1}"/> <Parameter name="Function" value="Constant"/>
</ParameterList>)";
  Live set(beam_deck(clamp + end_port)), written(cantilever(constant));
  set.simulation.set_port("end", std::vector{0.1, 0.5, -0.2}, std::vector{0.3, 0.0, 0.1});
  for (const char* name : {"bending", "motion"}) {  // the loads go on from one to the other
    analysis::Stepper& one = set.simulation.begin(name);
    analysis::Stepper& two = written.simulation.begin(name);
    while (!two.is_at_end()) {
      for (analysis::Stepper* stepper : {&one, &two}) {
        ASSERT_TRUE(stepper->attempt(stepper->proposal()).accepted);
        stepper->accept();
      }
    }
    const int end = set.simulation.nodes("beam/last").front();
    const Vec3 expected = written.simulation.position(end);
    EXPECT_GT((expected - Vec3::UnitX()).norm(), 0.01);
    EXPECT_LT((set.simulation.position(end) - expected).norm(), 1e-12);
    const std::vector<double> seen = set.simulation.read_port("end", Quantity::position);
    EXPECT_LT((Eigen::Map<const Vec3>(seen.data()) - expected).norm(), 1e-12);
  }
}

TEST(LivePorts, LoadsThatSupportsTakeAreTold) {
  const std::string ends = with_ports(R"(<ParameterList name="foot">
  <Parameter name="Type" value="Points"/> <Parameter name="Points" value="{beam/first}"/>
</ParameterList><ParameterList name="end">
  <Parameter name="Type" value="Points"/> <Parameter name="Points" value="{beam/last}"/>
</ParameterList>)");
  Live live(beam_deck(clamp + ends));
  live.simulation.set_port("foot", std::vector{0.1, 0.5, -0.2}, {});
  live.simulation.set_port("end", std::vector{0.1, 0.5, -0.2}, {});
  live.simulation.begin("bending");
  live.simulation.set_port("foot", std::vector{0.2, 0.5, -0.2}, {});
  const std::string said = live.said.str();
  const std::string warning = "warning: Port 'foot' moves nothing: all of it acts where supports";
  EXPECT_THAT(said, HasSubstr(warning));
  EXPECT_EQ(said.find("moves nothing"), said.rfind("moves nothing"));
}

// In free flight and on a support: what the port books is what the certificate books, and energy
// and momenta close with it.
TEST(LivePorts, WorkAndImpulseCloseTheBalance) {
  for (const std::string& support : {std::string(), clamp}) {
    Live live(beam_deck(support + ring_port));
    analysis::Stepper& stepper = live.simulation.begin("motion");
    double work = 0.0, size = 0.0;
    for (int i = 0; !stepper.is_at_end(); ++i) {
      live.simulation.set_port("skin", loads(i), loads(i + 100, 0.02));
      ASSERT_TRUE(stepper.attempt(stepper.proposal()).accepted);
      const port::Exchange exchange = live.simulation.exchange("skin");
      work += exchange.work;
      size += std::abs(exchange.work);
      stepper.accept();
    }
    const auto numbers = finish(stepper);
    EXPECT_GT(size, 1e-3);
    EXPECT_NEAR(numbers.at("work of loads"), work, 1e-13 * size);
    EXPECT_LT(numbers.at("relative energy drift"), 1e-12);
    if (!support.empty()) continue;
    EXPECT_LT(numbers.at("relative linear momentum drift"), 1e-12);
    EXPECT_LT(numbers.at("relative angular momentum drift"), 1e-12);
  }
}

// Absurd attempts in between, discarded or followed by another one, change no bit.
TEST(LivePorts, AttemptsLeaveNoTrace) {
  Live straight(beam_deck(clamp + ring_port)), tried(beam_deck(clamp + ring_port));
  analysis::Stepper& one = straight.simulation.begin("motion");
  analysis::Stepper& two = tried.simulation.begin("motion");
  Snapshot start(Snapshot::Use::memory);
  for (int i = 0; !one.is_at_end(); ++i) {
    straight.simulation.set_port("skin", loads(i), loads(-i));
    ASSERT_TRUE(one.attempt(one.proposal()).accepted);
    tried.simulation.set_port("skin", loads(7 * i, 0.5), loads(9, 0.3));
    two.attempt(two.proposal());
    if (i % 2 == 0) two.discard();
    tried.simulation.set_port("skin", loads(i), loads(-i));
    two.attempt(two.proposal());
    for (const Quantity quantity : {Quantity::position, Quantity::rotation, Quantity::velocity,
                                    Quantity::acceleration, Quantity::motion}) {
      EXPECT_EQ(straight.simulation.read_port("skin", quantity),
                tried.simulation.read_port("skin", quantity));
    }
    one.accept();
    two.accept();
    if (i == 3) two.save(start);
    if (i == 6) {  // three steps again
      two.restore(start);
      for (int k = 4; k <= 6; ++k) {
        tried.simulation.set_port("skin", loads(k), loads(-k));
        two.attempt(two.proposal());
        two.accept();
      }
    }
  }
  EXPECT_TRUE(std::ranges::equal(straight.simulation.state().next, tried.simulation.state().next));
}

// Rates of an open step follow from its motion, those of an accepted one are the state's.
TEST(LivePorts, ReadsRatesOfTheOpenStep) {
  Live live(beam_deck(clamp + ring_port));
  analysis::Stepper& stepper = live.simulation.begin("motion");
  live.simulation.set_port("skin", loads(1));
  const auto read = [&](Quantity quantity) { return live.simulation.read_port("skin", quantity); };
  std::vector<double> before = read(Quantity::velocity), place = read(Quantity::position);
  for (int i = 0; i < 3; ++i) {
    ASSERT_TRUE(stepper.attempt(stepper.proposal()).accepted);
    const auto open = read(Quantity::velocity), mean = read(Quantity::acceleration);
    const auto moved = read(Quantity::motion), next = read(Quantity::position);
    stepper.accept();
    const auto after = read(Quantity::velocity);
    for (std::size_t p = 0; p < ring.size() / 3; ++p) {
      for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_NEAR(open[6 * p + k], after[6 * p + k], 1e-13);
        EXPECT_NEAR(open[6 * p + 3 + k], after[6 * p + 3 + k], 1e-12);
        EXPECT_NEAR(mean[6 * p + k], (after[6 * p + k] - before[6 * p + k]) / 0.05, 1e-11);
        EXPECT_NEAR(moved[6 * p + k], next[3 * p + k] - place[3 * p + k], 1e-15);
      }
    }
    EXPECT_EQ(read(Quantity::motion), std::vector<double>(36, 0.0));
    EXPECT_EQ(read(Quantity::acceleration), std::vector<double>(36, 0.0));
    before = after;
    place = next;
  }
}

TEST(LivePorts, RatesThatAreOthersThanThoseOfTheSchemeAreTold) {
  const auto said = [](const std::string& lists, const char* scheme) {
    std::string deck = beam_deck(clamp + lists);
    const std::string dynamic = R"("Dynamic"/>)";
    deck.insert(deck.find(dynamic) + dynamic.size(),
                std::string(R"(<Parameter name="Scheme" value=")") + scheme + R"("/>)");
    Live live(deck);
    live.simulation.begin("motion");
    return live.said.str();
  };
  const char* words = "ports show velocities and accelerations";
  EXPECT_THAT(said(end_port, "Generalised Alpha"), HasSubstr(words));
  EXPECT_THAT(said(end_port, "Trapezoidal"), Not(HasSubstr(words)));
  EXPECT_THAT(said("", "Generalised Alpha"), Not(HasSubstr(words)));
}

TEST(LivePorts, APortThatAProgramAddsIsThatOfADeck) {
  Live added(beam_deck(clamp)), written(beam_deck(clamp + ring_port));
  added.simulation.add_port("skin", {ring, {"beam"}, 0.2});
  EXPECT_EQ(added.simulation.port_names(), std::vector<std::string>{"skin"});
  EXPECT_THAT(added.said.str(), HasSubstr("port 'skin': 6 points, 6 on 'beam', up to 0.141421 m"));
  EXPECT_THAT(written.said.str(), HasSubstr("port 'skin': 6 points, 6 on 'beam'"));
  const std::vector<double> reference = added.simulation.port("skin").reference();
  for (std::size_t i = 0; i < ring.size(); ++i) EXPECT_NEAR(reference[i], ring[i], 1e-14);
  for (Live* live : {&added, &written}) {
    for (const char* name : {"bending", "motion"}) {
      analysis::Stepper& stepper = live->simulation.begin(name);
      live->simulation.set_port("skin", loads(2), loads(3, 0.02));
      analysis::run(stepper);
    }
  }
  EXPECT_TRUE(std::ranges::equal(added.simulation.state().next, written.simulation.state().next));
  EXPECT_GT((added.simulation.position(6) - Vec3::UnitX()).norm(), 0.01);
}

// Every rank reads the same numbers of all points.
TEST(LivePorts, ReadTheSameOnAllRanks) {
  Live live(beam_deck(clamp + ring_port));
  analysis::Stepper& stepper = live.simulation.begin("motion");
  live.simulation.set_port("skin", loads(1), loads(2));
  stepper.attempt(stepper.proposal());
  std::vector<double> mine = live.simulation.read_port("skin", Quantity::velocity);
  std::vector<double> of_root = mine;
  parallel::Comm().broadcast(of_root);
  EXPECT_EQ(mine, of_root);
  EXPECT_GT(std::abs(mine[12]), 1e-6);
}

TEST(LivePorts, ADeckWithoutPortsHasNone) {
  Live none(beam_deck(clamp)), one(beam_deck(clamp + end_port));
  EXPECT_EQ(none.simulation.port_names(), std::vector<std::string>{});
  EXPECT_THAT(none.simulation.summary(), Not(HasSubstr("Port")));
  EXPECT_TRUE(none.simulation.model().loads().empty());
  EXPECT_THAT(one.simulation.summary(), HasSubstr("Port, end"));
  EXPECT_EQ(one.simulation.model().loads().size(), 1u);
  EXPECT_EQ(none.said.str(), "");
}

TEST(LivePorts, RefusesWhatItDoesNotKnow) {
  Live live(beam_deck(clamp + end_port));
  Simulation& simulation = live.simulation;
  EXPECT_THROW(simulation.read_port("end", Quantity::position), UsageError);  // nothing has begun
  EXPECT_THROW(simulation.port("ende"), UsageError);
  EXPECT_THROW(simulation.set_port("end", std::vector{1.0, 2.0}), UsageError);
  EXPECT_THROW(simulation.add_port("end", {ring, {}}), UsageError);
  EXPECT_THROW(simulation.add_port("skin", {{1.0, 2.0}, {}}), UsageError);
  EXPECT_THROW(simulation.add_port("skin", {ring, {"baem"}}), UsageError);
  EXPECT_THROW(simulation.add_port("skin", {ring, {}, 0.05}), UsageError);
  EXPECT_THROW(
      simulation.add_port("skin", {{1.0, std::numeric_limits<double>::infinity(), 0.0}, {}}),
      NonFiniteError);
  EXPECT_EQ(simulation.port_names(), std::vector<std::string>{"end"});
  simulation.begin();
  EXPECT_THROW(simulation.add_port("skin", {ring, {}}), UsageError);
}

std::string issue_of(const std::string& port) {
  try {
    Live live(
        beam_deck(clamp + with_ports(R"(<ParameterList name="p">)" + port + "</ParameterList>")));
  } catch (const InputError& error) {
    return error.issues().front().message;
  }
  return {};
}

TEST(LivePorts, AWrongDeckIsOneClearMistake) {
  EXPECT_EQ(issue_of(R"(<Parameter name="Type" value="Points"/>
                        <Parameter name="Points" value="{beam/lst}"/>)"),
            "unknown node 'beam/lst' – did you mean 'beam/last'?");
  EXPECT_EQ(issue_of(R"(<Parameter name="Type" value="Points"/>
                        <Parameter name="Points" value="{beam@1.5}"/>)"),
            "needs a fraction between 0 and 1 behind '@', got 'beam@1.5'");
  EXPECT_EQ(issue_of(R"(<Parameter name="Type" value="Stations"/>
                        <Parameter name="Structure" value="bem"/>
                        <Parameter name="Number" value="3"/>)"),
            "unknown structure 'bem' – did you mean 'beam'?");
  EXPECT_EQ(issue_of(R"(<Parameter name="Type" value="Elements"/>
                        <Parameter name="Structure" value="beam"/>
                        <Parameter name="Elements" value="{0, 3}"/>
                        <Parameter name="Natural" value="{0, 0, 0, 0}"/>)"),
            "structure 'beam' has elements 0 to 2, got 3");
  EXPECT_EQ(issue_of(R"(<Parameter name="Type" value="Elements"/>
                        <Parameter name="Structure" value="beam"/>
                        <Parameter name="Elements" value="{0, 2}"/>
                        <Parameter name="Natural" value="{0, 0}"/>)"),
            "needs 4 numbers for 2 elements, got 2");
  EXPECT_THAT(issue_of(R"(<Parameter name="Type" value="Cloud"/>
                          <Parameter name="Points" value="{0, 3, 0}"/>
                          <Parameter name="Reach" value="1"/>)"),
              HasSubstr("1 of 1 points belong to no structure"));
}

// Points by name, by part of the length and by natural coordinates are the same ones.
TEST(LivePorts, TypesOfTheDeckFindTheSamePoints) {
  Live live(beam_deck(clamp + with_ports(R"(<ParameterList name="names">
    <Parameter name="Type" value="Points"/> <Parameter name="Offset" value="{0.1, 0.2, 0}"/>
    <Parameter name="Points" value="{beam@0.5, beam/last}"/>
  </ParameterList><ParameterList name="parts">
    <Parameter name="Type" value="Stations"/> <Parameter name="Structure" value="beam"/>
    <Parameter name="Number" value="3"/> <Parameter name="Offset" value="{0.1, 0.2, 0}"/>
  </ParameterList><ParameterList name="natural">
    <Parameter name="Type" value="Elements"/> <Parameter name="Structure" value="beam"/>
    <Parameter name="Elements" value="{1, 2}"/> <Parameter name="Natural" value="{0, 0, 1, 0}"/>
    <Parameter name="Offsets" value="{0.1, 0.2, 0, 0.1, 0.2, 0}"/>
  </ParameterList>)")));
  EXPECT_EQ(live.simulation.port_names(), (std::vector<std::string>{"names", "parts", "natural"}));
  const auto names = live.simulation.port("names").reference();
  const auto parts = live.simulation.port("parts").reference();
  const auto natural = live.simulation.port("natural").reference();
  ASSERT_EQ(parts.size(), 9u);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_NEAR(names[i], parts[i + 3], 1e-15);
    EXPECT_NEAR(names[i], natural[i], 1e-15);
  }
  EXPECT_NEAR(names[0], 0.5, 1e-15);
}

}  // namespace
}  // namespace culm::simulation
