/// Partners that test how robust a structure and a coupling are.
#pragma once

#include <culm/coupling/partner.hpp>

#include <cstdint>

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
  death,        ///< PartnerError, as of a program that is gone
  no_number,    ///< an answer that is no number
  wrong_count,  ///< loads of one point less than there are
  wrong_energy  ///< books of an energy that nobody has seen
};

/// A partner without loads until something goes wrong with it.
class FaultyPartner final : public Partner {
 public:
  FaultyPartner(Fault fault, int window) : fault_(fault), window_(window) {}
  void begin(const Beginning& beginning) override { port_ = beginning.port; }
  Eigen::VectorXd loads(const Window& window) override;
  void accept(const Window& window) override;
  Books books() const override { return books_; }
  void save(const std::string&, Snapshot&) override {}
  void restore(const std::string&, const Snapshot&) override {}

 private:
  Fault fault_;
  int window_;
  std::string port_;
  Books books_;
};

}  // namespace culm::coupling
