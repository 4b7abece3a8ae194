// What was attempted, discarded or gone back from leaves no trace: the steps of decks, made twice,
// once straight on and once with detours, are equal bit by bit.
//
// usage: culm_rollback [--modified-newton] deck.xml ...

#include <culm/base/error.hpp>
#include <culm/simulation/session.hpp>
#include <culm/simulation/simulation.hpp>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace {

using namespace culm;

constexpr int most_steps = 4;

// A deck in the hands of this program; what it says is kept.
class Deck {
 public:
  Deck(const std::string& path, std::vector<std::string> settings)
      : source_(simulation::read_source(comm_, path, std::move(settings))),
        options_(simulation::read_deck(catalogue_, source_)),
        simulation_(comm_, catalogue_, options_, source_, Log(said_, LogLevel::info)) {}

  std::vector<std::string> stepped_analyses() const {
    std::vector<std::string> names;
    for (const Options& entry : options_.list("Analyses").entries()) {
      if (!catalogue_.analyses.inspections.contains(entry.text("Type"))) {
        names.push_back(entry.name());
      }
    }
    return names;
  }
  analysis::Stepper& begin(const std::string& analysis) {
    const std::string type = options_.list("Analyses").list(analysis).text("Type");
    is_path_ = catalogue_.analyses.follows_path.contains(type);
    return simulation_.begin(analysis);
  }
  // Up to date on all ranks: what a rank does not need may lag behind.
  const model::State& state() { return simulation_.state(); }
  // A share of the proposed step; paths are told the length of their way.
  double target(const analysis::Stepper& stepper, double share) const {
    const double proposal = stepper.proposal();
    const double from = is_path_ ? 0.0 : stepper.state().time_prev;
    return share == 1.0 ? proposal : from + share * (proposal - from);
  }

 private:
  parallel::Comm comm_;
  simulation::Catalogue catalogue_;
  std::ostringstream said_;
  simulation::DeckSource source_;
  Options options_;
  simulation::Simulation simulation_;
  bool is_path_ = false;
};

// As a run makes it. @return whether it was accepted
bool step(const Deck& deck, analysis::Stepper& stepper) {
  const bool accepted = stepper.attempt(deck.target(stepper, 1.0)).accepted;
  if (stepper.is_at_end()) {
    stepper.discard();
    return false;
  }
  accepted ? stepper.accept() : stepper.fail();
  return accepted;
}

// Other steps, then back; two steps on, one of them cut short, then back.
void wander(const Deck& deck, analysis::Stepper& stepper) {
  for (const double share : {0.37, 1.6}) stepper.attempt(deck.target(stepper, share));
  stepper.discard();
  Snapshot here(Snapshot::Use::memory);
  stepper.save(here);
  for (const double share : {1.0, 0.5}) {
    const bool accepted = stepper.attempt(deck.target(stepper, share)).accepted;
    if (stepper.is_at_end()) break;
    accepted ? stepper.accept() : stepper.fail();
  }
  stepper.restore(here);
  stepper.attempt(deck.target(stepper, 0.37));
  stepper.discard();
}

bool is_equal(const model::State& one, const model::State& two, const analysis::Stepper& a,
              const analysis::Stepper& b) {
  return one.time == two.time && std::ranges::equal(one.next, two.next) &&
         std::ranges::equal(one.velocity, two.velocity) && one.multipliers == two.multipliers &&
         one.own == two.own && a.steps() == b.steps() && a.proposal() == b.proposal();
}

// Old factors serve on in all analyses that make steps.
std::vector<std::string> modified_newton(const std::string& path) {
  std::vector<std::string> settings;
  for (const std::string& name : Deck(path, {}).stepped_analyses()) {
    settings.push_back("Analyses/" + name + "/Newton/Refresh=On Slow Convergence");
  }
  return settings;
}

// @return what differs; empty if nothing does
std::string compare(const std::string& path, const std::vector<std::string>& settings) {
  Deck straight(path, settings), wandering(path, settings);
  for (const std::string& name : straight.stepped_analyses()) {
    analysis::Stepper& a = straight.begin(name);
    analysis::Stepper& b = wandering.begin(name);
    const auto are_equal = [&] { return is_equal(straight.state(), wandering.state(), a, b); };
    for (int i = 1; i <= most_steps && !a.is_at_end(); ++i) {
      wander(wandering, b);
      if (!are_equal()) return name + ", back at step " + std::to_string(i);
      step(straight, a);
      step(wandering, b);
      if (!are_equal()) return name + ", step " + std::to_string(i);
      if (a.is_exhausted()) break;
    }
  }
  return {};
}

}  // namespace

int main(int argc, char** argv) {
  const culm::simulation::Session session(argc, argv);
  const bool keeps_factors = argc > 1 && std::string_view(argv[1]) == "--modified-newton";
  const int first = keeps_factors ? 2 : 1;
  int failed = 0;
  for (int i = first; i < argc; ++i) {
    std::string difference;
    try {
      difference =
          compare(argv[i], keeps_factors ? modified_newton(argv[i]) : std::vector<std::string>());
    } catch (const std::exception& error) {
      difference = error.what();
    }
    if (difference.empty()) continue;
    std::printf("%s: %s\n", argv[i], difference.c_str());
    ++failed;
  }
  std::printf("%d of %d decks differ\n", failed, argc - first);
  return failed == 0 && argc > 1 ? 0 : 1;
}
