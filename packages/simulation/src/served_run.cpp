#include "served_run.hpp"

#include <culm/base/error.hpp>
#include <culm/base/nearest.hpp>
#include <culm/coupling/partner_error.hpp>

#include "mpi_partner.hpp"
#include "on_root.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>

namespace culm::simulation {
namespace {

using coupling::bit;
using coupling::Frame;
using coupling::FrameKind;
using Eigen::VectorXd;

}  // namespace

ServedRun::ServedRun(const Options& deck, ServeSettings settings, const Ports& ports,
                     const parallel::Comm& comm)
    : settings_(std::move(settings)), comm_(comm) {
  const Options& analyses = deck.list("Analyses");
  const auto motions =
      std::count_if(analyses.entries().begin(), analyses.entries().end(),
                    [](const Options& one) { return one.text("Type") == "Dynamic"; });
  if (motions != 1) {
    throw InputError(analyses.where(),
                     fmt::format("another program can lead one analysis of type 'Dynamic'; there "
                                 "are {}",
                                 motions));
  }
  if (deck.has_list("Coupling")) {
    throw InputError(deck.list("Coupling").where(),
                     "culm leads these partners, and cannot follow another one");
  }
  std::vector<std::string> names;
  for (const auto& port : ports) names.push_back(port->name());
  if (settings_.port.empty() && names.size() == 1) settings_.port = names.front();
  if (settings_.port.empty()) {
    throw UsageError(names.empty()
                         ? "the deck has no port"
                         : fmt::format("the deck has {} ports: say which by --port", names.size()));
  }
  if (std::find(names.begin(), names.end(), settings_.port) == names.end()) {
    throw UsageError("there is no port '" + settings_.port + "'" +
                     did_you_mean(settings_.port, names));
  }
}

// What goes wrong is said with the name of the partner, and wrong calls are its mistake.
template <class Talk>
void ServedRun::speak(Talk talk) {
  const auto failed = [&](const std::string& why) {
    const std::string name = partner_.name.empty() ? "" : " '" + partner_.name + "'";
    return PartnerError(fmt::format("the partner{} at port '{}' failed after {} steps: {}", name,
                                    settings_.port, accepted_, why));
  };
  on_root(comm_, [&] {
    try {
      talk();
    } catch (const PartnerError& error) {
      throw failed(error.what());
    }
  });
}

analysis::AnalysisReport ServedRun::run(analysis::Stepper& stepper, assembly::System& system,
                                        const Ports& ports, RunObserver& observer) {
  const auto port = std::find_if(ports.begin(), ports.end(),
                                 [&](const auto& one) { return serves(one->name()); });
  Course course{stepper, system, **port, observer};
  greet(course);
  try {
    while (follow(hear(), course)) {
    }
  } catch (...) {
    stepper.abandon();  // results end with the accepted state
    throw;
  }
  was_left_ = was_left_ || !stepper.is_at_end();
  analysis::AnalysisReport report = stepper.finish();
  report.text += fmt::format(
      "led by '{}' at port '{}': {} steps of {} attempts\n  work on the structure             "
      "{:>20.12g} J\n",
      partner_.name, settings_.port, accepted_, attempts_, work_);
  report.numbers.emplace_back("work of partner", work_);
  return report;
}

void ServedRun::greet(Course& course) {
  course.system.synchronise(course.stepper.state());
  const model::State& state = course.stepper.state();
  coupling::Beginning beginning{settings_.port, course.stepper.time(), course.port.reference(),
                                course.port.read(port::Quantity::velocity, state),
                                static_cast<int>(number_)};
  Frame hello = coupling::hello(beginning);
  hello.end = course.stepper.final_time();  // it is the other one that leads
  double wanted = 0.0;
  speak([&] {
    conversation_.emplace(open_channel(settings_.address, settings_.patience), settings_.patience);
    conversation_->say(hello);
    const Frame frame = conversation_->listen();
    if (frame.kind != FrameKind::hello) {
      throw PartnerError(fmt::format("it began with '{}'", name_of(frame.kind)));
    }
    partner_ = coupling::read_introduction(frame);
    if (partner_.points != beginning.points()) {
      throw PartnerError(
          fmt::format("it has {} points, the port has {}", partner_.points, beginning.points()));
    }
    wanted = partner_.wanted;
  });
  partner_.wanted = static_cast<coupling::Quantities>(comm_.max(wanted));
  answer({}, FrameKind::accepted, course);
}

// The same on all ranks.
Frame ServedRun::hear() {
  Frame frame;
  speak([&] { frame = conversation_->hear(); });
  if (comm_.size() == 1) return frame;
  std::array<double, 5> head = {static_cast<double>(frame.kind), static_cast<double>(frame.window),
                                static_cast<double>(frame.attempt), frame.start, frame.end};
  comm_.broadcast(head);
  frame.kind = static_cast<FrameKind>(static_cast<std::uint16_t>(head[0]));
  frame.window = static_cast<std::uint32_t>(head[1]);
  frame.attempt = static_cast<std::uint32_t>(head[2]);
  frame.start = head[3];
  frame.end = head[4];
  frame.payload = comm_.broadcast(std::move(frame.payload));
  return frame;
}

bool ServedRun::follow(const Frame& asked, Course& course) {
  const auto wrong = [&](const std::string& why) {
    speak([&] {
      throw PartnerError(fmt::format("it asked for '{}': {}", name_of(asked.kind), why));
    });
  };
  try {
    switch (asked.kind) {
      case FrameKind::attempt:
        attempt(asked, course);
        return true;
      case FrameKind::accept:
        accept(course);
        answer(asked, FrameKind::accepted, course);
        return true;
      case FrameKind::discard:
        course.stepper.discard();
        answer(asked, FrameKind::discarded, course);
        return true;
      case FrameKind::fail:
        course.stepper.fail();
        if (course.stepper.is_exhausted()) course.stepper.give_up();
        answer(asked, FrameKind::failed, course);
        return true;
      case FrameKind::save:
        save(asked.window, course);
        answer(asked, FrameKind::saved, course);
        return true;
      case FrameKind::restore:
        restore(asked.window, course);
        answer(asked, FrameKind::restored, course);
        return true;
      case FrameKind::keep:
        keep(asked.window, course);
        answer(asked, FrameKind::kept, course);
        return true;
      case FrameKind::bye:
        return false;
      case FrameKind::error:
        speak([&] { throw PartnerError("it says: " + asked.payload); });
        return false;
      default:
        wrong("nobody who leads does so");
    }
  } catch (const UsageError& error) {
    wrong(error.what());
  }
  return false;
}

void ServedRun::attempt(const Frame& asked, Course& course) {
  VectorXd loads;
  speak([&] { loads = coupling::read_answer(asked, course.port.size()); });
  const double last = course.stepper.final_time();
  constexpr double rounding = 1e-9;
  if (!(asked.end <= last + rounding * std::abs(last))) {
    throw UsageError(fmt::format(
        "a step cannot end at {:g} s, the motion of the deck ends at {:g} s", asked.end, last));
  }
  loads.resize(6 * static_cast<Eigen::Index>(course.port.size()));
  if (comm_.size() > 1) comm_.broadcast({loads.data(), static_cast<std::size_t>(loads.size())});
  set_loads(course.port, loads);
  ++attempts_;
  course.report = course.stepper.attempt(asked.end);
  if (!course.report.accepted) {
    speak([&] { conversation_->say(coupling::found(asked, nullptr, partner_.wanted)); });
    return;
  }
  course.system.synchronise(course.stepper.state());
  course.system.complete(course.stepper.state().prev);
  const model::State& state = course.stepper.state();
  course.step_work = course.port.exchange(state).work;
  coupling::Window motion;
  for (const port::Quantity q : coupling::all_quantities) {
    if ((partner_.wanted & bit(q)) != 0) motion.of(q) = course.port.read(q, state);
  }
  speak([&] { conversation_->say(coupling::found(asked, &motion, partner_.wanted)); });
}

void ServedRun::accept(Course& course) {
  course.stepper.accept();
  course.report.is_last = course.stepper.is_at_end();
  work_ += course.step_work;
  ++accepted_;
  course.observer.step(course.report, course.stepper.state());
}

void ServedRun::save(std::uint32_t number, Course& course) {
  Kept kept;
  course.stepper.save(kept.state);
  course.observer.keep(kept.results);
  kept.work = work_;
  kept_.insert_or_assign(number, std::move(kept));
}

void ServedRun::restore(std::uint32_t number, Course& course) {
  const auto kept = kept_.find(number);
  if (kept == kept_.end()) {
    throw UsageError(fmt::format("nothing was saved under the number {}", number));
  }
  course.observer.go_back(kept->second.results);
  course.stepper.restore(kept->second.state);
  work_ = kept->second.work;
  accepted_ = course.stepper.steps();
}

void ServedRun::keep(std::uint32_t number, Course& course) {
  if (number == 0) throw UsageError("checkpoints have numbers above zero");
  number_ = number;
  if (course.observer.write_checkpoint()) return;
  throw UsageError("nothing has been accepted yet, or the deck wants no checkpoints");
}

bool ServedRun::has_led(const Snapshot& snapshot) { return snapshot.has("served/counts"); }

void ServedRun::save(Snapshot& snapshot) const {
  snapshot.set("served/counts", {static_cast<double>(number_), static_cast<double>(accepted_),
                                 static_cast<double>(attempts_), work_});
}

void ServedRun::restore(const Snapshot& snapshot) {
  const std::span<const double> counts = snapshot.numbers("served/counts", 4);
  number_ = static_cast<std::uint32_t>(counts[0]);
  accepted_ = static_cast<int>(counts[1]);
  attempts_ = static_cast<int>(counts[2]);
  work_ = counts[3];
}

// Where the run is now: the accepted time, and where it would go next.
void ServedRun::answer(const Frame& asked, FrameKind kind, const Course& course) {
  Frame frame = {kind, asked.window, asked.attempt, course.stepper.time(), course.stepper.time()};
  if (!course.stepper.is_at_end()) frame.end = course.stepper.proposal();
  coupling::Writer writer;
  writer.add(course.step_work);
  writer.add(work_);
  frame.payload = writer.take();
  speak([&] { conversation_->say(frame); });
}

void ServedRun::end(const std::string& why) {
  if (!conversation_) return;
  try {
    conversation_->say({why.empty() ? FrameKind::bye : FrameKind::error, 0, 0, 0.0, 0.0, why});
  } catch (const PartnerError&) {  // it has left before: nothing is lost
  }
  conversation_.reset();
}

}  // namespace culm::simulation
