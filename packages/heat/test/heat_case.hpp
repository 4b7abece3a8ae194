/// Temperatures on structures, for tests.
#pragma once

#include <culm/heat/register_heat.hpp>

#include <culm_kit/batch_laws.hpp>
#include <culm_kit/deck_list.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>
#include <vector>

namespace culm::heat {

constexpr const char* effect = "Temperature, sun";

/// 0.8 K times "day", and gradients.
inline kit::GivenValues sun_on(const std::string& structure, const std::vector<double>& gradient) {
  return {{"Structure", structure},
          {"Value", 0.8},
          {"Gradient", gradient},
          {"Function", std::string("day")}};
}

/// A structure under "sun", and the title of its elements where there is one of all.
struct Warmed {
  kit::FillModel fill;
  std::string elements;
};

/// Adds a load "sun" that may follow "day" = 1 + t^2. @return what it complains of
inline std::vector<std::string> add_heat(
    model::Model& model, const kit::GivenValues& values,
    const std::map<std::string, model::SharedField>& fields = {}) {
  model::BuilderRegistry registry;
  register_heat(registry);
  const std::map<std::string, model::Amplitude> functions{
      {"day", model::Amplitude::of_time([](double t) { return 1.0 + t * t; })},
      {"noise", model::Amplitude::of_step([](double, double end) { return end; })}};
  InputIssues issues;
  model::BuildContext context{model, functions, issues};
  context.fields = fields;
  const Schema schema = registry.variants().at("Temperature");
  registry.make("Temperature", kit::deck_list(schema, values, "sun"), context);
  std::vector<std::string> messages;
  for (const InputIssue& issue : issues.sorted()) messages.push_back(issue.message);
  return messages;
}

/// Work of all stresses = change of the energy in strain less free strain - work of heat.
inline void expect_energy_balance(const kit::FillModel& fill, const std::string& elements,
                                  const std::string& heat) {
  SCOPED_TRACE(elements);
  model::Model model;
  fill(model);
  model.freeze(model::Form::multipliers);
  kit::DenseAssembly dense(model);
  const std::vector<model::Batch*> batches{kit::find_batch(model, elements),
                                           kit::find_batch(model, heat)};
  const auto stored = [&](const model::Coordinates& q) {
    return batches[0]->stored_energy(q) + batches[1]->stored_energy(q);
  };
  model::State state = kit::random_state(model, 3);
  const Stencil stencil{state.time - state.time_prev, 0.5, 0.5, 0.0};  // without inertia
  model::State start = state;
  start.time = start.time_prev;
  dense.prepare(start, stencil);
  const double before = stored(state.prev);
  dense.prepare(state, stencil);
  const Eigen::VectorXd force = kit::node_rows(model, dense.residual(state, stencil, batches));
  double work = 0.0;
  for (std::size_t i = 0; i < state.next.size(); ++i) {
    work += force[static_cast<Eigen::Index>(i)] * (state.next[i] - state.prev[i]);
  }
  const double after = stored(state.next);
  const double drives = batches[1]->step_work(state, stencil).drives;
  EXPECT_GT(std::abs(drives), 1e-3);
  EXPECT_NEAR(work, after - before - drives, 1e-12 * (before + after));
}

}  // namespace culm::heat
