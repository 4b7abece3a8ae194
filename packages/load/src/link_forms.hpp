/// Values and derivatives of the forms of links, without heap.
#pragma once

#include <culm/load/link.hpp>
#include <culm/model/item_motion.hpp>

namespace culm::load {

constexpr int max_link_nodes = 2;
using LinkSlots = model::BoundedSlots<max_link_nodes>;
/// Derivatives of both forms by the slots; a form that is not there is zero.
using LinkGradient =
    Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::ColMajor, 12 * max_link_nodes, 2>;
/// Scalars between the slots.
using LinkScalars = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor,
                                  4 * max_link_nodes, 4 * max_link_nodes>;

/// y(q)
Vec<2> values_of(const Link& link, const LinkSlots& q);
/// B = dy/dq
LinkGradient gradient_of(const Link& link, const LinkSlots& q);
/// sum_k S_k A_k with A_k (x) 1 the second derivative of form k
LinkScalars curvature_of(const Link& link, const Vec<2>& stress);

/// The slots of the nodes of a link side by side.
LinkSlots slots_of(const Link& link, const model::Coordinates& q);

}  // namespace culm::load
