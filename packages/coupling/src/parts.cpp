#include <culm/coupling/parts.hpp>

#include <cmath>
#include <span>

namespace culm::coupling {

using Eigen::VectorXd;

namespace {

VectorXd join(const std::vector<VectorXd>& parts, const std::vector<double>& scales) {
  Eigen::Index size = 0;
  for (const VectorXd& part : parts) size += part.size();
  VectorXd all(size);
  Eigen::Index first = 0;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    all.segment(first, parts[i].size()) = scales[i] * parts[i];
    first += parts[i].size();
  }
  return all;
}

}  // namespace

void PartScale::learn(const std::vector<VectorXd>& tried, const std::vector<VectorXd>& answer) {
  squares_.resize(tried.size(), 0.0);
  scales_.resize(tried.size(), 1.0);
  for (std::size_t i = 0; i < tried.size(); ++i) {
    if (!tried_.empty()) {
      squares_[i] += (tried[i] - tried_[i]).norm() * (answer[i] - answer_[i]).norm();
    }
    const double residual = (answer[i] - tried[i]).norm();
    if (squares_[i] > 0.0) {
      scales_[i] = 1.0 / std::sqrt(squares_[i]);
    } else if (residual > 0.0) {
      scales_[i] = 1.0 / residual;  // for want of changes
    }
  }
  tried_ = tried;
  answer_ = answer;
}

std::vector<VectorXd> PartScale::next(Scheme& scheme, const std::vector<VectorXd>& tried,
                                      const std::vector<VectorXd>& answer) {
  std::vector<double> factors = scales_;
  factors.resize(tried.size(), 1.0);
  learn(tried, answer);
  std::vector<VectorXd> ones;
  for (std::size_t i = 0; i < tried.size(); ++i) {
    ones.emplace_back(VectorXd::Ones(tried[i].size()));
    factors[i] = scales_[i] / factors[i];
  }
  scheme.rescale(join(ones, factors));
  const VectorXd all = scheme.next(join(tried, scales_), join(answer, scales_));
  std::vector<VectorXd> next;
  Eigen::Index first = 0;
  for (std::size_t i = 0; i < tried.size(); ++i) {
    next.emplace_back(all.segment(first, tried[i].size()) / scales_[i]);
    first += tried[i].size();
  }
  return next;
}

void PartScale::end_window() {
  tried_.clear();
  answer_.clear();
}

void PartScale::save(Snapshot& snapshot) const {
  snapshot.set("coupling/scale/squares", squares_);
  snapshot.set("coupling/scale/scales", scales_);
}

void PartScale::restore(const Snapshot& snapshot) {
  const std::span<const double> squares = snapshot.numbers("coupling/scale/squares");
  const std::span<const double> scales = snapshot.numbers("coupling/scale/scales");
  squares_.assign(squares.begin(), squares.end());
  scales_.assign(scales.begin(), scales.end());
}

}  // namespace culm::coupling
