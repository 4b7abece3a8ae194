#include <culm/coupling/point_partner.hpp>
#include <culm/coupling/point_values.hpp>

#include "mass_model.hpp"

#include <algorithm>
#include <vector>

namespace culm::coupling {
namespace {

using Eigen::VectorXd;

VectorXd with_moments(const VectorXd& forces) {
  const Eigen::Index points = forces.size() / 3;
  Eigen::Matrix<double, 6, Eigen::Dynamic> all(6, points);
  all.topRows<3>() = forces.reshaped(3, points);
  all.bottomRows<3>().setZero();
  return all.reshaped();
}

class AddedMass final : public MassModel {
 public:
  explicit AddedMass(double mass) : mass_(mass) {}
  VectorXd forces(const VectorXd& moved, double h) const override {
    return -2.0 * mass_ / h * (moved / h - velocity());
  }

 private:
  VectorXd momentum(const VectorXd& velocity) const override { return mass_ * velocity; }
  double mass_;
};

class Dashpot final : public PointModel {
 public:
  explicit Dashpot(double damping) : damping_(damping) {}
  void begin(const VectorXd&, const VectorXd&) override {}
  VectorXd forces(const VectorXd& moved, double h) const override { return -damping_ / h * moved; }
  void accept(const VectorXd& moved, double h) override {
    dissipated_ += damping_ / h * moved.squaredNorm();
  }
  Books books() const override { return {0.0, dissipated_}; }
  VectorXd memory() const override { return VectorXd::Constant(1, dissipated_); }
  void restore(const VectorXd& memory) override { dissipated_ = memory[0]; }

 private:
  double damping_;
  double dissipated_ = 0.0;
};

// With the stretch s = u - x from the point to the mass, by the mid-point rule
//   Du = h (v + Dv / 2)      m Dv / h = -k (s + Ds / 2)      Ds = Du - Dx
// hence (1 + k h^2 / 4m) Du = h v - k h^2 / 2m (s - Dx / 2)
class Oscillator final : public PointModel {
 public:
  Oscillator(double mass, double stiffness) : mass_(mass), stiffness_(stiffness) {}
  void begin(const VectorXd&, const VectorXd& velocity) override {
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
  Books books() const override { return {total() - start_, 0.0}; }
  VectorXd memory() const override {
    VectorXd all(velocity_.size() + stretch_.size() + 1);
    all << start_, velocity_, stretch_;
    return all;
  }
  void restore(const VectorXd& memory) override {
    start_ = memory[0];
    velocity_ = memory.segment(1, (memory.size() - 1) / 2);
    stretch_ = memory.tail((memory.size() - 1) / 2);
  }

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

std::unique_ptr<PointModel> make_added_mass(double mass) {
  return std::make_unique<AddedMass>(mass);
}

std::unique_ptr<PointModel> make_dashpot(double damping) {
  return std::make_unique<Dashpot>(damping);
}

std::unique_ptr<PointModel> make_oscillator(double mass, double stiffness) {
  return std::make_unique<Oscillator>(mass, stiffness);
}

std::string PointPartner::objection(const std::vector<double>& reference) const {
  return model_->objection(as_vector(reference));
}

void PointPartner::begin(const Beginning& beginning) {
  model_->begin(as_vector(beginning.reference), translations(beginning.velocity));
}

VectorXd PointPartner::loads(const Window& window) {
  const VectorXd moved = translations(window.of(port::Quantity::motion)) / steps_;
  const double h = window.length() / steps_;
  if (steps_ == 1) return with_moments(model_->forces(moved, h));
  const VectorXd start = model_->memory();
  VectorXd sum = VectorXd::Zero(moved.size());
  VectorXd last;
  for (int i = 0; i < steps_; ++i) {
    last = model_->forces(moved, h);
    sum += last;
    model_->accept(moved, h);
  }
  model_->restore(start);
  return with_moments(load_ == WindowLoad::mean ? VectorXd(sum / steps_) : last);
}

void PointPartner::accept(const Window& window) {
  const VectorXd moved = translations(window.of(port::Quantity::motion)) / steps_;
  for (int i = 0; i < steps_; ++i) model_->accept(moved, window.length() / steps_);
}

void PointPartner::save(const std::string& prefix, Snapshot& snapshot) {
  const VectorXd memory = model_->memory();
  snapshot.set(prefix + "memory",
               std::span(memory.data(), static_cast<std::size_t>(memory.size())));
}

void PointPartner::restore(const std::string& prefix, const Snapshot& snapshot) {
  const std::span<const double> memory =
      snapshot.numbers(prefix + "memory", static_cast<std::size_t>(model_->memory().size()));
  model_->restore(as_vector(memory));
}

}  // namespace culm::coupling
