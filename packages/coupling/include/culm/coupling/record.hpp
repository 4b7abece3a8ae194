/// Couplings in files: what was said.
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
/// both hellos, attempts, answers, and the windows that were accepted, with the steps of the
/// structure in them and what the partner says of its energy. What was written before a kill can be
/// read.
class RecordedPartner final : public Partner {
 public:
  RecordedPartner(std::unique_ptr<Partner> partner, std::filesystem::path file)
      : partner_(std::move(partner)), file_(std::move(file)) {}

  void begin(const Beginning& beginning) override;
  Quantities wanted() const override { return partner_->wanted(); }
  double latest_end(double start) const override { return partner_->latest_end(start); }
  void pose(const Window& window) override;
  Eigen::VectorXd loads(const Window& window) override;
  void accept(const Window& window) override;
  Books books() const override { return partner_->books(); }
  void save(const std::string& prefix, Snapshot& snapshot) override;
  void restore(const std::string& prefix, const Snapshot& snapshot) override;
  void end(const std::string& why) override { partner_->end(why); }
  std::string complaint() const override { return partner_->complaint(); }
  std::string left_over() const override { return partner_->left_over(); }

 private:
  void write(const Frame& frame);

  std::unique_ptr<Partner> partner_;
  std::filesystem::path file_;
  std::ofstream stream_;
  bool is_posed_ = false;  ///< the question is written
};

/// What a partner was asked, and what it answered.
struct RecordedAttempt {
  Window asked;
  Eigen::VectorXd answer;
};

/// A window that was accepted, with what led to it.
struct RecordedWindow {
  std::vector<RecordedAttempt> attempts;
  Window accepted;  ///< with the steps of the structure, where it made several
  Books books;      ///< of the partner after it
};

/// A whole record. Its end may be missing.
struct Record {
  Beginning beginning;
  Introduction partner;
  std::vector<RecordedWindow> windows;
};
/// Throws FileError for what is no record.
Record read_record(const std::filesystem::path& file);

}  // namespace culm::coupling
