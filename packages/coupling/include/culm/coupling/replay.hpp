/// Couplings heard again: one side from a record, the other one as it is now.
#pragma once

#include <culm/coupling/record.hpp>

#include <limits>
#include <string>
#include <vector>

namespace culm::coupling {

/// Up to where a replay counts as the same, over the size of what is compared.
constexpr double replay_rounding = 1e-10;

/// Gives the loads of a record again, whatever the structure does, and compares how it moves: at
/// the ends of windows, and of the steps in them where it makes steps that end there. The structure
/// may take several windows for a recorded one: the same loads act in all of them, and their
/// motions add up.
class ReplayedPartner final : public Partner {
 public:
  /// @param file  for messages
  ReplayedPartner(Record record, std::string file)
      : record_(std::move(record)), file_(std::move(file)) {}

  void begin(const Beginning& beginning) override;
  double latest_end(double start) const override;
  Eigen::VectorXd loads(const Window& window) override;
  void accept(const Window& window) override;
  Books books() const override;
  void save(const std::string&, Snapshot&) override {}
  void restore(const std::string&, const Snapshot&) override {}
  /// Where the structure moves differently by more than rounding.
  std::string complaint() const override;
  /// What is not compared, because the motion ends before.
  std::string left_over() const override;

 private:
  void add_step(double end, const std::vector<double>& motion);
  void compare(const std::vector<double>& then, const std::vector<double>& now);

  Record record_;
  std::string file_;
  std::size_t next_ = 0;       ///< window of the record, perhaps begun already
  std::vector<double> moved_;  ///< in it so far; empty if it has not begun
  double reached_ = 0.0;       ///< how far it has come, if it has begun [s]
  double worst_ = 0.0;         ///< difference of a motion, over the largest in its window
  int worst_window_ = 0;
};

/// What a partner answers now to what a record says that it was asked.
struct PartnerReplay {
  int windows = 0;
  int attempts = 0;
  int equal = 0;       ///< attempts that it answered with the same bits
  double loads = 0.0;  ///< largest difference of an answer, over the size of that answer
  int window = 0;      ///< where that was
  int attempt = 0;
  double energy = 0.0;  ///< largest difference of its books, over their largest numbers
};

/// Asks a partner all that a record says, attempt by attempt. Throws PartnerError where it fails or
/// has other points, or wants quantities that the record does not have.
PartnerReplay replay(const Record& record, Partner& partner);

}  // namespace culm::coupling
