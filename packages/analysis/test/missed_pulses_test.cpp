#include <culm/analysis/missed_pulses.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

namespace culm::analysis {
namespace {

using model::Amplitude;

// Linear between points, constant outside.
Amplitude table(const std::vector<double>& times, const std::vector<double>& values) {
  return Amplitude::of_time([=](double t) {
           if (t <= times.front()) return values.front();
           for (std::size_t i = 1; i < times.size(); ++i) {
             if (t > times[i]) continue;
             const double share = (t - times[i - 1]) / (times[i] - times[i - 1]);
             return (1.0 - share) * values[i - 1] + share * values[i];
           }
           return values.back();
         })
      .with_corners(times);
}

Amplitude square(double duration) {
  return Amplitude::of_time([=](double t) { return t <= duration ? 1.0 : 0.0; })
      .with_corners({0.0, duration});
}

using Check = void (MissedPulses::*)(double, double, Findings&);

// Warnings of steps of one length from 0 to 2.
int warnings(const Amplitude& function, double step, Check check = &MissedPulses::check) {
  std::ostringstream printed;
  Findings findings(Log{printed, LogLevel::info});
  model::Model model;
  model.add_function("hit", function);
  MissedPulses pulses(model);
  for (int n = 0; n * step < 2.0; ++n) (pulses.*check)(n * step, (n + 1) * step, findings);
  int count = 0;
  const std::string text = printed.str();
  for (auto at = text.find("'hit'"); at != std::string::npos; at = text.find("'hit'", at + 1)) {
    ++count;
  }
  return count;
}

TEST(MissedPulses, ShortPulsesAreTold) {
  EXPECT_EQ(warnings(table({1.02, 1.03, 1.04}, {0.0, 1.0, 0.0}), 0.1), 1);
  EXPECT_EQ(warnings(table({0.0, 0.01, 0.02}, {0.0, 1.0, 0.0}), 0.1), 1);
  EXPECT_EQ(warnings(table({0.0, 0.01}, {1.0, 0.0}), 0.1), 1);
  EXPECT_EQ(warnings(square(0.03), 0.1), 1);
  EXPECT_EQ(warnings(table({1.0, 1.01, 1.02, 1.03}, {5.0, 5.0, 2.0, 5.0}), 0.1), 1);
}

TEST(MissedPulses, EachFunctionOnce) {
  EXPECT_EQ(warnings(table({1.01, 1.02, 1.03, 1.11, 1.12, 1.13}, {0, 1, 0, 0, 1, 0}), 0.1), 1);
}

TEST(MissedPulses, WhatStepsResolveIsNot) {
  EXPECT_EQ(warnings(table({1.0, 1.1, 1.2}, {0.0, 1.0, 0.0}), 0.1), 0);
  EXPECT_EQ(warnings(table({1.02, 1.03, 1.04}, {0.0, 1.0, 0.0}), 0.01), 0);
  EXPECT_EQ(warnings(square(0.5), 0.1), 0);
}

TEST(MissedPulses, JumpsAndRipplesAreNoPulses) {
  EXPECT_EQ(warnings(table({0.0, 1.0, 1.001}, {1.0, 1.0, 0.0}), 0.1), 0);
  EXPECT_EQ(warnings(table({0.0, 1.05, 1.051}, {1.0, 1.0, 0.0}), 0.1), 0);
  EXPECT_EQ(warnings(table({0.0, 0.001}, {0.0, 1.0}), 0.1), 0);
  std::vector<double> times, values;
  for (int i = 0; i <= 2000; ++i) {
    times.push_back(1e-3 * i);
    values.push_back(std::sin(3.0 * times.back()) + 0.01 * (i % 2));
  }
  EXPECT_EQ(warnings(table(times, values), 0.1), 0);
}

// Functions without corners: sines of some periods, by steps of 0.1.
Amplitude sine(double period) {
  return Amplitude::of_time(
      [=](double t) { return std::sin(2.0 * std::numbers::pi * t / period); });
}

TEST(MissedPulses, SinesThatStepsDoNotResolveAreTold) {
  for (const double period : {0.01, 0.03, 0.05, 0.1, 0.15, 0.2, 0.25}) {
    EXPECT_EQ(warnings(sine(period), 0.1), 1) << period;
  }
}

TEST(MissedPulses, SinesOfFourStepsAndFormulasThatJumpAreNot) {
  for (const double period : {0.4, 0.5, 1.0, 7.0}) EXPECT_EQ(warnings(sine(period), 0.1), 0);
  EXPECT_EQ(warnings(Amplitude::of_time([](double t) { return t < 1.02 ? 0.0 : 1.0; }), 0.1), 0);
  EXPECT_EQ(warnings(Amplitude::of_time([](double t) { return t * t; }), 0.1), 0);
  EXPECT_EQ(warnings(Amplitude::of_time([](double t) { return std::exp(-t); }), 0.1), 0);
  EXPECT_EQ(warnings(Amplitude::constant(), 0.1), 0);
}

TEST(MissedPulses, ImpulsesThatStepsLoseOrMakeAreTold) {
  EXPECT_EQ(warnings(table({0.56, 0.6, 0.64}, {0.0, 1.0, 0.0}), 0.1),
            1);  // about the end of a step
  EXPECT_EQ(warnings(square(0.15), 0.1), 1);
  EXPECT_EQ(warnings(table({0.0, 0.25, 0.250001}, {0.0, 1.0, 0.0}), 0.1), 1);
  EXPECT_EQ(warnings(square(1.04), 0.1), 0);
  for (const auto& pulse : {+[](double t) { return t > 0.57 && t < 0.63 ? 1.0 : 0.0; },
                            +[](double t) { return std::exp(-1e4 * (t - 0.6) * (t - 0.6)); },
                            +[](double t) { return std::exp(-100.0 * t); }}) {
    EXPECT_EQ(warnings(Amplitude::of_time(pulse), 0.1), 1);
  }
}

TEST(MissedPulses, TurnsWithinStepsOfStaticsAreTold) {
  const Amplitude up_and_down = table({0.0, 1.0, 2.0}, {0.0, 1.0, 0.0});
  const auto turns = [](const Amplitude& function, double step) {
    return warnings(function, step, &MissedPulses::check_turns);
  };
  EXPECT_EQ(turns(up_and_down, 0.5), 0);
  EXPECT_EQ(turns(up_and_down, 1.0), 0);
  for (const double step : {2.0 / 3.0, 0.4, 2.0 / 9.0}) EXPECT_EQ(turns(up_and_down, step), 1);
  EXPECT_EQ(turns(table({0.0, 0.3, 1.1}, {0.0, 1.0, 2.0}), 0.2), 0);  // corners that are no turns
  EXPECT_EQ(turns(sine(1.0), 0.05), 0);
  EXPECT_EQ(turns(sine(1.0), 0.11), 1);
}

TEST(MissedPulses, PulsesOfFormulasAreTold) {
  const auto pulse = [](double t) { return t > 1.01 && t < 1.05 ? 1.0 : 0.0; };
  EXPECT_EQ(warnings(Amplitude::of_time(pulse), 0.1), 1);
}

}  // namespace
}  // namespace culm::analysis
