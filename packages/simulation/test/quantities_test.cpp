#include <culm/base/absent.hpp>
#include <culm/base/error.hpp>
#include <culm/base/snapshot.hpp>

#include "live_deck.hpp"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

namespace culm::simulation {
namespace {

/// A parameter of a deck.
std::string set(const std::string& name, const std::string& value) {
  return "<Parameter name=\"" + name + "\" value=\"" + value + "\"/>";
}

std::string list(const std::string& name, const std::string& content) {
  return "<ParameterList name=\"" + name + "\">" + content + "</ParameterList>";
}

std::string typed(const std::string& name, const std::string& type, const std::string& content) {
  return list(name, set("Type", type) + content);
}

const std::string bar = typed("bar", "Stiffness Values",
                              set("EA", "1e6") + set("GA1", "4e5") + set("GA2", "4e5") +
                                  set("EI1", "2e3") + set("EI2", "1e3") + set("GIp", "1e3") +
                                  set("rhoA", "1") + set("rhoI1", "0.01") + set("rhoI2", "0.01"));

std::string beam(const std::string& name, const std::string& from, const std::string& to,
                 int elements) {
  return typed(name, "Beam",
               set("Section", "bar") +
                   list("Curve", set("Type", "Line") + set("From", from) + set("To", to) +
                                     set("Elements", std::to_string(elements))));
}

/// The watched numbers after the last step, by column.
class Watching {
 public:
  explicit Watching(const std::string& deck) : live_(deck) {}

  /// Runs an analysis. @param each  called after each step
  template <class Each>
  void run(const std::string& analysis, Each each) {
    analysis::Stepper& stepper = live_.simulation.begin(analysis);
    while (!stepper.is_at_end()) {
      ASSERT_TRUE(stepper.attempt(stepper.proposal()).accepted);
      stepper.accept();
      each();
    }
  }

  double operator[](const std::string& column) {
    const auto columns = live_.simulation.quantity_columns();
    for (std::size_t i = 0; i < columns.size(); ++i) {
      if (columns[i].name == column) return live_.simulation.quantities()[i];
    }
    ADD_FAILURE() << "no column " << column;
    return 0.0;
  }
  Vec3 vector(const std::string& name, const std::string& components, const std::string& axes) {
    Vec3 v;
    for (std::size_t i = 0; i < 3; ++i)
      v[static_cast<int>(i)] = (*this)[name + " " + components + axes[i]];
    return v;
  }

