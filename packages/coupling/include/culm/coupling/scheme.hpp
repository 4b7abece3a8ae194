/// How the loads of a step are found that a partner answers with themselves.
#pragma once

#include <culm/base/options.hpp>
#include <culm/base/schema.hpp>
#include <culm/base/snapshot.hpp>

#include <Eigen/Core>

#include <deque>
#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace culm::coupling {

/// Improves loads x from the answers H(x) of structure and partner to them, until H(x) = x. A
/// window is one step of the coupling, repeated until it fits.
class Scheme {
 public:
  virtual ~Scheme() = default;
  /// Whether windows are repeated at all.
  virtual bool is_implicit() const { return true; }
  /// Loads to try after x and the answer to it.
  virtual Eigen::VectorXd next(const Eigen::VectorXd& x, const Eigen::VectorXd& answer) = 0;
  /// The window is over: the next call belongs to another one.
  virtual void end_window() {}
  /// The window is given up: as if next had not been called in it.
  virtual void drop_window() {}
  /// Unknowns and answers are measured in other units from now on: each so many times what it was.
  virtual void rescale(const Eigen::VectorXd& factors) { (void)factors; }
  /// What it has learnt, between windows; under names that begin with "coupling/scheme".
  virtual void save(Snapshot&) const {}
  virtual void restore(const Snapshot&) {}
};

/// The answer acts in the next window, with no second try.
class Explicit final : public Scheme {
 public:
  bool is_implicit() const override { return false; }
  Eigen::VectorXd next(const Eigen::VectorXd&, const Eigen::VectorXd& answer) override {
    return answer;
  }
};

/// x + w (H(x) - x) with a constant w.
class ConstantRelaxation final : public Scheme {
 public:
  explicit ConstantRelaxation(double factor) : factor_(factor) {}
  Eigen::VectorXd next(const Eigen::VectorXd& x, const Eigen::VectorXd& answer) override {
    return x + factor_ * (answer - x);
  }

 private:
  double factor_;
};

/// The same with w <- -w r.Dr / Dr.Dr from the last two residuals r = H(x) - x, of size at most
/// one; a window begins with the last w of the one before.
/// @source Kuettler, Wall, Comput. Mech. 43 (2008) 61-72
class Aitken final : public Scheme {
 public:
  explicit Aitken(double first) : factor_(first) {}
  Eigen::VectorXd next(const Eigen::VectorXd& x, const Eigen::VectorXd& answer) override;
  void end_window() override { before_.resize(0); }
  void drop_window() override { before_.resize(0); }
  void rescale(const Eigen::VectorXd& factors) override;
  void save(Snapshot& snapshot) const override;
  void restore(const Snapshot& snapshot) override;

 private:
  double factor_;
  Eigen::VectorXd before_;  // residual; empty at the start of a window
};

/// Interface quasi-Newton with an inverse from least squares: of the differences V of residuals and
/// W of answers, newest first, x <- H(x) + W c with c = argmin |V c + r|. Differences of earlier
/// windows go on serving; a column of V that the newer ones span but for a share `filter` is left
/// out, and with it what rounding would make of it. Where residuals stop falling, the oldest window
/// is forgotten and one relaxed step is made.
/// @source Degroote, Bathe, Vierendeels, Comput. Struct. 87 (2009) 793-801
class QuasiNewton final : public Scheme {
 public:
  /// @param first  relaxation where nothing is known yet
  /// @param reuse  how many earlier windows serve on
  QuasiNewton(double first, int reuse, double filter)
      : first_(first), reuse_(reuse), filter_(filter) {}
  Eigen::VectorXd next(const Eigen::VectorXd& x, const Eigen::VectorXd& answer) override;
  void end_window() override;
  void drop_window() override;
  void rescale(const Eigen::VectorXd& factors) override;
  void save(Snapshot& snapshot) const override;
  void restore(const Snapshot& snapshot) override;

 private:
  bool has_stalled(double residual);
  struct Difference {
    Eigen::VectorXd residual, answer;
  };
  using Window = std::vector<Difference>;  // oldest first

  double first_;
  int reuse_;
  double filter_;
  std::deque<Window> windows_ = {Window()};                // the present one last
  Eigen::VectorXd residual_, answer_;                      // of the last call in this window
  double best_ = std::numeric_limits<double>::infinity();  // residual in this window
  int since_best_ = 0;                                     // attempts without a notable gain
};

/// Fields of the deck that say which scheme it is and how it works.
void add_scheme_fields(Schema& schema);
/// The scheme that they ask for.
std::unique_ptr<Scheme> make_scheme(const Options& options);

}  // namespace culm::coupling
