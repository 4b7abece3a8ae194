#include "coupled_run.hpp"

#include <culm/base/error.hpp>
#include <culm/coupling/messages.hpp>
#include <culm/coupling/partner_error.hpp>
#include <culm/coupling/remote_partner.hpp>

#include "on_root.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <string_view>

namespace culm::simulation {
namespace {

using coupling::bit;
using Eigen::VectorXd;

// Share of what was exchanged that an interface may make or lose.
constexpr double notable_gap = 1e-3;

const Options& coupling_settings(const Options& deck) { return deck.list("Coupling"); }

std::string percent(double share) {
  return share < 1.0 ? fmt::format("{:.2g} %", 100.0 * share)
                     : fmt::format("{:.0f} %", 100.0 * share);
}

// Where a loose coupling was warned of, it is what the structure died of, and no limit of its own.
std::string blame_coupling(std::string text, const std::vector<CoupledSide>& sides) {
  for (const CoupledSide& side : sides) {
    if (side.danger.empty()) continue;
    constexpr std::string_view cause = "Likely cause: ";
    const std::size_t at = text.find(cause);
    if (at != std::string::npos) text.erase(at);
    return text + fmt::format(
                      "{}the coupling, not the structure. Partner '{}': {}.\n"
                      "Try: 'Scheme' = Quasi Newton.",
                      cause, side.name, side.danger);
  }
  return text;
}

}  // namespace

CoupledRun::CoupledRun(const Options& deck, const coupling::PartnerRegistry& known,
                       const CoupledFiles& files, const Ports& ports, const parallel::Comm& comm,
                       Findings& findings)
    : settings_(coupling_settings(deck)),
      comm_(comm),
      findings_(findings),
      scheme_(coupling::make_scheme(settings_)),
      is_one_way_(settings_.text("Scheme") == "One Way"),
      is_replay_(!files.replay.empty()),
      is_parallel_(settings_.flag("Parallel")) {
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
                                         const Ports& ports,
                                         const std::vector<WatchedQuantity>& watched,
                                         analysis::Observer& observer) {
  for (CoupledSide& side : sides_) {
    for (const auto& port : ports) {
      if (port->name() == side.port_name) side.port = port.get();
    }
  }
  std::optional<double> length;
  if (settings_.has("Window")) length = settings_.number("Window");
  const double whole = stepper.final_time() - stepper.time();
  constexpr double rounding = 1e-9;
  if (length && stepper.steps() == 0 && *length > (1.0 + rounding) * whole) {
    findings_.warn("coupling",
                   fmt::format("{}: a window of {:g} s does not end before the motion, which takes "
                               "{:g} s: all of it is one window",
                               to_string(settings_.where("Window")), *length, whole),
                   stepper.time());
  }
  CoupledWindow window(stepper, system, watched, sides_, length, cuts_);
  if (!has_begun_) {
    system.synchronise(stepper.state());
    begin(stepper.state());
  }
  window.enter();
  while (!stepper.is_at_end()) {
    window.start(windows_, latest_end(stepper.time()));
    try {
      if (!make_window(window)) window.fail();
    } catch (const NumericalError& error) {
      window.abandon();
      throw NumericalError(blame_coupling(error.what(), sides_));
    } catch (...) {
      window.abandon();
      throw;
    }
    for (const analysis::StepReport& report : window.passed()) observer.pass(report);
    observer.step(window.report(), stepper.state());
    if (stepper.is_exhausted()) stepper.give_up();
  }
  analysis::AnalysisReport report = stepper.finish();
  close_books(report, stepper.time());
  for (const CoupledSide& side : sides_) side.set(VectorXd::Zero(loads_.size()));
  return report;
}

void CoupledRun::stay(const std::string& analysis, double time) {
  if (!has_begun_) return;
  findings_.warn("coupling",
                 fmt::format("'Start From' of '{}' takes the structure to another state and leaves "
                             "the partners as they are: what they remember belongs to another "
                             "motion",
                             analysis),
                 time);
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
    cuts_.restore(*resumed_);
    loads_ = as_vector(resumed_->numbers("coupling/loads", static_cast<std::size_t>(count)));
    scheme_->restore(*resumed_);
    if (is_parallel_) scale_.restore(*resumed_);
  }
  for (CoupledSide& side : sides_) begin_side(side, state, goes_on);
}

