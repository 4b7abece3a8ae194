#include "link_forms.hpp"

#include <cmath>
#include <limits>

namespace culm::load {
namespace {

Vec3 sum(const Vec3& constant, const model::SlotSum& factors, const LinkSlots& q) {
  Vec3 result = constant;
  for (std::size_t s = 0; s < factors.size(); ++s) {
    result += factors[s] * q.col(static_cast<Eigen::Index>(s));
  }
  return result;
}

// What a sum is made of.
double size_of_terms(const Vec3& constant, const model::SlotSum& factors, const LinkSlots& q) {
  double size = constant.norm();
  for (std::size_t s = 0; s < factors.size(); ++s) {
    size += std::abs(factors[s]) * q.col(static_cast<Eigen::Index>(s)).norm();
  }
  return size;
}

// Points that coincide but for rounding have no distance: what rounding leaves has a direction that
// means nothing.
bool is_rounding(const LinkForm& form, const LinkSlots& q) {
  constexpr double roundings = 4.0 * std::numeric_limits<double>::epsilon();
  return sum(form.p, form.alpha, q).norm() <= roundings * size_of_terms(form.p, form.alpha, q);
}

double factor(const model::SlotSum& factors, std::size_t s) {
  return factors.empty() ? 0.0 : factors[s];
}

}  // namespace

Vec<2> values_of(const Link& link, const LinkSlots& q) {
  Vec<2> y = Vec<2>::Zero();
  const bool is_length = link.measure == Measure::distance || link.measure == Measure::radius;
  if (is_length && is_rounding(link.forms.front(), q)) return y;
  for (std::size_t k = 0; k < link.forms.size(); ++k) {
    const LinkForm& form = link.forms[k];
    y[static_cast<Eigen::Index>(k)] = sum(form.p, form.alpha, q).dot(sum(form.w, form.beta, q));
  }
  return y;
}

// alpha_s Q + beta_s P
LinkGradient gradient_of(const Link& link, const LinkSlots& q) {
  LinkGradient B = LinkGradient::Zero(3 * q.cols(), 2);
  for (std::size_t k = 0; k < link.forms.size(); ++k) {
    const LinkForm& form = link.forms[k];
    const Vec3 P = sum(form.p, form.alpha, q);
    const Vec3 Q = sum(form.w, form.beta, q);
    for (Eigen::Index s = 0; s < q.cols(); ++s) {
      const auto at = static_cast<std::size_t>(s);
      B.block<3, 1>(3 * s, static_cast<Eigen::Index>(k)) =
          factor(form.alpha, at) * Q + factor(form.beta, at) * P;
    }
  }
  return B;
}

// sum_k S_k (alpha beta^T + beta alpha^T)
LinkScalars curvature_of(const Link& link, const Vec<2>& stress) {
  const auto slots = static_cast<Eigen::Index>(4 * link.nodes.size());
  LinkScalars A = LinkScalars::Zero(slots, slots);
  for (std::size_t k = 0; k < link.forms.size(); ++k) {
    const LinkForm& form = link.forms[k];
    if (form.alpha.empty() || form.beta.empty()) continue;
    for (Eigen::Index s = 0; s < slots; ++s) {
      for (Eigen::Index t = 0; t < slots; ++t) {
        const auto i = static_cast<std::size_t>(s);
        const auto j = static_cast<std::size_t>(t);
        A(s, t) += stress[static_cast<Eigen::Index>(k)] *
                   (form.alpha[i] * form.beta[j] + form.beta[i] * form.alpha[j]);
      }
    }
  }
  return A;
}

LinkSlots slots_of(const Link& link, const model::Coordinates& q) {
  LinkSlots slots(3, 4 * static_cast<Eigen::Index>(link.nodes.size()));
  for (std::size_t a = 0; a < link.nodes.size(); ++a) {
    slots.middleCols<4>(4 * static_cast<Eigen::Index>(a)) =
        model::NodeTable::slots(q, link.nodes[a]);
  }
  return slots;
}

}  // namespace culm::load
