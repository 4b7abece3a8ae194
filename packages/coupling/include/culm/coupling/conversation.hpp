/// Questions and answers over a channel.
#pragma once

#include <culm/coupling/channel.hpp>
#include <culm/coupling/frame.hpp>

#include <atomic>
#include <condition_variable>
#include <limits>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

namespace culm::coupling {

/// Speaks with another program, and says every second that it is still there while the other side
/// waits. Throws PartnerError where the other side leaves, is silent for too long, or answers
/// something else than it was asked.
class Conversation {
 public:
  /// @param patience  for each word of the other side [s]
  /// @param time_limit  for an answer, however often the other side says that it is alive [s]
  Conversation(std::unique_ptr<Channel> channel, double patience,
               double time_limit = std::numeric_limits<double>::infinity());
  ~Conversation();
  Conversation(const Conversation&) = delete;
  Conversation& operator=(const Conversation&) = delete;

  void say(const Frame& frame);
  /// The next word that is more than a sign of life.
  Frame hear();
  /// The same; throws PartnerError where it is the last one.
  Frame listen();
  /// Says a question; throws with the last word of the other side where it is gone.
  void pose(const Frame& question);
  /// The answer to it: of this kind, and about the same window and attempt.
  Frame answer(const Frame& question, FrameKind expected);
  /// Both.
  Frame ask(const Frame& question, FrameKind expected);

 private:
  void beat();

  std::unique_ptr<Channel> channel_;
  double patience_;
  double time_limit_;
  std::mutex sending_;
  std::atomic<bool> listens_ = false;
  std::mutex ending_;
  std::condition_variable ended_;
  bool ends_ = false;
  std::thread heart_;
};

}  // namespace culm::coupling
