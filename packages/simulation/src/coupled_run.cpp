#include "coupled_run.hpp"

#include <culm/base/error.hpp>
#include <culm/coupling/messages.hpp>
#include <culm/coupling/partner_error.hpp>

#include "on_root.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <utility>

namespace culm::simulation {
namespace {

using coupling::bit;
using Eigen::VectorXd;
using port::Quantity;

// Share of what was exchanged that an interface may make or lose.
constexpr double notable_gap = 1e-3;

const Options& settings_of(const Options& deck) { return deck.list("Coupling"); }

}  // namespace

CoupledRun::CoupledRun(const Options& deck, const coupling::PartnerRegistry& known,
                       const CoupledFiles& files, const Ports& ports, const parallel::Comm& comm,
                       Findings& findings)
    : settings_(settings_of(deck)),
      comm_(comm),
      findings_(findings),
      scheme_(coupling::make_scheme(settings_)),
      is_one_way_(settings_.text("Scheme") == "One Way"),
      is_replay_(!files.replay.empty()) {
  const std::vector<Options>& analyses = deck.list("Analyses").entries();
  if (std::none_of(analyses.begin(), analyses.end(),
                   [](const Options& one) { return one.text("Type") == "Dynamic"; })) {
    throw InputError(settings_.where(), "acts in analyses of type 'Dynamic', and there is none");
  }
  sides_ = make_sides(settings_, known, files, ports, comm_);
}

bool CoupledRun::serves(const std::string& port) const {
  return std::any_of(sides_.begin(), sides_.end(),
                     [&](const CoupledSide& side) { return side.port_name == port; });
}

analysis::AnalysisReport CoupledRun::run(analysis::Stepper& stepper, assembly::System& system,
                                         const Ports& ports, analysis::Observer& observer) {
  for (CoupledSide& side : sides_) {
    for (const auto& port : ports) {
      if (port->name() == side.port_name) side.port = port.get();
    }
  }
  std::optional<double> length;
  if (settings_.has("Window")) length = settings_.number("Window");
  CoupledWindow window(stepper, system, sides_, length);
  if (!has_begun_) {
    system.synchronise(stepper.state());
    begin(stepper.state());
  }
  for (CoupledSide& side : sides_) side.velocity = window.velocity(side);
  while (!stepper.is_at_end()) {
    window.start(windows_, latest_end(stepper.time()));
    try {
      if (!make_window(window)) window.fail();
    } catch (...) {
      window.abandon();
      throw;
    }
    observer.step(window.report(), stepper.state());
    if (stepper.is_exhausted()) stepper.give_up();
  }
  analysis::AnalysisReport report = stepper.finish();
  close_books(report, stepper.time());
  for (const CoupledSide& side : sides_) side.set(VectorXd::Zero(loads_.size()));
  return report;
}

void CoupledRun::begin(const model::State& state) {
  has_begun_ = true;
  const bool goes_on = resumed_ != nullptr && resumed_->has("coupling/counts");
  Eigen::Index count = 0;
  for (CoupledSide& side : sides_) {
    side.first = count;
    count += side.count();
    side.size = size_of(side.port->reference());
  }
  loads_ = VectorXd::Zero(count);
  if (goes_on) {
    const std::span<const double> counts = resumed_->numbers("coupling/counts", 3);
    windows_ = static_cast<int>(counts[0]);
    attempts_ = static_cast<int>(counts[1]);
    most_attempts_ = static_cast<int>(counts[2]);
    loads_ = as_vector(resumed_->numbers("coupling/loads", static_cast<std::size_t>(count)));
    scheme_->restore(*resumed_);
  }
  for (CoupledSide& side : sides_) {
    const std::string prefix = "coupling/side " + side.name + "/";
    double wanted = 0.0;
    on_root(comm_, [&] {
      side.partner->begin({side.port_name, state.time_prev, side.port->reference(),
                           side.port->read(Quantity::velocity, state), windows_});
      if (goes_on) side.partner->restore(prefix, *resumed_);
      wanted = side.partner->wanted();
    });
    side.wanted = static_cast<coupling::Quantities>(comm_.max(wanted)) | bit(Quantity::motion);
    if (!scheme_->is_implicit()) side.wanted |= bit(Quantity::velocity);
    if (!goes_on) continue;
    const std::span<const double> books = resumed_->numbers(prefix + "side", 5);
    side.work = books[0];
    side.exchanged = books[1];
    side.stiffness = books[2];
    side.books = {books[3], books[4]};
  }
}

double CoupledRun::latest_end(double start) const {
  double latest = std::numeric_limits<double>::infinity();
  if (comm_.is_root()) {
    for (const CoupledSide& side : sides_)
      latest = std::min(latest, side.partner->latest_end(start));
  }
  if (comm_.size() > 1) comm_.broadcast({&latest, 1});
  return latest;
}

bool CoupledRun::make_window(CoupledWindow& window) {
  if (is_one_way_ || is_replay_) {
    for (std::size_t i = 0; i < sides_.size(); ++i) {
      coupling::Window still = window.at_rest(i);
      ask(still, sides_[i], loads_);
    }
  } else if (scheme_->is_implicit()) {
    return repeat(window);
  }
  for (const CoupledSide& side : sides_) side.set(loads_);
  if (!window.go()) {
    window.go_back();
    return false;
  }
  if (is_one_way_ || is_replay_) {
    accept(window, 1);
    return true;
  }
  const VectorXd answer = ask(window, 0);
  watch(window, answer);
  accept(window, 1);
  loads_ = answer;
  return true;
}

bool CoupledRun::repeat(CoupledWindow& window) {
  const int most = settings_.integer("Most Attempts");
  VectorXd bearable;  // the last loads that the structure converged with
  for (CoupledSide& side : sides_) side.answer.resize(0);
  for (int tried = 0; tried < most; ++tried) {
    for (const CoupledSide& side : sides_) side.set(loads_);
    if (!window.go()) {
      if (tried == 0) {
        window.go_back();
        return false;
      }
      loads_ = 0.5 * (loads_ + bearable);  // a guess that the structure cannot bear
      continue;
    }
    bearable = loads_;
    const VectorXd answer = ask(window, tried);
    if (is_enough(answer)) {
      accept(window, tried + 1);
      loads_ = answer;
      scheme_->end_window();
      return true;
    }
    loads_ = scheme_->next(loads_, answer);
  }
  give_up(window);
}

// Puts the loads of a side that answer to a window into those of all.
void CoupledRun::ask(coupling::Window& about, CoupledSide& side, VectorXd& answer) {
  VectorXd own(side.count());
  on_root(comm_, [&] {
    own = side.partner->loads(about);
    const std::string objection = coupling::objection_to(own, side.port->size());
    if (objection.empty()) return;
    throw PartnerError(fmt::format(
        "the partner '{}' at port '{}' failed in window {}, attempt {}, from {:g} s to {:g} s: {}",
        side.name, side.port_name, about.number, about.attempt, about.start, about.end, objection));
  });
  if (comm_.size() > 1) comm_.broadcast({own.data(), static_cast<std::size_t>(own.size())});
  side.put(std::move(own), answer);
}

VectorXd CoupledRun::ask(const CoupledWindow& window, int attempt) {
  VectorXd answer(loads_.size());
  for (std::size_t i = 0; i < sides_.size(); ++i) {
    CoupledSide& side = sides_[i];
    coupling::Window about = window.about(i, attempt);
    ask(about, side, answer);
    // how much of a change of motion comes back as load, for what rounding of motion makes of it
    const VectorXd moved = as_vector(about.of(Quantity::motion));
    const VectorXd own = answer.segment(side.first, side.count());
    if (side.answer.size() > 0) {
      const double change = (moved - side.moved).norm();
      constexpr double rounding = 1e4 * std::numeric_limits<double>::epsilon();
      if (change > rounding * as_vector(side.port->reference()).norm()) {
        side.stiffness = std::max(side.stiffness, (own - side.answer).norm() / change);
      }
    }
    side.acted = loads_.segment(side.first, side.count());
    side.moved = moved;
    side.answer = own;
  }
  return answer;
}

// What is asked for, and what rounding of positions makes of loads.
bool CoupledRun::is_enough(const VectorXd& answer) const {
  constexpr double round_off = 16.0 * std::numeric_limits<double>::epsilon();
  return std::all_of(sides_.begin(), sides_.end(), [&](const CoupledSide& side) {
    const auto own = answer.segment(side.first, side.count());
    const auto before = loads_.segment(side.first, side.count());
    const double floor = round_off * as_vector(side.port->reference()).norm() * side.stiffness;
    return (own - before).norm() <= settings_.number("Tolerance") * own.norm() + floor;
  });
}

// Windows of several steps are not probed: they would have to be made once more.
void CoupledRun::watch(CoupledWindow& window, const VectorXd& answer) {
  std::vector<VectorXd> acceleration;
  for (std::size_t i = 0; i < sides_.size(); ++i) {
    const coupling::Window about = window.about(i, 0);
    acceleration.emplace_back((translations(about.of(Quantity::velocity)) - sides_[i].velocity) /
                              window.length());
  }
  for (std::size_t i = 0; i < sides_.size(); ++i) {
    CoupledSide& side = sides_[i];
    const VectorXd own = side.loads(answer);
    side.loose.add(translations({own.begin(), own.end()}), acceleration[i]);
    const VectorXd probe = window.has_steps() ? VectorXd() : side.loose.probe();
    if (probe.size() > 0) {
      VectorXd loads = loads_;
      VectorXd more = VectorXd::Zero(side.count());
      more.reshaped(6, side.count() / 6).topRows<3>() = probe.reshaped(3, side.count() / 6);
      side.put(side.loads(loads_) + more, loads);
      side.set(loads);
      const double end = window.end();
      if (window.go() && window.end() == end) {
        const VectorXd faster =
            (translations(window.about(i, 0).of(Quantity::velocity)) - side.velocity) /
                window.length() -
            acceleration[i];
        side.loose.measure(probe, faster);
      }
      side.set(loads_);
      window.go();  // as it was, bit by bit
    }
    if (const std::string danger = side.loose.warning(); !danger.empty()) {
      findings_.warn("loose coupling", "partner '" + side.name + "': " + danger, window.start());
    }
  }
}

void CoupledRun::accept(CoupledWindow& window, int attempts) {
  for (std::size_t i = 0; i < sides_.size(); ++i) {
    CoupledSide& side = sides_[i];
    coupling::Window about = window.about(i, attempts - 1);
    const VectorXd acted = side.loads(loads_);
    about.loads.assign(acted.begin(), acted.end());
    const double work = acted.dot(as_vector(about.of(Quantity::motion)));
    side.work += work;
    side.exchanged += std::abs(work);
    if (!scheme_->is_implicit()) side.velocity = translations(about.of(Quantity::velocity));
    if (is_one_way_)
      std::fill(about.of(Quantity::motion).begin(), about.of(Quantity::motion).end(), 0.0);
    std::array<double, 2> books = {};
    on_root(comm_, [&] {
      side.partner->accept(about);
      const coupling::Books own = side.partner->books();
      books = {own.energy, own.dissipated};
    });
    if (comm_.size() > 1) comm_.broadcast(books);
    side.books = {books[0], books[1]};
  }
  window.accept();
  ++windows_;
  attempts_ += attempts;
  most_attempts_ = std::max(most_attempts_, attempts);
}

// Where loads and answer differ most.
std::string CoupledRun::worst_point() const {
  const CoupledSide* worst = nullptr;
  Eigen::Index place = 0;
  double most = -1.0;
  for (const CoupledSide& side : sides_) {
    if (side.answer.size() == 0) continue;
    const VectorXd miss = side.answer - side.acted;
    Eigen::Index i = 0;
    const double size = miss.cwiseAbs().maxCoeff(&i);
    if (size > most) {
      most = size;
      place = i;
      worst = &side;
    }
  }
  if (worst == nullptr) return "there was no answer";
  return fmt::format("'{}' answers {:.3g} for {:.3g} at point {} of port '{}', component {}",
                     worst->name, worst->answer[place], worst->acted[place], place / 6,
                     worst->port_name, place % 6);
}

void CoupledRun::give_up(const CoupledWindow& window) const {
  const bool is_robust = settings_.text("Scheme") == "Quasi Newton";
  throw NumericalError(fmt::format(
      "Structure and partners did not agree in {} attempts of the window from {:g} s to {:g} s; "
      "{}.\n"
      "Try: {}more 'Most Attempts', a larger 'Tolerance', a smaller 'Step' or 'Window'; or the "
      "loads "
      "grow with the motion, as in flutter.",
      settings_.integer("Most Attempts"), window.start(), window.end(), worst_point(),
      is_robust ? "" : "'Scheme' = Quasi Newton, which is the most robust one, "));
}

void CoupledRun::close_books(analysis::AnalysisReport& report, double time) {
  report.text +=
      fmt::format("coupling: {} windows, {:.1f} attempts per window, at most {}\n", windows_,
                  static_cast<double>(attempts_) / std::max(windows_, 1), most_attempts_);
  report.numbers.emplace_back("coupling windows", windows_);
  report.numbers.emplace_back("coupling attempts", attempts_);
  for (CoupledSide& side : sides_) {
    report.text += fmt::format(
        "interface '{}' at port '{}'\n  work on the structure             {:>20.12g} J\n",
        side.name, side.port_name, side.work);
    report.numbers.emplace_back("work of partner " + side.name, side.work);
    std::string complaint;
    on_root(comm_, [&] { complaint = side.partner->complaint(); });
    if (comm_.size() > 1) complaint = comm_.broadcast(complaint);
    if (!complaint.empty()) findings_.broken("coupling", complaint, time);
    const double gap = side.work + side.books.energy + side.books.dissipated;
    if (is_one_way_ || !std::isfinite(gap)) {
      report.text += is_one_way_ ? "  the partner does not see the motion: no balance\n"
                                 : "  the partner keeps no books: no balance\n";
      continue;
    }
    report.text += fmt::format(
        "  energy that the partner gained    {:>20.12g} J\n"
        "  energy that it turned into heat   {:>20.12g} J\n"
        "  gap                               {:>20.2g} J, ",
        side.books.energy, side.books.dissipated, gap);
    report.numbers.emplace_back("gap of partner " + side.name, gap);
    if (side.exchanged == 0.0) {
      report.text += "and nothing was exchanged\n";
      if (gap != 0.0) {
        findings_.broken("interface",
                         fmt::format("the partner '{}' books {:.3g} J, and nothing went through "
                                     "its port: what it says of its energy is wrong",
                                     side.name, gap),
                         time);
      }
      continue;
    }
    const double share = std::abs(gap) / side.exchanged;
    report.text += fmt::format("{:.1e} of all that was exchanged\n", share);
    if (share <= notable_gap) continue;
    findings_.broken(
        "interface",
        fmt::format("the interface '{}' {} {:.2g} % of the energy that is exchanged: results are "
                    "those of a coupling that is too loose; take a 'Scheme' that repeats windows, "
                    "a smaller 'Tolerance', or means over windows as loads",
                    side.name, gap < 0.0 ? "loses" : "makes", 100.0 * share),
        time);
  }
}

void CoupledRun::save(Snapshot& snapshot) {
  if (!has_begun_) return;
  snapshot.set("coupling/counts", {static_cast<double>(windows_), static_cast<double>(attempts_),
                                   static_cast<double>(most_attempts_)});
  snapshot.set("coupling/loads", {loads_.begin(), loads_.end()});
  scheme_->save(snapshot);
  for (CoupledSide& side : sides_) {
    const std::string prefix = "coupling/side " + side.name + "/";
    snapshot.set(prefix + "side", {side.work, side.exchanged, side.stiffness, side.books.energy,
                                   side.books.dissipated});
    on_root(comm_, [&] { side.partner->save(prefix, snapshot); });
  }
}

void CoupledRun::report_left_over(double time) {
  for (const CoupledSide& side : sides_) {
    std::string words;
    on_root(comm_, [&] { words = side.partner->left_over(); });
    if (comm_.size() > 1) words = comm_.broadcast(words);
    if (!words.empty()) findings_.broken("coupling", words, time);
  }
}

void CoupledRun::end(const std::string& why) {
  if (!comm_.is_root() || !has_begun_) return;
  for (CoupledSide& side : sides_) side.partner->end(why);
}

}  // namespace culm::simulation
