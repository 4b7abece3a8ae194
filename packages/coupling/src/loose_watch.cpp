#include <culm/coupling/loose_watch.hpp>

#include <fmt/format.h>

namespace culm::coupling {
namespace {

constexpr double notable_growth = 2.0;  // of changes, from probe to probe
constexpr int most_probes = 20;
constexpr double risky = 0.5;  // share of the limit
constexpr int many_flips = 10;

}  // namespace

void LooseWatch::add(const Eigen::VectorXd& answer, const Eigen::VectorXd& acceleration) {
  if (windows_ > 0) {
    change_ = answer - answer_;
    const Eigen::VectorXd faster = acceleration - acceleration_;
    change_by_acceleration_ = change_.dot(faster);
    acceleration_square_ = faster.squaredNorm();
    if (answer.dot(answer_) < 0.0) {
      if (flips_ == 0) first_flip_ = answer_.norm();
      ++flips_;
    } else {
      flips_ = 0;
    }
  }
  answer_ = answer;
  acceleration_ = acceleration;
  ++windows_;
}

Eigen::VectorXd LooseWatch::probe() const {
  const bool has_grown = change_.size() > 0 && change_.norm() > notable_growth * probed_;
  return has_grown && probes_ < most_probes ? change_ : Eigen::VectorXd();
}

void LooseWatch::measure(const Eigen::VectorXd& load, const Eigen::VectorXd& acceleration) {
  ++probes_;
  probed_ = load.norm();
  const double power = load.dot(acceleration);
  if (power > 0.0) structure_ = load.squaredNorm() / power;
}

std::string LooseWatch::warning() {
  // of the change that the structure was probed with, the last one
  if (structure_ > 0.0 && acceleration_square_ > 0.0 && !has_foreseen_) {
    const double partner = -change_by_acceleration_ / acceleration_square_;
    if (partner > risky * structure_) {
      has_foreseen_ = true;
      return fmt::format(
          "it answers like a mass of {:.3g} kg at each point, {:.2g} times that of the structure "
          "there: loads that are exchanged once per window grow above about 1, whatever the "
          "window; take a 'Scheme' that repeats windows",
          partner, partner / structure_);
    }
  }
  if (flips_ >= many_flips && answer_.norm() > first_flip_ && !has_seen_) {
    has_seen_ = true;
    return fmt::format(
        "its loads have changed their sign in each of the last {} windows, and grow: loads that "
        "are exchanged once per window do so before a coupling dies; take a 'Scheme' that repeats "
        "windows",
        flips_);
  }
  return {};
}

}  // namespace culm::coupling
