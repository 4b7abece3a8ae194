#include "coupled_run.hpp"

#include <culm/base/error.hpp>
#include <culm/base/nearest.hpp>
#include <culm/coupling/loose_watch.hpp>
#include <culm/coupling/record.hpp>
#include <culm/output/file_part.hpp>

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
// Of a window: how near two ends of it may be to count as one.
constexpr double same_end = 1e-9;

// Root mean square distance of points from their centre, by which moments become forces; of one
// point one metre.
double size_of(const std::vector<double>& points) {
  const Eigen::Map<const Eigen::Matrix3Xd> x(points.data(), 3,
                                             static_cast<Eigen::Index>(points.size() / 3));
  const Vec3 centre = x.rowwise().mean();
  const double size =
      std::sqrt((x.colwise() - centre).squaredNorm() / static_cast<double>(x.cols()));
  return size > 0.0 ? size : 1.0;
}

// The first three of six numbers per point.
VectorXd translations(const std::vector<double>& values) {
  const Eigen::Map<const Eigen::Matrix<double, 6, Eigen::Dynamic>> all(
      values.data(), 6, static_cast<Eigen::Index>(values.size() / 6));
  return all.topRows<3>().reshaped();
}

VectorXd as_vector(const std::vector<double>& values) {
  return Eigen::Map<const VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

const Options& settings_of(const Options& deck) { return deck.list("Coupling"); }

}  // namespace

struct CoupledRun::Side {
  std::string name;
  std::string port_name;
  std::unique_ptr<coupling::Partner> partner;  // on the root
  port::Port* port = nullptr;                  // of the present model
  Eigen::Index first = 0;                      // of its loads among all
  double size = 1.0;                           // of the port [m]
  coupling::Quantities wanted = 0;
  double work = 0.0;       // that the structure got [J]
  double exchanged = 0.0;  // sum of the sizes of the works of all windows [J]
  coupling::Books books;
  double stiffness = 0.0;         // the largest change of answers by motion that was seen [N/m]
  VectorXd acted, moved, answer;  // in the last attempt in this window
  VectorXd velocity;              // at the start of the window, of schemes that are watched
  coupling::LooseWatch loose;

  Eigen::Index count() const { return 6 * static_cast<Eigen::Index>(port->size()); }

  // Loads in the units of each.
  VectorXd loads(const VectorXd& all) const {
    VectorXd own = all.segment(first, count());
    own.reshaped(6, count() / 6).bottomRows<3>() *= size;
    return own;
  }
  void put(VectorXd own, VectorXd& all) const {
    own.reshaped(6, count() / 6).bottomRows<3>() /= size;
    all.segment(first, count()) = own;
  }
  void set(const VectorXd& all) const {
    const VectorXd own = loads(all);
    const Eigen::Matrix<double, 6, Eigen::Dynamic> table = own.reshaped(6, count() / 6);
    const VectorXd forces = table.topRows<3>().reshaped();
    const VectorXd moments = table.bottomRows<3>().reshaped();
    port->set_loads({forces.data(), static_cast<std::size_t>(forces.size())},
                    {moments.data(), static_cast<std::size_t>(moments.size())});
  }
};

// One step, or several where the deck has windows: then it goes back by a copy of its start.
class CoupledRun::Window {
 public:
  Window(analysis::Stepper& stepper, assembly::System& system, std::vector<Side>& sides,
         std::optional<double> length)
      : stepper_(stepper), system_(system), sides_(sides), length_(length) {}

  void start(int number, double latest) {
    number_ = number;
    start_ = stepper_.time();
    latest_ = latest;
    is_ahead_ = false;
    may_cut_ = true;
    if (length_) stepper_.save(memory_);
  }

  // Goes to the end of the window with the loads as they are, from its start. @return whether the
  // structure converged
  bool go() {
    go_back();
    motions_.assign(sides_.size(), {});
    return length_ ? go_in_steps() : go_in_one();
  }
  // To the start, with nothing learnt.
  void go_back() {
    if (length_ && is_ahead_) stepper_.restore(memory_);
    is_ahead_ = false;
  }
  // After go().
  void accept() {
    if (!length_) stepper_.accept();
    is_open_ = is_ahead_ = false;
  }
  // To the last accepted state, where something else has failed.
  void abandon() {
    go_back();
    if (is_open_) stepper_.discard();
    is_open_ = false;
  }
  // The structure does not converge, whatever the partners say: gives up, or tries less.
  void fail() {
    if (!length_) stepper_.fail();
    is_open_ = false;
    if (stepper_.is_exhausted()) stepper_.give_up();
  }

