#include <culm/analysis/certificate.hpp>
#include <culm/base/text.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace culm::analysis {
namespace {

// What round-off and the tolerance of the solver may add up to.
constexpr double energy_promise = 1e-9;
constexpr double momentum_promise = 1e-10;
constexpr double constraint_promise = 1e-10;

// Steps from one comparison of energy and momenta to the next: what flows in and out is summed in
// all of them, but what the model holds costs as much as a residual.
constexpr int interval = 10;

// Not a number is no drift that is kept.
bool holds(double drift, double promise) { return drift <= promise; }

// The larger one; what is not a number is larger than all.
double larger(double a, double b) { return b > a || std::isnan(b) ? b : a; }

double relative(double drift, double scale) { return scale > 0.0 ? drift / scale : drift; }

bool holds_only_itself(const model::Model& model) {
  return std::ranges::all_of(model.constraints(),
                             [](const model::Constraint& c) { return c.is_internal; });
}

// Sizes of what structures store. What is warmed without resistance stores nothing in sum, but its
// heat takes away what its strains bring, against forces of which the solver leaves its tolerance.
double strain_sizes(const assembly::System& system, const model::Coordinates& q) {
  double sum = 0.0;
  for (const auto& batch : system.model().element_batches()) {
    sum += std::abs(batch->stored_energy(q));
  }
  return system.comm().sum(sum);
}

}  // namespace

Certificate::Certificate(const assembly::System& system, bool promises, bool shows_work)
    : system_(system),
      promises_(promises),
      shows_work_(shows_work),
      is_free_(holds_only_itself(system.model())),
      books_(system, is_free_) {}

void Certificate::start(const model::State& state) {
  look_at(state);
  first_momentum_ = momentum_;
  first_ = last_;
  largest_kinetic_ = first_.kinetic;
  largest_strain_ = first_.strain;
  largest_amount_ = first_.amount;
  largest_linear_ = momentum_.linear.norm();
  largest_angular_ = momentum_.angular.norm();
  closing_ = closing_energy(state);
}

// Statics leave joints open by as much as their tolerance allows; the first step closes them,
// against the forces they carry. @source formulation 4.6
double Certificate::closing_energy(const model::State& state) const {
  const model::Model& model = system_.model();
  double sum = 0.0;
  for (std::size_t e = 0; e < model.equations().size(); ++e) {
    const model::Constraint& c = model.equations()[e];
    if (c.is_driven() || !c.velocity_rows.empty()) continue;
    const int number = model.unknowns().constraint_block(static_cast<int>(e));
    if (system_.layout().owners()[static_cast<std::size_t>(number)] != system_.comm().rank()) {
      continue;
    }
    const auto first = static_cast<std::size_t>(model.unknowns().block(number).first_value);
    const Eigen::Matrix3Xd slots = model::slots_of(c, state.next);
    for (std::size_t row = 0; row < c.rows.size(); ++row) {
      sum += std::abs(state.multipliers[first + row] * model::row_value(c.rows[row], slots));
    }
  }
  return system_.comm().sum(sum);
}

void Certificate::add_work(const model::State& state, const Stencil& stencil,
                           double constraint_violation) {
  ++steps_;
  const model::StepWork step = books_.add(state, stencil);
  work_ += step;
  impulse_ += stencil.step * step.force;
  angular_impulse_ += stencil.step * step.moment;
  constraint_violation_ = larger(constraint_violation_, constraint_violation);
  // what came and went again between two comparisons is the measure of what they find
  largest_work_ = std::max(largest_work_, std::abs(work_.external) + std::abs(work_.drives));
  if (!is_free_) return;
  pushed_linear_ += stencil.step * books_.forces();
  pushed_angular_ += stencil.step * books_.moments();
  largest_linear_ = std::max(largest_linear_, (first_momentum_.linear + impulse_).norm());
  largest_angular_ =
      std::max(largest_angular_, (first_momentum_.angular + angular_impulse_).norm());
}

void Certificate::add_blow(double work) {
  work_.drives += work;
  largest_work_ = std::max(largest_work_, std::abs(work_.external) + std::abs(work_.drives));
}

// What the model holds; of what is held itself, momenta say nothing.
void Certificate::look_at(const model::State& state) {
  momentum_ = {};
  if (is_free_) {
    momentum_ = system_.momentum(state.next, state.velocity);
  } else {
    momentum_.kinetic_energy = system_.kinetic_energy(state.velocity);
  }
  last_ = system_.energies(state.next, momentum_.kinetic_energy);
}

bool Certificate::is_due() const { return steps_ % interval == 0; }

void Certificate::compare_last(const model::State& state) {
  if (!is_due()) compare(state);
}

