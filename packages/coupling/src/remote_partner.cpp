#include <culm/coupling/partner_error.hpp>
#include <culm/coupling/remote_partner.hpp>

#include <fmt/format.h>

#include <limits>
#include <utility>

namespace culm::coupling {

RemotePartner::~RemotePartner() = default;

template <class Talk>
auto RemotePartner::speak(const Window& window, Talk talk) {
  try {
    return talk();
  } catch (const PartnerError& error) {
    const std::string name = partner_.name.empty() ? "" : " '" + partner_.name + "'";
    throw PartnerError(fmt::format(
        "the partner{} at port '{}' failed in window {}, attempt {}, "
        "from {:g} s to {:g} s: {}",
        name, port_, window.number, window.attempt, window.start, window.end, error.what()));
  }
}

void RemotePartner::begin(const Beginning& beginning) {
  port_ = beginning.port;
  last_.number = beginning.window;
  last_.start = last_.end = beginning.time;
  speak(last_, [&] {
    conversation_.emplace(open_(), patience_, time_limit_);
    conversation_->pose(hello(beginning));
    const Frame frame = conversation_->listen();
    if (frame.kind != FrameKind::hello) {
      throw PartnerError(fmt::format("it began with '{}'", name_of(frame.kind)));
    }
    partner_ = read_introduction(frame);
    if (partner_.points != beginning.points()) {
      throw PartnerError(
          fmt::format("it has {} points, the port has {}", partner_.points, beginning.points()));
    }
    return 0;
  });
}

void RemotePartner::pose(const Window& window) {
  posed_ = motion(FrameKind::attempt, window, partner_.wanted);
  speak(window, [&] {
    conversation_->pose(*posed_);
    return 0;
  });
}

Eigen::VectorXd RemotePartner::loads(const Window& window) {
  if (!posed_) pose(window);
  const Frame question = std::move(*posed_);
  posed_.reset();
  return speak(window, [&] {
    return read_answer(conversation_->answer(question, FrameKind::answer), partner_.points);
  });
}

void RemotePartner::accept(const Window& window) {
  books_ = speak(window, [&] {
    return read_accepted(conversation_->ask(motion(FrameKind::accept, window, partner_.wanted),
                                            FrameKind::accepted));
  });
  last_ = window;
}

// It keeps what it is itself, under the number of the window that comes next.
void RemotePartner::save(const std::string& prefix, Snapshot& snapshot) {
  const Frame answer = speak(last_, [&] {
    const auto next = static_cast<std::uint32_t>(last_.number + 1);
    return conversation_->ask({FrameKind::save, next, 0, last_.end, last_.end}, FrameKind::saved);
  });
  if (!answer.payload.empty()) snapshot.set(prefix + kept_nothing, 1.0);
  snapshot.set(prefix + "books", {books_.energy, books_.dissipated});
}

// It was told in begin from which window on.
void RemotePartner::restore(const std::string& prefix, const Snapshot& snapshot) {
  const std::span<const double> books = snapshot.numbers(prefix + "books", 2);
  books_ = {books[0], books[1]};
  last_.number -= 1;
}

void RemotePartner::end(const std::string& why) {
  if (!conversation_) return;
  try {
    conversation_->say({why.empty() ? FrameKind::bye : FrameKind::error, 0, 0, 0.0, 0.0, why});
  } catch (const PartnerError&) {  // it has left before: nothing is lost
  }
  conversation_.reset();
}

void add_patience_fields(Schema& schema) {
  schema
      .add(number("Patience", "s", "How long it may be silent, and how long it may take to come.")
               .positive()
               .optional(600.0))
      .add(number("Time Limit", "s",
                  "How long it may take for an answer, though it says that it is alive; for ever "
                  "if absent.")
               .positive()
               .optional());
}

std::unique_ptr<Partner> make_remote_partner(const Options& options, RemotePartner::Open open) {
  const double time_limit = options.has("Time Limit") ? options.number("Time Limit")
                                                      : std::numeric_limits<double>::infinity();
  return std::make_unique<RemotePartner>(std::move(open), options.number("Patience"), time_limit);
}

}  // namespace culm::coupling
