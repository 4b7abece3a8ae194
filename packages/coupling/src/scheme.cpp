#include <culm/coupling/scheme.hpp>

#include <algorithm>
#include <numeric>
#include <utility>

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

void Aitken::rescale(const VectorXd& factors) {
  if (before_.size() > 0) before_.array() *= factors.array();
}

void Aitken::save(Snapshot& snapshot) const { snapshot.set("coupling/scheme/factor", factor_); }

void Aitken::restore(const Snapshot& snapshot) {
  factor_ = snapshot.number("coupling/scheme/factor");
}

VectorXd QuasiNewton::next(const VectorXd& x, const VectorXd& answer) {
  const VectorXd residual = answer - x;
  if (residual_.size() > 0) {
    windows_.back().push_back({residual - residual_, answer - answer_});
  }
  residual_ = residual;
  answer_ = answer;
  if (has_stalled(residual.norm())) {
    if (windows_.size() > 1) windows_.pop_front();
    return x + first_ * residual;
  }

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

bool QuasiNewton::has_stalled(double residual) {
  constexpr double notable = 0.9;
  constexpr int patience = 5;
  if (residual < notable * best_) {
    best_ = residual;
    since_best_ = 0;
    return false;
  }
  if (++since_best_ < patience) return false;
  since_best_ = 0;
  return true;
}

void QuasiNewton::end_window() {
  residual_.resize(0);
  answer_.resize(0);
  best_ = std::numeric_limits<double>::infinity();
  since_best_ = 0;
  if (windows_.back().empty()) return;  // it fitted at once and taught nothing
  windows_.emplace_back();
  while (static_cast<int>(windows_.size()) > reuse_ + 1) windows_.pop_front();
}

void QuasiNewton::drop_window() {
  windows_.back().clear();
  end_window();
}

void QuasiNewton::rescale(const VectorXd& factors) {
  const auto scale = [&](VectorXd& v) {
    if (v.size() > 0) v.array() *= factors.array();
  };
  for (Window& window : windows_) {
    for (Difference& one : window) {
      scale(one.residual);
      scale(one.answer);
    }
  }
  scale(residual_);
  scale(answer_);
}

void QuasiNewton::save(Snapshot& snapshot) const {
  std::vector<double> counts, numbers;
  for (const Window& window : windows_) {
    counts.push_back(static_cast<double>(window.size()));
    for (const Difference& one : window) {
      numbers.insert(numbers.end(), one.residual.begin(), one.residual.end());
      numbers.insert(numbers.end(), one.answer.begin(), one.answer.end());
    }
  }
  snapshot.set("coupling/scheme/windows", std::move(counts));
  snapshot.set("coupling/scheme/differences", std::move(numbers));
}

void QuasiNewton::restore(const Snapshot& snapshot) {
  const std::span<const double> counts = snapshot.numbers("coupling/scheme/windows");
  const std::span<const double> numbers = snapshot.numbers("coupling/scheme/differences");
  const double columns = 2.0 * std::accumulate(counts.begin(), counts.end(), 0.0);
  const auto size =
      columns > 0.0 ? static_cast<Eigen::Index>(static_cast<double>(numbers.size()) / columns) : 0;
  const double* at = numbers.data();
  windows_.clear();
  for (const double count : counts) {
    windows_.emplace_back();
    for (int i = 0; i < static_cast<int>(count); ++i, at += 2 * size) {
      windows_.back().push_back(
          {Eigen::Map<const VectorXd>(at, size), Eigen::Map<const VectorXd>(at + size, size)});
    }
  }
  if (windows_.empty()) windows_.emplace_back();
}

void add_scheme_fields(Schema& schema) {
  schema
      .add(choice("Scheme", {"Quasi Newton", "Aitken", "Constant", "Explicit", "One Way"},
                  "How loads are found that fit the motion: the first three repeat each window "
                  "until they do; Explicit takes the answer to the window before; One Way takes "
                  "the answer to points that stand still.")
               .optional("Quasi Newton"))
      .add(flag("Parallel",
                "Structure and partners work at the same time, each on a guess of what the other "
                "does, and loads and motion are found together; else partners answer the motion "
                "that the structure has made.")
               .optional(false))
      .add(number("Relaxation", "1",
                  "How much of a first answer is believed: by Constant always, by Aitken and Quasi "
                  "Newton until they know better.")
               .positive()
               .optional(0.1))
      .add(integer("Reuse", "Windows from which Quasi Newton goes on learning.")
               .at_least(0)
               .optional(8))
      .add(number("Filter", "1",
                  "What Quasi Newton leaves out: attempts that show less than this share of "
                  "anything new.")
               .between(0.0, 1.0)
               .optional(1e-2))
      .check([](const Options& o, InputIssues& issues) {
        if (!o.flag("Parallel") || o.text("Scheme") != "One Way") return;
        issues.add(o.where("Parallel"), "has no meaning where partners do not see the motion");
      });
}

std::unique_ptr<Scheme> make_scheme(const Options& options) {
  const std::string& name = options.text("Scheme");
  const double relaxation = options.number("Relaxation");
  if (name == "Aitken") return std::make_unique<Aitken>(relaxation);
  if (name == "Constant") return std::make_unique<ConstantRelaxation>(relaxation);
  if (name == "Quasi Newton") {
    return std::make_unique<QuasiNewton>(relaxation, options.integer("Reuse"),
                                         options.number("Filter"));
  }
  return std::make_unique<Explicit>();  // what is one way, too, is the caller's to know
}

}  // namespace culm::coupling