 private:
  Live live_;
};

/// A cantilever along x with force and moment at its end; the loads of a section are watched.
std::string bent(int elements, const std::string& watched) {
  return list(
      "culm",
      list("Sections", bar) + list("Structures", beam("beam", "{0, 0, 0}", "{2, 0, 0}", elements)) +
          list("Constraints", typed("clamp", "Rigid Support", set("Node", "beam/first"))) +
          list("Loads",
               typed("force", "Force", set("Node", "beam/last") + set("Force", "{40, 100, -60}")) +
                   typed("moment", "Moment",
                         set("Node", "beam/last") + set("Moment", "{30, 0, 20}"))) +
          list("Analyses", typed("bend", "Static", set("Steps", "1"))) +
          list("Output", list("History", watched)));
}

std::string section(const std::string& name, const std::string& station, const std::string& more) {
  return typed(name, "Section Loads", set("Structure", "beam") + set("Station", station) + more);
}

// In the section at the root acts what the support exerts, with the other sign; at the end the
// load.
TEST(SectionLoads, AtTheEndsAreReactionAndLoadToSecondOrder) {
  const auto error = [](int elements) {
    const std::string watched = section("root", "0", set("Axes", "Space")) +
                                section("end", "1", set("Axes", "Space")) +
                                typed("held", "Reaction", set("Node", "beam/first"));
    Watching run(bent(elements, watched));
    run.run("bend", [] {});
    const Vec3 force = run.vector("root", "F", "xyz") + run.vector("held", "F", "xyz");
    const Vec3 moment = run.vector("root", "M", "xyz") + run.vector("held", "M", "xyz");
    const Vec3 end = run.vector("end", "M", "xyz") - Vec3(30, 0, 20);
    EXPECT_LT((run.vector("end", "F", "xyz") - Vec3(40, 100, -60)).norm(), 5.0 / elements);
    return std::max({force.norm(), moment.norm(), end.norm()});
  };
  const double coarse = error(8);
  const double fine = error(16);
  EXPECT_LT(coarse, 2.0);  // of 200 N m
  EXPECT_GT(coarse / fine, 3.0);
  EXPECT_LT(coarse / fine, 6.0);
}

// A force at an inner node makes a jump: each side has its own.
TEST(SectionLoads, OfOneSideJumpByTheForceAtANode) {
  std::string watched;
  for (const char* side : {"Before", "After", "Both"}) {
    watched += section(side, "0.5", set("Axes", "Space") + set("Side", side));
  }
  std::string deck = bent(8, watched);
  const std::string loads = "<ParameterList name=\"Loads\">";
  deck.insert(deck.find(loads) + loads.size(),
              typed("inner", "Force", set("Node", "beam/8") + set("Force", "{0, 0, 5}")));
  Watching run(deck);
  run.run("bend", [] {});
  const Vec3 force = run.vector("Before", "F", "xyz") - run.vector("After", "F", "xyz");
  EXPECT_NEAR(force.z(), 5.0, 0.05);
  EXPECT_NEAR(run.vector("Both", "F", "xyz").z(), run.vector("After", "F", "xyz").z() + 2.5, 0.05);
  const Vec3 moment = run.vector("Before", "M", "xyz") - run.vector("After", "M", "xyz");
  EXPECT_LT(moment.norm(), 0.1);
}

TEST(SectionLoads, AxesOfSectionAndFrameAreTurnsOfThoseInSpace) {
  const std::string watched = section("own", "1", "") +
                              section("tip", "1", set("Frame", "beam/last")) +
                              section("space", "1", set("Axes", "Space")) +
                              section("root", "1", set("Frame", "beam/first"));
  Watching run(bent(4, watched));
  run.run("bend", [] {});
  for (const char* vector : {"F", "M"}) {
    EXPECT_LT((run.vector("own", vector, "123") - run.vector("tip", vector, "123")).norm(), 1e-12);
    EXPECT_NEAR(run.vector("own", vector, "123").norm(), run.vector("space", vector, "xyz").norm(),
                1e-9);
    // the directors of the clamped node do not move: d3 along x
    EXPECT_NEAR(run.vector("root", vector, "123")[2], run.vector("space", vector, "xyz")[0], 1e-9);
  }
}

// What a rigid connection exerts on the node that follows, and not what it hands to its master.
// A support takes unknowns away, a spring joint beside it is an equation: each has its own share.
TEST(Reaction, OfASupportBesideAJoint) {
  const auto watch = [](const std::string& name, const std::string& constraint) {
    return typed(
        name, "Reaction",
        set("Node", "one/first") + (constraint.empty() ? "" : set("Constraint", constraint)));
  };
  const std::string deck = list(
      "culm",
      list("Sections", bar) +
          list("Structures", beam("one", "{0, 0, 0}", "{1, 0, 0}", 2) +
                                 beam("two", "{0, 0, 0}", "{0, 1, 0}", 2)) +
          list("Constraints", typed("clamp", "Rigid Support", set("Node", "one/first")) +
                                  typed("pin", "Spherical Joint",
                                        set("First", "one/first") + set("Second", "two/first")) +
                                  typed("end", "Rigid Support", set("Node", "two/last"))) +
          list("Loads",
               typed("on one", "Force", set("Node", "one/last") + set("Force", "{0, 0, 7}")) +
                   typed("on two", "Force", set("Node", "two/2") + set("Force", "{0, 0, 6}"))) +
          list("Analyses", typed("bend", "Static", set("Steps", "1"))) +
          list("Output",
               list("History", watch("all", "") + watch("clamp", "clamp") + watch("pin", "pin"))));
  Watching run(deck);
  run.run("bend", [] {});
  const Vec3 clamp = run.vector("clamp", "F", "xyz");
  const Vec3 pin = run.vector("pin", "F", "xyz");
  EXPECT_NEAR(pin.z(), 5.0 / 16.0 * 6.0, 0.03);  // of a propped beam; shear adds a little
  EXPECT_LT((run.vector("all", "F", "xyz") - clamp - pin).norm(), 1e-9);
  EXPECT_NEAR(run["all Fz"], -7.0, 1e-6);
}

TEST(Reaction, OfARigidConnectionIsThatOnTheNodeThatFollows) {
  const std::string plate =
      typed("plate", "Rigid Body",
            set("Position", "{0, 0, 0.5}") + set("Mass", "1") + set("Inertia", "{1, 1, 1}"));
  const std::string text = list(
      "culm",
      list("Sections", bar) +
          list("Structures", beam("beam", "{0, 0, 0}", "{2, 0, 0}", 4) + plate) +
          list("Constraints", typed("ground", "Rigid Support", set("Node", "plate")) +
                                  typed("bolt", "Rigid Connection",
                                        set("Node", "beam/first") + set("Master", "plate"))) +
          list("Loads", typed("force", "Force",
                              set("Node", "beam/last") + set("Force", "{0, 1e-3, -2e-3}"))) +
          list("Solver", set("Form", "Multipliers")) +
          list("Analyses", typed("bend", "Static", set("Steps", "1"))) +
          list("Output", list("History", typed("bolt", "Reaction", set("Node", "beam/first")) +
                                             typed("ground", "Reaction", set("Node", "plate")))));
  Watching run(text);
  run.run("bend", [] {});
  const Vec3 load(0.0, 1e-3, -2e-3);
  const auto expect = [&](const std::string& name, const Vec3& arm) {
    EXPECT_LT((run.vector(name, "F", "xyz") + load).norm(), 1e-9);
    EXPECT_LT((run.vector(name, "M", "xyz") + arm.cross(load)).norm(), 1e-7);
  };
  expect("bolt", Vec3(2.0, 0.0, 0.0));
  expect("ground", Vec3(2.0, 0.0, -0.5));
}

constexpr double speed = 2.0;  // [rad/s]
constexpr double step = 0.02;  // [s]

/// A hub that turns about x with a blade, beside a tower: the simplest turbine.
std::string turbine(const std::string& watched) {
  const std::string axis = set("Axis", "{1, 0, 0}");
  const std::string body = set("Mass", "10") + set("Inertia", "{2, 2, 2}");
  const std::string turn = set("Angular Velocity", "{2, 0, 0}") + set("About", "{0, 0, 0}");
  return list(
      "culm",
      list("Sections", bar) +
          list("Structures", typed("nacelle", "Rigid Body", set("Position", "{1, 0, 0}") + body) +
                                 typed("hub", "Rigid Body", set("Position", "{0, 0, 0}") + body) +
                                 beam("blade", "{0, 0, 1}", "{0, 0, 5}", 2) +
                                 beam("tower", "{2, 0, -9}", "{2, 0, -1}", 2)) +
          list("Constraints", typed("clamp", "Rigid Support", set("Node", "tower/first")) +
                                  typed("yaw", "Rigid Support", set("Node", "nacelle")) +
                                  typed("root", "Rigid Connection",
                                        set("Master", "hub") + set("Node", "blade/first")) +
                                  typed("bearing", "Revolute Joint",
                                        set("First", "nacelle") + set("Second", "hub") +
                                            set("Position", "{0, 0, 0}") + axis)) +
          list("Initial Conditions", typed("hub", "Velocity", set("Node", "hub") + turn) +
                                         typed("blade", "Velocity", set("Node", "blade") + turn)) +
          list("Analyses",
               typed("turn", "Dynamic", set("End Time", "4") + set("Step", std::to_string(step)))) +
          list("Output", list("History", watched)));
}

std::string joint(const std::string& name, const std::string& type, const std::string& more = "") {
  return typed(name, type,
               set("First", "nacelle") + set("Second", "hub") + set("Axis", "{2, 0, 0}") + more);
}

TEST(Columns, OfNodesThatAreCalledAsALoadHaveNumbersWhereThatDoesNotAct) {
  const std::string force = set("Node", "tip") + set("Force", "{10, 0, 0}");
  Watching watching(list(
      "culm",
      list("Sections", bar) + list("Structures", beam("mast", "{0, 0, 0}", "{0, 0, 1}", 1)) +
          list("Node Sets", list("tip", set("Nodes", "{mast/last}"))) +
          list("Constraints", typed("foot", "Rigid Support", set("Node", "mast/first"))) +
          list("Loads", typed("tip", "Force", force) + typed("other", "Force", force)) +
          list("Analyses", typed("both", "Static", "") +
                               typed("one", "Static",
                                     set("Inactive", "{tip}") + set("Start From", "Reference"))) +
          list("Output", list("History", typed("top", "Displacement", set("Node", "tip"))))));
  double both = 0.0;
  watching.run("both", [&] { both = watching["top ux"]; });
  watching.run("one", [] {});
  EXPECT_GT(both, 1e-3);
  EXPECT_NEAR(watching["top ux"], 0.5 * both, 1e-3 * both);
}

TEST(Inactive, IsOneThingOfItsName) {
  const auto deck = [](const std::string& support) {
    return list(
        "culm",
        list("Sections", bar) + list("Structures", beam("mast", "{0, 0, 0}", "{0, 0, 1}", 1)) +
            list("Constraints",
                 typed("foot", "Rigid Support", set("Node", "mast/first")) +
                     typed(support, "Simple Support",
                           set("Node", "mast/last") + set("Direction", "{1, 0, 0}"))) +
            list("Loads",
                 typed("push", "Force", set("Node", "mast/last") + set("Force", "{0, 1, 0}"))) +
            list("Analyses", typed("rest", "Static", set("Inactive", "{push}"))));
  };
  EXPECT_NO_THROW(Live live(deck("prop")));
  try {
    const Live live(deck("push"));
    ADD_FAILURE() << "both would not act";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("'push' stands in the lists Loads and Constraints"),
              std::string::npos);
  }
}

// Readers find columns by name and unit, sensors by name.
TEST(Columns, OfOneNameAreRefused) {
  const auto refusal = [](const std::string& history, const std::string& signals) {
    try {
      const Live live(list(
          "culm",
          list("Sections", bar) + list("Structures", beam("mast", "{0, 0, 0}", "{0, 0, 1}", 1)) +
              list("Constraints", typed("foot", "Rigid Support", set("Node", "mast/first"))) +
              list("Signals", signals) + list("Analyses", typed("rest", "Static", "")) +
              list("Output",
                   list("History",
                        typed("tip", "Displacement", set("Node", "mast/last")) + history))));
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const std::string to = set("Node", "mast/last") + set("To", "mast/first");
  const std::string steady = typed("steady", "External", "");
  EXPECT_EQ(refusal(typed("tip uz.", "Distance", to), ""), "");
  EXPECT_NE(refusal(typed("tip uz", "Distance", to), "")
                .find("its column 'tip uz [m]' is called as one of 'tip'"),
            std::string::npos);
  const std::string number = typed("tip uz", "Signal", set("Signal", "steady"));
  EXPECT_EQ(refusal(number, steady), "");
  EXPECT_NE(refusal(number, steady + typed("felt", "History", set("Quantity", "tip uz")))
                .find("several columns 'tip uz'"),
            std::string::npos);
}

// The rotor turns freely with its first speed, but for what the blade takes by its vibration; steps
// change rates by their relative square.
TEST(MotionQuantities, SpeedAndAzimuthOfARotor) {
  Watching run(turbine(
      joint("turned", "Joint Angle") + joint("azimuth", "Joint Angle", set("Turns", "false")) +
      joint("speed", "Joint Speed") + typed("hub", "Angular Velocity", set("Node", "hub")) +
      typed("blade", "Angular Velocity", set("Node", "blade/last")) +
      typed("seen", "Angular Velocity", set("Node", "blade/first") + set("Frame", "hub"))));
  double before = 0.0;
  double speed_before = speed;
  run.run("turn", [&] {
    const double full = 2.0 * std::numbers::pi;
    const double turned = run["turned"];
    // the scheme turns by the mean of the speeds
    const double mean = (run["speed"] + speed_before) / 2.0;
    EXPECT_NEAR(turned - before, step * mean, std::pow(speed * step, 3) / 6.0);
    EXPECT_NEAR(run["azimuth"], std::fmod(turned, full), 1e-12);
    EXPECT_NEAR(run["speed"], run["hub wx"], 1e-9);
    EXPECT_NEAR(run["blade wx"], speed, 0.02 * speed);
    EXPECT_LT(run.vector("seen", "w", "xyz").norm(), 1e-9) << "held by a rigid connection";
    before = turned;
    speed_before = run["speed"];
  });
  EXPECT_GT(before, 2.0 * std::numbers::pi) << "a full turn";
}

// Asked for each component anew, it stays that of the step.
TEST(MotionQuantities, AccelerationIsTheMeanOfTheStep) {
  Watching run(turbine(typed("root", "Velocity", set("Node", "blade/first")) +
                       typed("root acceleration", "Acceleration", set("Node", "blade/first")) +
                       typed("hub", "Angular Velocity", set("Node", "hub"))));
  std::optional<Vec3> before;
  run.run("turn", [&] {
    const Vec3 velocity = run.vector("root", "v", "xyz");
    const Vec3 found = run.vector("root acceleration", "a", "xyz");
    if (before) {
      EXPECT_LT((found - (velocity - *before) / step).norm(), 1e-9);
    }
    const double w = run["hub wx"];
    EXPECT_NEAR(found.norm(), w * w, 0.02 * w * w) << "1 m from the axis";
    before = velocity;
  });
}

TEST(MotionQuantities, AnObserverOnTheHubSeesTheBladeAtRest) {
  const std::string hub = set("Frame", "hub");
  const std::string point = set("Node", "hub") + set("Offset", "{0.5, 1, 2}");
  Watching run(turbine(typed("point", "Displacement", point + hub) +
                       typed("moves", "Velocity", point + hub) +
                       typed("root", "Displacement", set("Node", "blade/first") + hub) +
                       typed("tip", "Displacement", set("Node", "blade/last") + hub) +
                       typed("turn", "Rotation", set("Node", "blade/last") + hub) +
                       typed("place", "Position", set("Node", "blade/last") + hub) +
                       typed("root velocity", "Velocity", set("Node", "blade/first")) +
                       typed("space", "Displacement", set("Node", "blade/last"))));
  double furthest = 0.0;
  run.run("turn", [&] {
    EXPECT_LT(run.vector("point", "u", "xyz").norm(), 1e-12);
    // at the ends of steps velocities of directors are those of a rotation to second order
    EXPECT_LT(run.vector("moves", "v", "xyz").norm(),
              2.3 * speed * std::pow(speed * step, 2) / 12.0);
    EXPECT_LT(run.vector("root", "u", "xyz").norm(), 1e-12);
    EXPECT_LT(run.vector("tip", "u", "xyz").norm(), 0.02);  // rho A w^2 L^3 / EA and bending
    EXPECT_LT(run.vector("turn", "r", "xyz").norm(), 0.02);
    EXPECT_LT(
        (run.vector("place", "", "xyz") - run.vector("tip", "u", "xyz") - Vec3(0, 0, 5)).norm(),
        1e-12);
    EXPECT_NEAR(run.vector("root velocity", "v", "xyz").norm(), speed * 1.0, 0.02 * speed);
    furthest = std::max(furthest, run.vector("space", "u", "xyz").norm());
  });
  EXPECT_GT(furthest, 9.9) << "across the circle";
}

TEST(MotionQuantities, TheBladePassesTheTower) {
  Watching run(turbine(
      typed("clearance", "Distance",
            set("Node", "blade/last") + set("Structure", "tower") + set("Radii", "{0.9, 0.1}")) +
      typed("points", "Distance",
            set("Node", "blade/last") + set("To", "nacelle") + set("To Offset", "{-1, 0, 0}")) +
      typed("tip", "Position", set("Node", "blade/last")) + typed("all", "Momentum", "")));
  double least = 100.0;
  run.run("turn", [&] {
    const Vec3 tip = run.vector("tip", "", "xyz");
    const Vec3 above(0.0, tip.y(), std::max(tip.z() + 1.0, 0.0));  // of the end of the tower
    const double radius = 0.1 + 0.8 * std::clamp(-1.0 - tip.z(), 0.0, 8.0) / 8.0;
    EXPECT_NEAR(run["clearance"], (above - Vec3(2.0 - tip.x(), 0, 0)).norm() - radius, 1e-9);
    EXPECT_NEAR(run["points"], tip.norm(), 1e-12);
    // hub 2 kg m^2 and blade: rho A L^3 / 3 from 1 m to 5 m, rho I at its sections
    EXPECT_NEAR(run["all Lx"], speed * (2.0 + (125.0 - 1.0) / 3.0 + 0.01 * 4.0),
                0.02 * speed * 43.3);
    least = std::min(least, run["clearance"]);
  });
  EXPECT_NEAR(least, 2.0 - 0.5, 0.01) << "half-way down the tower";
}

// An open attempt is watched as it would be accepted, as often as wanted, and what quantities
// remember is of accepted states, whether they were asked for or not.
TEST(MotionQuantities, OfAnOpenAttemptAreThoseOfTheStepAndLeaveNoTrace) {
  for (const char* scheme : {"Conserving", "Generalised Alpha"}) {
    const std::string deck = list(
        "culm",
        list("Sections", bar) + list("Structures", beam("mast", "{0, 0, 0}", "{0, 0, 1}", 2)) +
            list("Constraints", typed("foot", "Rigid Support", set("Node", "mast/first"))) +
            list("Loads", typed("push", "Force",
                                set("Node", "mast/last") + set("Force", "{100, 0, 0}") +
                                    set("Function", "Constant"))) +
            list("Analyses", typed("motion", "Dynamic",
                                   set("Scheme", scheme) + set("Start Time", "0") +
                                       set("End Time", "1") + set("Step", "0.01"))) +
            list("Output",
                 list("History", typed("shake", "Acceleration", set("Node", "mast/last")) +
                                     typed("speed", "Velocity", set("Node", "mast/last")) +
                                     typed("balance", "Energy", "") +
                                     typed("turn", "Joint Angle",
                                           set("First", "mast/first") + set("Second", "mast/last") +
                                               set("Axis", "{0, 1, 0}")))));
    Live asked(deck), silent(deck);
    analysis::Stepper &one = asked.simulation.begin(), &other = silent.simulation.begin();
    EXPECT_EQ(asked.simulation.quantities().front(), absent);
    Snapshot before(Snapshot::Use::memory);
    std::vector<double> found;
    for (int step = 0; step < 6; ++step) {
      if (step == 3) one.save(before);
      ASSERT_TRUE(one.attempt(one.time() + 0.004).accepted);
      asked.simulation.quantities();
      ASSERT_TRUE(one.attempt(one.proposal()).accepted);
      const std::vector<double> open = asked.simulation.quantities();
      EXPECT_EQ(open, asked.simulation.quantities());
      one.accept();
      found = asked.simulation.quantities();
      for (std::size_t i = 0; i < open.size(); ++i) {
        EXPECT_NEAR(open[i], found[i], 1e-9 * (1.0 + std::abs(found[i]))) << scheme << ' ' << i;
      }
      ASSERT_TRUE(other.attempt(other.proposal()).accepted);
      other.accept();
    }
    EXPECT_GT(std::abs(found.front()), 1.0);
    EXPECT_EQ(found, silent.simulation.quantities()) << scheme;
    one.restore(before);
    for (int step = 3; step < 6; ++step) {
      ASSERT_TRUE(one.attempt(one.proposal()).accepted);
      one.accept();
    }
    EXPECT_EQ(found, asked.simulation.quantities()) << scheme;
  }
}

}  // namespace
}  // namespace culm::simulation
