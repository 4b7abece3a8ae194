/// Couplings in files: what was said, and how to hear it again.
#pragma once

#include <culm/coupling/messages.hpp>
#include <culm/coupling/partner.hpp>

#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

namespace culm::coupling {

/// Writes all that goes between culm and a partner into a file, frame after frame as on a wire:
/// both hellos, attempts, answers, and the windows that were accepted with what the partner says of
/// its energy. What was written before a kill can be read.
class RecordedPartner final : public Partner {
 public:
  RecordedPartner(std::unique_ptr<Partner> partner, std::filesystem::path file)
      : partner_(std::move(partner)), file_(std::move(file)) {}

  void begin(const Beginning& beginning) override;
  Quantities wanted() const override { return partner_->wanted(); }
  double latest_end(double start) const override { return partner_->latest_end(start); }
  Eigen::VectorXd loads(const Window& window) override;
  void accept(const Window& window) override;
  Books books() const override { return partner_->books(); }
  void save(const std::string& prefix, Snapshot& snapshot) override;
  void restore(const std::string& prefix, const Snapshot& snapshot) override;
  void end(const std::string& why) override { partner_->end(why); }
  std::string complaint() const override { return partner_->complaint(); }

 private:
  void write(const Frame& frame);

  std::unique_ptr<Partner> partner_;
  std::filesystem::path file_;
  std::ofstream stream_;
};

/// A whole record; attempts that were not accepted are left out. Its end may be missing.
struct Record {
  Beginning beginning;
  Introduction partner;
  std::vector<Window> windows;
};
/// Throws FileError for what is no record.
Record read_record(const std::filesystem::path& file);

/// Gives the loads of a record again, whatever the structure does, and compares how it moves. The
/// structure may take several windows for a recorded one: the same loads act in all of them, and
/// their motions add up.
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
  Record record_;
  std::string file_;
  std::size_t next_ = 0;       ///< window of the record, perhaps begun already
  std::vector<double> moved_;  ///< in it so far; empty if it has not begun
  double reached_ = 0.0;       ///< how far it has come, if it has begun [s]
  double worst_ = 0.0;         ///< difference of a motion, over the largest in its window
  int worst_window_ = 0;
};

}  // namespace culm::coupling
