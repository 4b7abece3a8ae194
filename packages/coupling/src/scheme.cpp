#include <culm/coupling/scheme.hpp>

#include <algorithm>

namespace culm::coupling {

using Eigen::VectorXd;

VectorXd Aitken::next(const VectorXd& x, const VectorXd& answer) {
  const VectorXd residual = answer - x;
  if (before_.size() > 0) {
    const VectorXd change = residual - before_;
    const double square = change.squaredNorm();
    if (square > 0.0) factor_ = std::clamp(-factor_ * before_.dot(change) / square, -1.0, 1.0);
  }
  before_ = residual;
  return x + factor_ * residual;
}

VectorXd QuasiNewton::next(const VectorXd& x, const VectorXd& answer) {
  const VectorXd residual = answer - x;
  if (residual_.size() > 0) {
    windows_.back().push_back({residual - residual_, answer - answer_});
  }
  residual_ = residual;
  answer_ = answer;

  // modified Gram-Schmidt on the columns of V, newest first; W along with it
  std::vector<Difference> basis;  // residuals orthonormal
  for (auto window = windows_.rbegin(); window != windows_.rend(); ++window) {
    for (auto column = window->rbegin(); column != window->rend(); ++column) {
      if (static_cast<Eigen::Index>(basis.size()) == x.size()) break;
      Difference left = *column;
      const double size = left.residual.norm();
      for (const Difference& b : basis) {
        const double share = b.residual.dot(left.residual);
        left.residual -= share * b.residual;
        left.answer -= share * b.answer;
      }
      const double rest = left.residual.norm();
      if (!(rest > filter_ * size)) continue;  // zero columns as well
      basis.push_back({left.residual / rest, left.answer / rest});
    }
  }
  if (basis.empty()) return x + first_ * residual;
  VectorXd next = answer;
  for (const Difference& b : basis) next -= b.residual.dot(residual) * b.answer;
  return next;
}

void QuasiNewton::end_window() {
  residual_.resize(0);
  answer_.resize(0);
  if (windows_.back().empty()) return;  // it fitted at once and taught nothing
  windows_.emplace_back();
  while (static_cast<int>(windows_.size()) > reuse_ + 1) windows_.pop_front();
}

std::vector<std::string> scheme_names() {
  return {"explicit", "constant", "aitken", "quasi-newton"};
}

std::unique_ptr<Scheme> find_scheme(const std::string& name, double relaxation) {
  constexpr int reuse = 8;
  constexpr double filter = 1e-2;
  if (name == "explicit") return std::make_unique<Explicit>();
  if (name == "constant") return std::make_unique<ConstantRelaxation>(relaxation);
  if (name == "aitken") return std::make_unique<Aitken>(relaxation);
  if (name == "quasi-newton") return std::make_unique<QuasiNewton>(relaxation, reuse, filter);
  return nullptr;
}

}  // namespace culm::coupling
