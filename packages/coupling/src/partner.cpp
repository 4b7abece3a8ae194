#include <culm/coupling/partner.hpp>

namespace culm::coupling {
namespace {

using Eigen::VectorXd;

class AddedMass final : public Partner {
 public:
  explicit AddedMass(double mass) : mass_(mass) {}
  void begin(const VectorXd& velocity) override {
    velocity_ = velocity;
    start_ = kinetic();
  }
  VectorXd forces(const VectorXd& moved, double h) const override {
    return -2.0 * mass_ / h * (moved / h - velocity_);
  }
  void accept(const VectorXd& moved, double h) override { velocity_ = 2.0 / h * moved - velocity_; }
  double energy() const override { return kinetic() - start_; }
  double stiffness(double h) const override { return 2.0 * mass_ / (h * h); }

 private:
  double kinetic() const { return 0.5 * mass_ * velocity_.squaredNorm(); }
  double mass_;
  VectorXd velocity_;
  double start_ = 0.0;
};

class Dashpot final : public Partner {
 public:
  explicit Dashpot(double damping) : damping_(damping) {}
  void begin(const VectorXd&) override {}
  VectorXd forces(const VectorXd& moved, double h) const override { return -damping_ / h * moved; }
  void accept(const VectorXd& moved, double h) override {
    dissipated_ += damping_ / h * moved.squaredNorm();
  }
  double energy() const override { return 0.0; }
  double dissipated() const override { return dissipated_; }
  double stiffness(double h) const override { return damping_ / h; }

 private:
  double damping_;
  double dissipated_ = 0.0;
};

// With the stretch s = u - x from the point to the mass, by the mid-point rule
//   Du = h (v + Dv / 2)      m Dv / h = -k (s + Ds / 2)      Ds = Du - Dx
// hence (1 + k h^2 / 4m) Du = h v - k h^2 / 2m (s - Dx / 2)
class Oscillator final : public Partner {
 public:
  Oscillator(double mass, double stiffness) : mass_(mass), stiffness_(stiffness) {}
  void begin(const VectorXd& velocity) override {
    velocity_ = velocity;  // it moves with its point
    stretch_ = VectorXd::Zero(velocity.size());
    start_ = total();
  }
  VectorXd forces(const VectorXd& moved, double h) const override {
    return stiffness_ * (stretch_ + 0.5 * (step(moved, h) - moved));
  }
  void accept(const VectorXd& moved, double h) override {
    const VectorXd own = step(moved, h);
    velocity_ = 2.0 / h * own - velocity_;
    stretch_ += own - moved;
  }
  double energy() const override { return total() - start_; }
  double stiffness(double) const override { return stiffness_; }

 private:
  VectorXd step(const VectorXd& moved, double h) const {
    const double ratio = stiffness_ * h * h / mass_;
    return (h * velocity_ - 0.5 * ratio * (stretch_ - 0.5 * moved)) / (1.0 + 0.25 * ratio);
  }
  double total() const {
    return 0.5 * mass_ * velocity_.squaredNorm() + 0.5 * stiffness_ * stretch_.squaredNorm();
  }
  double mass_, stiffness_;
  VectorXd velocity_, stretch_;
  double start_ = 0.0;
};

}  // namespace

std::unique_ptr<Partner> make_added_mass(double mass) { return std::make_unique<AddedMass>(mass); }

std::unique_ptr<Partner> make_dashpot(double damping) { return std::make_unique<Dashpot>(damping); }

std::unique_ptr<Partner> make_oscillator(double mass, double stiffness) {
  return std::make_unique<Oscillator>(mass, stiffness);
}

std::vector<std::string> partner_names() { return {"added-mass", "dashpot", "oscillator"}; }

std::unique_ptr<Partner> find_partner(const std::string& name, const PartnerNumbers& numbers) {
  if (name == "added-mass") return make_added_mass(numbers.mass);
  if (name == "dashpot") return make_dashpot(numbers.damping);
  if (name == "oscillator") return make_oscillator(numbers.mass, numbers.stiffness);
  return nullptr;
}

}  // namespace culm::coupling