void Certificate::compare(const model::State& state) {
  look_at(state);
  largest_kinetic_ = std::max(largest_kinetic_, last_.kinetic);
  largest_strain_ = std::max(largest_strain_, last_.strain);
  largest_amount_ = std::max(largest_amount_, last_.amount);
  largest_linear_ = std::max(largest_linear_, momentum_.linear.norm());
  largest_angular_ = std::max(largest_angular_, momentum_.angular.norm());
  const double balance =
      first_.total() + work_.external + work_.drives - work_.damping - work_.dissipation;
  energy_drift_ = larger(energy_drift_, std::abs(last_.total() - balance));
  if (!holds(energy_drift_, energy_promise * energy_scale())) {
    largest_strain_ = std::max(largest_strain_, strain_sizes(system_, state.next));
  }
  linear_drift_ =
      larger(linear_drift_, (momentum_.linear - first_momentum_.linear - impulse_).norm());
  angular_drift_ = larger(angular_drift_,
                          (momentum_.angular - first_momentum_.angular - angular_impulse_).norm());
}

double Certificate::largest_mean_speed() const {
  const double mass = system_.model().mass();
  return mass > 0.0 ? std::sqrt(2.0 * largest_kinetic_ / mass) : 0.0;
}

void Certificate::finish(double change, double velocity) {
  hidden_violation_ = relative(change, velocity);
}

// The places of all numbers that add_work() and compare() build upon.
template <class Self>
auto Certificate::memory(Self& self) {
  std::vector<decltype(&self.energy_drift_)> places;
  places.reserve(64);  // all but many accounts
  places.insert(places.end(),
                {&self.largest_kinetic_, &self.largest_strain_, &self.largest_amount_,
                 &self.largest_work_, &self.closing_, &self.largest_linear_, &self.largest_angular_,
                 &self.pushed_linear_, &self.pushed_angular_, &self.energy_drift_,
                 &self.linear_drift_, &self.angular_drift_, &self.constraint_violation_});
  const auto add_vector = [&places](auto& v) {
    places.insert(places.end(), {&v[0], &v[1], &v[2]});
  };
  for (auto* e : {&self.first_, &self.last_}) {
    places.insert(places.end(), {&e->kinetic, &e->strain, &e->potential, &e->amount});
  }
  for (auto* m : {&self.first_momentum_, &self.momentum_}) {
    places.push_back(&m->kinetic_energy);
    add_vector(m->linear);
    add_vector(m->angular);
  }
  const auto add_amounts = [&places](auto& w) {
    places.insert(places.end(), {&w.external, &w.drives, &w.damping, &w.dissipation});
  };
  auto& work = self.work_;
  add_amounts(work);
  if (!self.books_.accounts().empty()) {
    for (auto& share : self.books_.works()) add_amounts(share);
  }
  for (auto* v : {&work.force, &work.moment, &self.impulse_, &self.angular_impulse_}) {
    add_vector(*v);
  }
  return places;
}

void Certificate::save(Snapshot& snapshot) const {
  const auto places = memory(*this);
  std::vector<double> numbers;
  numbers.reserve(places.size() + 1);
  numbers.push_back(static_cast<double>(steps_));
  for (const double* place : places) numbers.push_back(*place);
  snapshot.set("certificate", std::move(numbers));
}

void Certificate::restore(const Snapshot& snapshot) {
  const auto places = memory(*this);
  const std::span<const double> numbers = snapshot.numbers("certificate", places.size() + 1);
  steps_ = static_cast<int>(numbers.front());
  for (std::size_t i = 0; i < places.size(); ++i) *places[i] = numbers[i + 1];
}

double Certificate::largest_energy() const {
  return std::max({largest_kinetic_, largest_strain_, largest_work_});
}

// Where little happens, what rounding takes of the sums in each step counts: it must not look like
// a drift.
double Certificate::energy_scale() const {
  constexpr double roundings = 8.0;
  const double rounding =
      roundings * std::numeric_limits<double>::epsilon() * steps_ * largest_amount_;
  return std::max(largest_energy(), std::max(rounding, closing_) / energy_promise);
}

// Momenta may vanish although everything moves: a spinning body has no linear momentum. What they
// are made of is at most sqrt(2 m T). Where large forces all but cancel, as weight and buoyancy do,
// equilibrium is left open by the tolerance of these.
double Certificate::linear_scale() const {
  return std::max({largest_linear_, std::sqrt(2.0 * system_.model().mass() * largest_kinetic_),
                   pushed_linear_});
}

double Certificate::angular_scale() const {
  return std::max({largest_angular_, system_.model().length() * linear_scale(), pushed_angular_});
}