  // How the points of a side moved.
  coupling::Window about(std::size_t side, int attempt) const {
    coupling::Window window = motions_[side];
    window.number = number_;
    window.attempt = attempt;
    window.start = start_;
    window.end = end_;
    return window;
  }
  // The same if they stood still.
  coupling::Window at_rest(std::size_t side) {
    coupling::Window window;
    window.number = number_;
    window.start = start_;
    window.end = proposal();
    complete();
    for (const Quantity q : coupling::all_quantities) {
      if ((sides_[side].wanted & bit(q)) == 0) continue;
      std::vector<double>& values = window.of(q) = sides_[side].port->read(q, stepper_.state());
      if (q == Quantity::velocity) std::fill(values.begin(), values.end(), 0.0);
    }
    return window;
  }
  VectorXd velocity(const Side& side) {
    complete();
    return translations(side.port->read(Quantity::velocity, stepper_.state()));
  }

  double start() const { return start_; }
  double end() const { return end_; }
  double length() const { return end_ - start_; }
  bool has_steps() const { return length_.has_value(); }
  const analysis::StepReport& report() const { return report_; }

 private:
  double proposal() const {
    const double wanted = length_ ? std::min(start_ + *length_, final_time_) : stepper_.proposal();
    return latest_ < wanted - same_end * (wanted - start_) ? latest_ : wanted;
  }

  bool go_in_one() {
    end_ = proposal();
    is_open_ = false;
    report_ = stepper_.attempt(end_);
    is_open_ = true;
    if (report_.accepted) read(true);
    return report_.accepted;
  }

  bool go_in_steps() {
    const double end = proposal();
    const double tolerance = same_end * (end - start_);
    is_ahead_ = true;
    bool has_cut = false;
    while (stepper_.time() < end - tolerance && !stepper_.is_at_end()) {
      const double step = stepper_.proposal();
      const double target = step > end + tolerance ? end : step;
      report_ = stepper_.attempt(target);
      final_time_ = report_.final_time;
      if (report_.accepted) {
        read(target >= std::min(end, final_time_) - tolerance);
        stepper_.accept();
        report_.is_last = stepper_.is_at_end();
      } else {
        stepper_.fail();
        has_cut = true;
        if (!may_cut_ || stepper_.is_exhausted()) return false;
      }
    }
    end_ = stepper_.time();
    may_cut_ = has_cut;
    return true;
  }

  // The state with both ends of the step, on all ranks.
  void complete() {
    system_.synchronise(stepper_.state());
    system_.complete(stepper_.state().prev);
  }

  // Motions add up over the steps; all else is that of the last one.
  void read(bool is_last) {
    complete();
    for (std::size_t i = 0; i < sides_.size(); ++i) {
      coupling::Window& window = motions_[i];
      for (const Quantity q : coupling::all_quantities) {
        if ((sides_[i].wanted & bit(q)) == 0 || (!is_last && q != Quantity::motion)) continue;
        std::vector<double> values = sides_[i].port->read(q, stepper_.state());
        std::vector<double>& sum = window.of(q);
        if (q != Quantity::motion || sum.empty()) {
          sum = std::move(values);
          continue;
        }
        for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += values[k];
      }
    }
  }

  analysis::Stepper& stepper_;
  assembly::System& system_;
  std::vector<Side>& sides_;
  std::optional<double> length_;
  Snapshot memory_ = Snapshot(Snapshot::Use::memory);
  bool is_ahead_ = false;  // steps of the window have been accepted
  bool is_open_ = false;   // its only step has been attempted
  // Whether steps that fail are cut: where none failed in the attempt before, the loads are to
  // blame.
  bool may_cut_ = true;
  int number_ = 0;
  double start_ = 0.0;
  double end_ = 0.0;
  double latest_ = 0.0;
  double final_time_ = std::numeric_limits<double>::infinity();  // known after an attempt
  analysis::StepReport report_;
  std::vector<coupling::Window> motions_;
};