void CoupledRun::begin_side(CoupledSide& side, const model::State& state, bool goes_on) {
  const std::string prefix = "coupling/side " + side.name + "/";
  double wanted = 0.0;
  on_root(comm_, [&] {
    side.partner->begin({side.port_name, state.time_prev, side.port->reference(),
                         side.port->read(port::Quantity::velocity, state), windows_});
    if (goes_on) side.partner->restore(prefix, *resumed_);
    wanted = side.partner->wanted();
  });
  side.wanted = static_cast<coupling::Quantities>(comm_.max(wanted)) | bit(port::Quantity::motion);
  if (!scheme_->is_implicit()) side.wanted |= bit(port::Quantity::velocity);
  if (!goes_on) return;
  side.books.restore(prefix + "interface", *resumed_);
  side.stiffness = resumed_->number(prefix + "stiffness");
  if (is_parallel_) side.pace.restore(prefix, *resumed_);
  side.began_anew = resumed_->has(prefix + "began anew");
  if (!resumed_->has(prefix + coupling::kept_nothing)) return;
  side.began_anew = true;
  findings_.warn("coupling",
                 fmt::format("the partner '{}' saved nothing with the checkpoint: it begins anew, "
                             "while the structure goes on",
                             side.name),
                 state.time_prev);
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

void CoupledRun::accept(CoupledWindow& window, int attempts) {
  std::vector<coupling::Window> motions = window.about(attempts - 1);
  for (std::size_t i = 0; i < sides_.size(); ++i) {
    CoupledSide& side = sides_[i];
    coupling::Window& about = motions[i];
    const VectorXd acted = side.loads(loads_);
    about.loads.assign(acted.begin(), acted.end());
    const double work = acted.dot(as_vector(about.of(port::Quantity::motion)));
    if (!scheme_->is_implicit()) side.velocity = translations(about.of(port::Quantity::velocity));
    if (is_parallel_) side.pace.add(about);
    if (is_one_way_) {
      std::vector<double>& motion = about.of(port::Quantity::motion);
      if (about.steps.empty()) about.steps = {{about.start, about.end, motion}};  // for a record
      std::fill(motion.begin(), motion.end(), 0.0);
    }
    std::array<double, 2> books = {};
    on_root(comm_, [&] {
      side.partner->accept(about);
      const coupling::Books own = side.partner->books();
      side.expect(windows_ > 0 ? coupling::objection_to(own, side.books.partner)
                               : coupling::objection_to(own),
                  about);
      books = {own.energy, own.dissipated};
    });
    if (comm_.size() > 1) comm_.broadcast(books);
    side.books.add(about, work, {books[0], books[1]});
  }
  window.accept();
  ++windows_;
  attempts_ += attempts;
  most_attempts_ = std::max(most_attempts_, attempts);
}

void CoupledRun::close_books(analysis::AnalysisReport& report, double time) {
  report.text +=
      fmt::format("coupling: {} windows, {:.1f} attempts per window, at most {}\n", windows_,
                  static_cast<double>(attempts_) / std::max(windows_, 1), most_attempts_);
  if (cuts_.count > 0) {
    report.text += fmt::format(
        "  cut back {} times, down to {:g} s, where structure and partners did not agree\n",
        cuts_.count, cuts_.shortest);
    report.numbers.emplace_back("coupling windows cut back", cuts_.count);
  }
  report.numbers.emplace_back("coupling windows", windows_);
  report.numbers.emplace_back("coupling attempts", attempts_);
  for (CoupledSide& side : sides_) {
    report.text += fmt::format(
        "interface '{}' at port '{}'\n  work on the structure             {:>20.12g} J\n",
        side.name, side.port_name, side.books.work);
    report.numbers.emplace_back("work of partner " + side.name, side.books.work);
    std::string complaint;
    on_root(comm_, [&] { complaint = side.partner->complaint(); });
    if (comm_.size() > 1) complaint = comm_.broadcast(complaint);
    if (!complaint.empty()) findings_.broken("coupling", complaint, time);
    balance(side, report, time);
  }
}

// What one side of an interface got and the other one gave.
void CoupledRun::balance(const CoupledSide& side, analysis::AnalysisReport& report, double time) {
  const InterfaceBooks& books = side.books;
  const double gap = books.gap();
  if (is_one_way_ || !std::isfinite(gap)) {
    report.text += is_one_way_ ? "  the partner does not see the motion: no balance\n"
                               : "  the partner keeps no books: no balance\n";
    return;
  }
  report.text += fmt::format(
      "  energy that the partner gained    {:>20.12g} J\n"
      "  energy that it turned into heat   {:>20.12g} J\n"
      "  gap                               {:>20.2g} J, ",
      books.partner.energy, books.partner.dissipated, gap);
  report.numbers.emplace_back("gap of partner " + side.name, gap);
  if (books.exchanged == 0.0) {
    report.text += "and nothing was exchanged\n";
    if (gap != 0.0) {
      findings_.broken("interface",
                       fmt::format("the partner '{}' books {:.3g} J, and nothing went through "
                                   "its port: what it says of its energy is wrong",
                                   side.name, gap),
                       time);
    }
    return;
  }
  const double share = std::abs(gap) / books.exchanged;
  report.text += fmt::format("{:.1e} of all that was exchanged\n", share);
  const std::string worst = fmt::format("from {:g} s to {:g} s {:.3g} J", books.worst_start,
                                        books.worst_end, std::abs(books.worst_gap));
  if (share > notable_gap) {
    findings_.broken(
        "interface",
        fmt::format("the interface '{}' {} {} of the energy that is exchanged, {}: {}", side.name,
                    gap < 0.0 ? "loses" : "makes", percent(share), worst, explain(side)),
        time);
  } else if (scheme_->is_implicit() && std::abs(books.worst_gap) > notable_gap * books.largest) {
    findings_.broken(
        "interface",
        fmt::format(
            "the interface '{}' {} {}, {} of the most that is exchanged in a window, "
            "though little over the run: {}",
            side.name, books.worst_gap < 0.0 ? "loses" : "makes", worst,
            percent(std::abs(books.worst_gap) / books.largest),
            side.began_anew ? explain(side) : "the partner answers or books there what is wrong"),
        time);
  }
}

// Why energy is made or lost at an interface, what is likeliest first.
std::string CoupledRun::explain(const CoupledSide& side) const {
  const std::string wrong = "the partner answers or books what is wrong";
  if (side.began_anew) {
    return "the run was resumed, and the partner had saved nothing and began anew; or " + wrong;
  }
  if (!scheme_->is_implicit() && !is_replay_) {
    return "results are those of a coupling that is too loose; take a 'Scheme' that repeats "
           "windows, or means over windows as loads; or " +
           wrong;
  }
  return fmt::format(
      "{}, since windows are repeated until loads fit to {:g}; or take a smaller "
      "'Tolerance', or means over windows as loads",
      wrong, settings_.number("Tolerance"));
}

void CoupledRun::save(Snapshot& snapshot) {
  if (!has_begun_) return;
  snapshot.set("coupling/counts", {static_cast<double>(windows_), static_cast<double>(attempts_),
                                   static_cast<double>(most_attempts_)});
  snapshot.set("coupling/loads", {loads_.begin(), loads_.end()});
  cuts_.save(snapshot);
  scheme_->save(snapshot);
  if (is_parallel_) scale_.save(snapshot);
  for (CoupledSide& side : sides_) {
    const std::string prefix = "coupling/side " + side.name + "/";
    side.books.save(prefix + "interface", snapshot);
    snapshot.set(prefix + "stiffness", side.stiffness);
    if (side.began_anew) snapshot.set(prefix + "began anew", 1.0);
    if (is_parallel_) side.pace.save(prefix, snapshot);
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
