#include <culm/coupling/channel_flow.hpp>

#include "mass_model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace culm::coupling {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

class ChannelFlow final : public MassModel {
 public:
  explicit ChannelFlow(const FlowChannel& channel) : channel_(channel) {}

  std::string objection(const VectorXd& reference) const override {
    const Eigen::Index n = reference.size() / 3;
    if (n < 2) return "needs two points at least";
    const Eigen::Map<const Eigen::Matrix3Xd> x(reference.data(), 3, n);
    const Eigen::Vector3d step = (x.col(n - 1) - x.col(0)) / static_cast<double>(n - 1);
    constexpr double straight = 1e-6;  // of a distance
    for (Eigen::Index i = 1; i < n; ++i) {
      const double off = (x.col(i) - x.col(0) - static_cast<double>(i) * step).norm();
      if (off <= straight * step.norm()) continue;
      return fmt::format(
          "needs points at equal distances on a straight line; point {} is {:.3g} m away from its "
          "place",
          i, off);
    }
    if (std::abs(step.dot(channel_.normal)) > straight * step.norm()) {
      return "needs a 'Normal' at right angles to the line of its points";
    }
    return {};
  }
  void begin(const VectorXd& reference, const VectorXd& velocity) override {
    const Eigen::Index n = reference.size() / 3;
    const double distance =
        (reference.tail<3>() - reference.head<3>()).norm() / static_cast<double>(n - 1);
    masses_ = channel_masses(channel_, static_cast<int>(n), distance);
    MassModel::begin(reference, velocity);
  }
  VectorXd forces(const VectorXd& moved, double h) const override {
    const VectorXd along = -2.0 / h * momentum(taken(moved) / h - velocity());
    return (channel_.normal * along.transpose()).reshaped();
  }

 private:
  VectorXd momentum(const VectorXd& velocity) const override { return masses_ * velocity; }
  VectorXd taken(const VectorXd& motion) const override {
    return motion.reshaped(3, motion.size() / 3).transpose() * channel_.normal;
  }

  FlowChannel channel_;
  MatrixXd masses_;
};

}  // namespace

MatrixXd channel_masses(const FlowChannel& channel, int points, double distance) {
  using std::numbers::pi;
  const double length = (points + 1) * distance;
  const double strip = channel.density * channel.width * distance;
  MatrixXd masses = MatrixXd::Zero(points, points);
  for (int i = 1; i <= points; ++i) {
    const double depth = i * pi * channel.height / length;
    const VectorXd sine =
        (VectorXd::LinSpaced(points, 1.0, points) * (i * pi / (points + 1))).array().sin() *
        std::sqrt(2.0 / (points + 1));
    masses += strip * length / (i * pi * std::tanh(depth)) * sine * sine.transpose();
  }
  return masses;
}

std::unique_ptr<PointModel> make_channel_flow(const FlowChannel& channel) {
  return std::make_unique<ChannelFlow>(channel);
}

}  // namespace culm::coupling