CoupledRun::CoupledRun(const Options& deck, const coupling::PartnerRegistry& known,
                       CoupledFiles files, const Ports& ports, const parallel::Comm& comm,
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
  std::vector<std::string> names;
  for (const auto& port : ports) names.push_back(port->name());
  const std::vector<Options>& partners = settings_.list("Partners").entries();
  if (partners.empty()) {
    throw InputError(settings_.list("Partners").where(), "must hold at least one partner");
  }
  if (is_replay_ && partners.size() > 1) {
    throw UsageError(
        fmt::format("a replay needs a deck with one partner; it has {}", partners.size()));
  }
  for (const Options& entry : partners) {
    Side side;
    side.name = entry.name();
    if (entry.has("Port")) {
      side.port_name = entry.text("Port");
    } else if (names.size() == 1) {
      side.port_name = names.front();
    } else {
      throw InputError(entry.where(), names.empty() ? "needs a port, and the deck has none"
                                                    : "needs 'Port': the deck has " +
                                                          std::to_string(names.size()));
    }
    if (std::find(names.begin(), names.end(), side.port_name) == names.end()) {
      throw InputError(entry.where("Port"), "there is no port '" + side.port_name + "'" +
                                                did_you_mean(side.port_name, names));
    }
    if (serves(side.port_name)) {
      throw InputError(entry.where(), "port '" + side.port_name + "' has a partner already");
    }
    const auto port = std::find_if(ports.begin(), ports.end(),
                                   [&](const auto& one) { return one->name() == side.port_name; });
    std::string objection;
    on_root(comm_, [&] {
      if (is_replay_) {
        side.partner = std::make_unique<coupling::ReplayedPartner>(
            coupling::read_record(files.replay), files.replay.string());
        return;
      }
      side.partner = known.make(entry.text("Type"), entry);
      objection = side.partner->objection((*port)->size());
      if (!settings_.flag("Record")) return;
      side.partner = std::make_unique<coupling::RecordedPartner>(
          std::move(side.partner),
          files.folder / ("coupling_" + output::file_part(side.name) + ".record"));
    });
    if (comm_.size() > 1) objection = comm_.broadcast(objection);
    if (!objection.empty()) throw InputError(entry.where(), objection);
    sides_.push_back(std::move(side));
  }
}

CoupledRun::~CoupledRun() = default;

bool CoupledRun::serves(const std::string& port) const {
  return std::any_of(sides_.begin(), sides_.end(),
                     [&](const Side& side) { return side.port_name == port; });
}

analysis::AnalysisReport CoupledRun::run(analysis::Stepper& stepper, assembly::System& system,
                                         const Ports& ports, analysis::Observer& observer) {
  for (Side& side : sides_) {
    for (const auto& port : ports) {
      if (port->name() == side.port_name) side.port = port.get();
    }
  }
  std::optional<double> length;
  if (settings_.has("Window")) length = settings_.number("Window");
  Window window(stepper, system, sides_, length);
  if (!has_begun_) {
    system.synchronise(stepper.state());
    begin(stepper.state());
  }
  for (Side& side : sides_) side.velocity = window.velocity(side);
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
  for (const Side& side : sides_) side.set(VectorXd::Zero(loads_.size()));
  return report;
}

void CoupledRun::begin(const model::State& state) {
  has_begun_ = true;
  const bool goes_on = resumed_ != nullptr && resumed_->has("coupling/counts");
  Eigen::Index count = 0;
  for (Side& side : sides_) {
    side.first = count;
    count += side.count();
    side.size = size_of(side.port->reference());
  }
  loads_ = VectorXd::Zero(count);
  if (goes_on) {
    const std::vector<double>& counts = resumed_->numbers("coupling/counts", 3);
    windows_ = static_cast<int>(counts[0]);
    attempts_ = static_cast<int>(counts[1]);
    most_attempts_ = static_cast<int>(counts[2]);
    loads_ = as_vector(resumed_->numbers("coupling/loads", static_cast<std::size_t>(count)));
    scheme_->restore(*resumed_);
  }
  for (Side& side : sides_) {
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
    const std::vector<double>& books = resumed_->numbers(prefix + "side", 5);
    side.work = books[0];
    side.exchanged = books[1];
    side.stiffness = books[2];
    side.books = {books[3], books[4]};
  }
}

