/// Where frames go to and come from.
#pragma once

#include <memory>
#include <string>

namespace culm::coupling {

/// A way to another program that carries whole frames, in order. Throws PartnerError where the
/// other side is gone, Stopped where this process is asked to end while it waits for it. One thread
/// may receive while another one sends.
class Channel {
 public:
  virtual ~Channel() = default;
  virtual void send(const std::string& frame) = 0;
  /// Throws PartnerError where nothing comes for so long [s].
  virtual std::string receive(double patience) = 0;
  /// Whether signs of life may be sent beside, from a thread of their own.
  virtual bool wants_signs_of_life() const { return true; }

  /// Whether SIGTERM ends the wait for a frame, as it does at first: what the other side saves for
  /// a checkpoint is worth waiting for.
  void heed_signals(bool heeds) { heeds_signals_ = heeds; }
  /// Throws Stopped some seconds after SIGTERM, which are left to an answer, so that the window
  /// can be ended and a checkpoint written. @param waited  for this frame [s]
  void heed_signal(double waited) const;

 private:
  bool heeds_signals_ = true;
};

/// Why a text is no address; empty if it is one.
std::string objection_to_address(const std::string& text);

/// An address with the machine that 'tcp:PORT' means, and without detours in the path of a socket:
/// the same text for the same place. @param text  to which nothing objects
std::string complete_address(const std::string& text);

/// Waits at an address until another program comes. Throws PartnerError if none comes for so long
/// [s], Stopped if this process is asked to end before, UsageError for what is no address,
/// FileError where it is taken.
/// @param address  'unix:PATH', or 'tcp:PORT' for this machine, or 'tcp:ADDRESS:PORT' for all that
///                 see it
std::unique_ptr<Channel> listen(const std::string& address, double patience);
/// Goes to a program that listens, which may take so long to begin [s]. Throws as listen.
std::unique_ptr<Channel> connect(const std::string& address, double patience);

}  // namespace culm::coupling
