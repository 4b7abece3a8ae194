/// A simulation at whose port preCICE sets loads: the C interface of culm with errors as
/// exceptions.
#pragma once

#include <culm.h>

#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace culm::adapter {

/// What ends the program, with its exit code.
class Failure : public std::runtime_error {
 public:
  Failure(const std::string& text, int exit_code)
      : std::runtime_error(text), exit_code_(exit_code) {}
  int exit_code() const { return exit_code_; }

 private:
  int exit_code_;
};

/// What went over a port.
struct Exchange {
  double work = 0.0;      ///< since the start [J]
  double force[3] = {};   ///< resultant in the last step [N]
  double moment[3] = {};  ///< about the origin in the last step [N m]
};

/// A deck's model at one of its ports. All verbs throw Failure with what culm says.
class Structure {
 public:
  /// Builds the model and takes up an analysis, the first one if the name is empty.
  Structure(const std::string& deck, const std::vector<std::string>& overrides,
            const std::string& analysis, std::string port);

  /// Places of the points in the reference, 3 each [m].
  const std::vector<double>& reference() const { return reference_; }
  /// How far the points are from there, 3 each [m].
  std::vector<double> displacement() const;
  double time() const;
  /// Where the next step should end.
  double proposal() const;
  bool is_at_end() const;

  /// Forces [N] and moments [N m], 3 numbers per point; no moments: none.
  void set_loads(const std::vector<double>& forces, const std::vector<double>& moments);
  /// Makes a step. Where it does not converge nothing has happened, the next proposal is nearer,
  /// and false is returned.
  bool advance(double target);
  const Exchange& exchange() const { return exchange_; }

  void save();
  void restore();
  void finish();
  /// What culm said since the last call.
  std::string messages() const { return culm_messages(simulation_.get()); }

 private:
  struct Close {
    void operator()(culm_simulation* simulation) const { culm_close(simulation); }
    void operator()(culm_snapshot* snapshot) const { culm_snapshot_free(snapshot); }
  };
  void check(int code) const;

  std::unique_ptr<culm_simulation, Close> simulation_;
  std::string port_;
  int points_ = 0;
  std::vector<double> reference_;
  Exchange exchange_;
  std::unique_ptr<culm_snapshot, Close> saved_;
  Exchange saved_exchange_;
};

}  // namespace culm::adapter
