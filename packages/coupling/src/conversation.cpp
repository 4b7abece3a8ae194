#include <culm/coupling/conversation.hpp>
#include <culm/coupling/partner_error.hpp>

#include <fmt/format.h>

#include <chrono>
#include <utility>

namespace culm::coupling {

Conversation::Conversation(std::unique_ptr<Channel> channel, double patience, double time_limit)
    : channel_(std::move(channel)), patience_(patience), time_limit_(time_limit) {
  if (channel_->wants_signs_of_life()) heart_ = std::thread([this] { beat(); });
}

Conversation::~Conversation() {
  {
    const std::lock_guard lock(ending_);
    ends_ = true;
  }
  ended_.notify_all();
  if (heart_.joinable()) heart_.join();
}

void Conversation::beat() {
  constexpr auto interval = std::chrono::seconds(1);
  std::unique_lock lock(ending_);
  while (!ended_.wait_for(lock, interval, [this] { return ends_; })) {
    if (listens_) continue;
    try {
      say({FrameKind::alive});
    } catch (const PartnerError&) {
      return;  // the next question finds that out, too
    }
  }
}

void Conversation::say(const Frame& frame) {
  const std::string bytes = encode(frame);
  const std::lock_guard lock(sending_);
  channel_->send(bytes);
}

Frame Conversation::hear() {
  listens_ = true;
  const auto start = std::chrono::steady_clock::now();
  Frame frame = decode(channel_->receive(patience_));
  while (frame.kind == FrameKind::alive) {
    const std::chrono::duration<double> waited = std::chrono::steady_clock::now() - start;
    if (waited.count() > time_limit_) {
      throw PartnerError(
          fmt::format("it says that it is alive, and has not answered for {:g} s", time_limit_));
    }
    channel_->heed_signal(waited.count());
    frame = decode(channel_->receive(patience_));
  }
  listens_ = false;
  return frame;
}

Frame Conversation::listen() {
  Frame frame = hear();
  if (frame.kind == FrameKind::error || frame.kind == FrameKind::bye) {
    throw PartnerError(frame.payload.empty() ? "it said good-bye" : "it says: " + frame.payload);
  }
  return frame;
}

void Conversation::pose(const Frame& question) {
  try {
    say(question);
  } catch (const PartnerError&) {
    listen();  // its last word may say why it is gone
    throw;
  }
}

Frame Conversation::answer(const Frame& question, FrameKind expected) {
  channel_->heed_signals(question.kind != FrameKind::save);
  Frame frame = listen();
  if (frame.kind != expected) {
    throw PartnerError(fmt::format("it answered '{}' with '{}' instead of '{}'",
                                   name_of(question.kind), name_of(frame.kind), name_of(expected)));
  }
  if (frame.window != question.window || frame.attempt != question.attempt) {
    throw PartnerError(
        fmt::format("it answered for window {}, attempt {}, and was asked for "
                    "window {}, attempt {}",
                    frame.window, frame.attempt, question.window, question.attempt));
  }
  return frame;
}

Frame Conversation::ask(const Frame& question, FrameKind expected) {
  pose(question);
  return answer(question, expected);
}

}  // namespace culm::coupling
