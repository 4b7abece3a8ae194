/// Questions and answers over a channel.
#pragma once

#include <culm/coupling/channel.hpp>
#include <culm/coupling/frame.hpp>

#include <atomic>
#include <condition_variable>
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
  Conversation(std::unique_ptr<Channel> channel, double patience);
  ~Conversation();
  Conversation(const Conversation&) = delete;
  Conversation& operator=(const Conversation&) = delete;

  void say(const Frame& frame);
  /// The next word that is more than a sign of life.
  Frame listen();
  /// The answer to a question: of this kind, and about the same window and attempt.
  Frame ask(const Frame& question, FrameKind expected);

 private:
  void beat();

  std::unique_ptr<Channel> channel_;
  double patience_;
  std::mutex sending_;
  std::atomic<bool> listens_ = false;
  std::mutex ending_;
  std::condition_variable ended_;
  bool ends_ = false;
  std::thread heart_;
};

}  // namespace culm::coupling