double CoupledRun::latest_end(double start) const {
  double latest = std::numeric_limits<double>::infinity();
  if (comm_.is_root()) {
    for (const Side& side : sides_) latest = std::min(latest, side.partner->latest_end(start));
  }
  if (comm_.size() > 1) comm_.broadcast({&latest, 1});
  return latest;
}

bool CoupledRun::make_window(Window& window) {
  if (is_one_way_ || is_replay_) {
    for (std::size_t i = 0; i < sides_.size(); ++i) {
      coupling::Window still = window.at_rest(i);
      ask(still, sides_[i], loads_);
    }
  } else if (scheme_->is_implicit()) {
    return repeat(window);
  }
  for (const Side& side : sides_) side.set(loads_);
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

bool CoupledRun::repeat(Window& window) {
  const int most = settings_.integer("Most Attempts");
  VectorXd bearable;  // the last loads that the structure converged with
  for (Side& side : sides_) side.answer.resize(0);
  for (int tried = 0; tried < most; ++tried) {
    for (const Side& side : sides_) side.set(loads_);
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
void CoupledRun::ask(coupling::Window& about, Side& side, VectorXd& answer) {
  VectorXd own(side.count());
  on_root(comm_, [&] {
    own = side.partner->loads(about);
    for (Eigen::Index i = 0; i < own.size(); ++i) {
      if (std::isfinite(own[i])) continue;
      throw NonFiniteError(fmt::format(
          "partner '{}' answered {} for component {} at point {} of port '{}', in window {} from "
          "{:g} s to {:g} s, attempt {}",
          side.name, own[i], i % 6, i / 6, side.port_name, about.number, about.start, about.end,
          about.attempt));
    }
  });
  if (comm_.size() > 1) comm_.broadcast({own.data(), static_cast<std::size_t>(own.size())});
  side.put(std::move(own), answer);
}

VectorXd CoupledRun::ask(const Window& window, int attempt) {
  VectorXd answer(loads_.size());
  for (std::size_t i = 0; i < sides_.size(); ++i) {
    Side& side = sides_[i];
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
  return std::all_of(sides_.begin(), sides_.end(), [&](const Side& side) {
    const auto own = answer.segment(side.first, side.count());
    const auto before = loads_.segment(side.first, side.count());
    const double floor = round_off * as_vector(side.port->reference()).norm() * side.stiffness;
    return (own - before).norm() <= settings_.number("Tolerance") * own.norm() + floor;
  });
}

// Windows of several steps are not probed: they would have to be made once more.
void CoupledRun::watch(Window& window, const VectorXd& answer) {
  std::vector<VectorXd> acceleration;
  for (std::size_t i = 0; i < sides_.size(); ++i) {
    const coupling::Window about = window.about(i, 0);
    acceleration.emplace_back((translations(about.of(Quantity::velocity)) - sides_[i].velocity) /
                              window.length());
  }
  for (std::size_t i = 0; i < sides_.size(); ++i) {
    Side& side = sides_[i];
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

void CoupledRun::accept(Window& window, int attempts) {
  for (std::size_t i = 0; i < sides_.size(); ++i) {
    Side& side = sides_[i];
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
  const Side* worst = nullptr;
  Eigen::Index place = 0;
  double most = -1.0;
  for (const Side& side : sides_) {
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

void CoupledRun::give_up(const Window& window) const {
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
  for (Side& side : sides_) {
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
    const double share = side.exchanged > 0.0 ? std::abs(gap) / side.exchanged : 0.0;
    report.text += fmt::format(
        "  energy that the partner gained    {:>20.12g} J\n"
        "  energy that it turned into heat   {:>20.12g} J\n"
        "  gap                               {:>20.2g} J, {:.1e} of all that was exchanged\n",
        side.books.energy, side.books.dissipated, gap, share);
    report.numbers.emplace_back("gap of partner " + side.name, gap);
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
  for (Side& side : sides_) {
    const std::string prefix = "coupling/side " + side.name + "/";
    snapshot.set(prefix + "side", {side.work, side.exchanged, side.stiffness, side.books.energy,
                                   side.books.dissipated});
    on_root(comm_, [&] { side.partner->save(prefix, snapshot); });
  }
}

void CoupledRun::end(const std::string& why) {
  if (!comm_.is_root() || !has_begun_) return;
  for (Side& side : sides_) side.partner->end(why);
}

}  // namespace culm::simulation
