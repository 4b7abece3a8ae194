/// Another program as a partner.
#pragma once

#include <culm/base/options.hpp>
#include <culm/base/schema.hpp>
#include <culm/coupling/conversation.hpp>
#include <culm/coupling/messages.hpp>
#include <culm/coupling/partner.hpp>

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>

namespace culm::coupling {

/// In a snapshot, after the prefix of a partner that has kept nothing of itself: it begins anew.
constexpr const char* kept_nothing = "kept nothing";

/// Speaks the wire format over a channel that is opened when the coupling begins.
class RemotePartner final : public Partner {
 public:
  using Open = std::function<std::unique_ptr<Channel>()>;
  /// @param patience  for each of its words [s]  @param time_limit  for each of its answers [s]
  RemotePartner(Open open, double patience, double time_limit)
      : open_(std::move(open)), patience_(patience), time_limit_(time_limit) {}
  ~RemotePartner() override;

  void begin(const Beginning& beginning) override;
  Quantities wanted() const override { return partner_.wanted | bit(port::Quantity::motion); }
  double latest_end(double start) const override { return start + partner_.longest_window; }
  void pose(const Window& window) override;
  Eigen::VectorXd loads(const Window& window) override;
  void accept(const Window& window) override;
  Books books() const override { return books_; }
  void save(const std::string& prefix, Snapshot& snapshot) override;
  void restore(const std::string& prefix, const Snapshot& snapshot) override;
  void end(const std::string& why) override;

 private:
  /// Speaks; what goes wrong is said with the name of the partner and what it was asked.
  template <class Talk>
  auto speak(const Window& window, Talk talk);

  Open open_;
  double patience_;
  double time_limit_;
  std::optional<Conversation> conversation_;
  std::string port_;
  Introduction partner_;
  Books books_;
  Window last_;                 ///< that was accepted
  std::optional<Frame> posed_;  ///< what it has been asked and has not answered yet
};

/// Fields of the deck that say how long it may be silent, and how long it may take.
void add_patience_fields(Schema& schema);
/// The partner that they describe.
std::unique_ptr<Partner> make_remote_partner(const Options& options, RemotePartner::Open open);

}  // namespace culm::coupling