std::vector<Certificate::Amount> Certificate::amounts() const {
  if (!shows_work_) return {};
  const auto amount = [this](const char* name, double model::StepWork::*what) {
    Amount row{name, work_.*what, {}};
    const std::vector<std::string>& accounts = books_.accounts();
    for (std::size_t i = 0; i < books_.works().size(); ++i) {
      const double value = books_.works()[i].*what;
      const bool has_account = i < accounts.size();
      if (value == 0.0 || (!has_account && row.shares.empty())) continue;
      row.shares.emplace_back(has_account ? accounts[i] : "others", value);
    }
    return row;
  };
  return {amount("work of loads", &model::StepWork::external),
          amount("work of drives", &model::StepWork::drives),
          amount("energy taken by dampers", &model::StepWork::damping),
          amount("energy taken by dissipation", &model::StepWork::dissipation)};
}

std::vector<std::pair<std::string, double>> Certificate::numbers() const {
  std::vector<std::pair<std::string, double>> numbers = {{"kinetic energy", last_.kinetic},
                                                         {"strain energy", last_.strain},
                                                         {"potential energy", last_.potential}};
  for (const Amount& row : amounts()) {
    numbers.emplace_back(row.name, row.value);
    for (const auto& [account, value] : row.shares) {
      numbers.emplace_back(row.name + ", " + account, value);
    }
  }
  numbers.emplace_back("relative energy drift", relative(energy_drift_, energy_scale()));
  numbers.emplace_back("constraint drift", constraint_violation_);
  if (hidden_violation_) numbers.emplace_back("hidden constraint violation", *hidden_violation_);
  if (is_free_) {
    numbers.emplace_back("relative linear momentum drift", relative(linear_drift_, linear_scale()));
    numbers.emplace_back("relative angular momentum drift",
                         relative(angular_drift_, angular_scale()));
  }
  return numbers;
}

// Velocities of rounding turn round from step to step and may grow with each.
double Certificate::moved_by_rounding() const { return rounding_ * steps_ * steps_; }

std::string Certificate::excuse(bool is_rounding) const {
  if (!promises_) return "not promised by this scheme";
  return is_rounding ? "not judged: nothing moves but rounding" : "";
}

std::vector<Certificate::Line> Certificate::lines() const {
  const double moved = moved_by_rounding();
  std::vector<Line> lines = {{"energy balance", relative(energy_drift_, energy_scale()),
                              energy_promise,
                              excuse(largest_energy() <= moved || largest_amount_ == 0.0)}};
  if (is_free_) {
    // what stands in equilibrium may hold much energy, and has no momentum but that of rounding
    const double momentum = std::sqrt(2.0 * system_.model().mass() * moved);
    const bool rests = largest_kinetic_ <= moved && largest_linear_ <= momentum &&
                       largest_angular_ <= system_.model().length() * momentum;
    lines.push_back({"linear momentum", relative(linear_drift_, linear_scale()), momentum_promise,
                     excuse(rests)});
    lines.push_back({"angular momentum", relative(angular_drift_, angular_scale()),
                     momentum_promise, excuse(rests)});
  }
  lines.push_back({"constraints", constraint_violation_, constraint_promise});
  return lines;
}

std::string Certificate::broken() const {
  std::vector<std::string> found;
  for (const Line& line : lines()) {
    if (!line.excuse.empty() || holds(line.drift, line.promise)) continue;
    found.push_back(
        fmt::format("{} {:.2e} (kept up to {:.0e})", line.name, line.drift, line.promise));
  }
  return join(found, ", ");
}

std::string Certificate::text() const {
  std::string text = fmt::format("conservation over {} steps\n", steps_);
  const auto line = [&text](const std::string& name, double first, double last) {
    text += fmt::format("  {:<28} {:>16.9g} J  -> {:>16.9g} J\n", name, first, last);
  };
  line("kinetic energy", first_.kinetic, last_.kinetic);
  line("strain energy", first_.strain, last_.strain);
  line("potential energy", first_.potential, last_.potential);
  for (const Amount& row : amounts()) {
    text += fmt::format("  {:<28} {:>41.9g} J\n", row.name, row.value);
    for (const auto& [account, value] : row.shares) {
      text += fmt::format("    {:<26} {:>41.9g} J\n", account, value);
    }
  }
  if (!shows_work_) {
    text += "  work: not summed, as forces of this scheme do not act in the middle of steps\n";
  }
  for (const Line& one : lines()) {
    if (one.name == "constraints" && !is_free_) {
      text += "  momenta: the model is held, so supports change them\n";
    }
    const char* verdict = holds(one.drift, one.promise) ? "kept" : "BROKEN";
    text += fmt::format("  {:<28} {:.2e}  {}\n", one.name, one.drift,
                        one.excuse.empty() ? verdict : one.excuse);
  }
  if (hidden_violation_) {
    text += fmt::format("  {:<28} {:.2e}  of the velocity, second order of the step\n",
                        "hidden constraints", *hidden_violation_);
  }
  return text;
}

}  // namespace culm::analysis
