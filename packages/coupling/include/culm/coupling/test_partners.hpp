/// Partners that test how robust a structure and a coupling are.
#pragma once

#include <culm/coupling/partner.hpp>
#include <culm/coupling/point_partner.hpp>

#include <cstdint>
#include <string>

namespace culm::coupling {

/// Forces at random, equally distributed between -f and f in each direction; in each window others,
/// and the same for all of its attempts.
class RandomPartner final : public Partner {
 public:
  RandomPartner(double force, std::uint64_t seed) : force_(force), seed_(seed) {}
  void begin(const Beginning&) override {}
  Eigen::VectorXd loads(const Window& window) override;
  void accept(const Window& window) override;
  /// It holds nothing: what the structure gets, it lets go.
  Books books() const override { return {-given_, 0.0}; }
  void save(const std::string& prefix, Snapshot& snapshot) override;
  void restore(const std::string& prefix, const Snapshot& snapshot) override;

 private:
  double force_;
  std::uint64_t seed_;
  double given_ = 0.0;  // work on the structure [J]
};

/// What can go wrong in a window, from there on.
enum class Fault {
  death,            ///< PartnerError, as of a program that is gone
  no_number,        ///< an answer that is no number
  infinite,         ///< one that is infinite
  wrong_count,      ///< loads of one point less than there are
  scaled,           ///< half of the true forces
  turned,           ///< the opposite of the true forces
  old,              ///< the forces of the window before the first wrong one
  wrong_energy,     ///< books of an energy that nobody has seen
  infinite_energy,  ///< books that are infinite
  lost_books,       ///< no books any more
  slow              ///< right answers, a tenth of a second late
};

/// A mass at each point until something goes wrong with it. Wrong forces are what it answers; what
/// it books are the right ones.
class FaultyPartner final : public Partner {
 public:
  /// @param mass  [kg]; none: without loads
  FaultyPartner(Fault fault, int window, double mass);
  void begin(const Beginning& beginning) override;
  Eigen::VectorXd loads(const Window& window) override;
  void accept(const Window& window) override;
  Books books() const override;
  void save(const std::string& prefix, Snapshot& snapshot) override;
  void restore(const std::string& prefix, const Snapshot& snapshot) override;

 private:
  Fault fault_;
  int window_;
  std::string port_;
  PointPartner truth_;
  Eigen::VectorXd old_;  ///< forces of the last window that was right
  bool has_lied_ = false;
};

}  // namespace culm::coupling
