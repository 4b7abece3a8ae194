/// Where frames go to and come from.
#pragma once

#include <memory>
#include <string>

namespace culm::coupling {

/// A way to another program that carries whole frames, in order. Throws PartnerError where the
/// other side is gone. One thread may receive while another one sends.
class Channel {
 public:
  virtual ~Channel() = default;
  virtual void send(const std::string& frame) = 0;
  /// Throws PartnerError where nothing comes for so long [s].
  virtual std::string receive(double patience) = 0;
  /// Whether signs of life may be sent beside, from a thread of their own.
  virtual bool wants_signs_of_life() const { return true; }
};

/// Why a text is no address; empty if it is one.
std::string objection_to_address(const std::string& text);

/// Waits at an address until another program comes. Throws PartnerError if none comes for so long
/// [s], UsageError for what is no address, FileError where it is taken.
/// @param address  'unix:PATH', or 'tcp:PORT' for this machine, or 'tcp:ADDRESS:PORT' for all that
///                 see it
std::unique_ptr<Channel> listen(const std::string& address, double patience);
/// Goes to a program that listens, which may take so long to begin [s]. Throws as listen.
std::unique_ptr<Channel> connect(const std::string& address, double patience);

}  // namespace culm::coupling
