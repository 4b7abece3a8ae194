#include <culm/load/link.hpp>
#include <culm/math/rotation.hpp>

#include <Eigen/Geometry>

#include <utility>

namespace culm::load {
namespace {

using model::NodeTable;
using model::SlotSum;

Vec3 in_directors(const NodeTable& nodes, int node, const Vec3& v) {
  return NodeTable::slots(nodes.reference(), node).rightCols<3>().transpose() * v;
}

SlotSum gap(const LinkPoint& first, const LinkPoint& second) {
  SlotSum gap = model::attached_point(1, 2, second.offset);
  const SlotSum minus = model::attached_point(0, 2, first.offset);
  for (std::size_t s = 0; s < gap.size(); ++s) gap[s] -= minus[s];
  return gap;
}

Link link_between(int first, int second, Measure measure) {
  Link link;
  link.nodes = {first};
  if (second >= 0) link.nodes.push_back(second);
  link.measure = measure;
  return link;
}

}  // namespace

Vec3 reference_of(const NodeTable& nodes, const LinkPoint& point) {
  const auto q = NodeTable::slots(nodes.reference(), point.node);
  return q.col(0) + q.rightCols<3>() * point.offset;
}

std::array<Vec3, 2> reference_ends(const NodeTable& nodes, const Link& link, double scale) {
  const model::Coordinates& q = nodes.reference();
  if (link.measure == Measure::angle) {
    return {Vec3(NodeTable::slots(q, link.nodes.front()).col(0)),
            Vec3(NodeTable::slots(q, link.nodes.back()).col(0))};
  }
  // p_2 - p_1, where p_1 is in the slots of a first node or a place in space
  const LinkForm& form = link.forms.front();
  std::array<Vec3, 2> ends = {-form.p, Vec3::Zero()};
  for (std::size_t s = 0; s < form.alpha.size(); ++s) {
    const Vec3 slot = NodeTable::slots(q, link.nodes[s / 4]).col(static_cast<int>(s % 4));
    const bool is_last = s / 4 + 1 == link.nodes.size();
    if (is_last) ends[1] += form.alpha[s] * slot;
    if (!is_last) ends[0] -= form.alpha[s] * slot;
  }
  return {scale * ends[0], scale * ends[1]};
}

Link distance_link(const NodeTable& nodes, const LinkPoint& first, const LinkPoint& second) {
  Link link = link_between(first.node, second.node, Measure::distance);
  const SlotSum d = gap(first, second);
  link.forms = {{d, Vec3::Zero(), d, Vec3::Zero()}};
  link.rest = (reference_of(nodes, second) - reference_of(nodes, first)).norm();
  return link;
}

Link directed_link(const NodeTable& nodes, const LinkPoint& first, const LinkPoint& second,
                   const Vec3& n, bool follows) {
  Link link = link_between(first.node, second.node, Measure::component);
  LinkForm form{gap(first, second), Vec3::Zero(), {}, n};
  if (follows) {
    form.beta = model::attached_vector(0, 2, in_directors(nodes, first.node, n));
    form.w.setZero();
  }
  link.forms = {std::move(form)};
  link.rest = n.dot(reference_of(nodes, second) - reference_of(nodes, first));
  return link;
}

Link ground_link(const NodeTable& nodes, const LinkPoint& point, const Vec3& anchor) {
  Link link = link_between(point.node, -1, Measure::distance);
  const SlotSum p = model::attached_point(0, 1, point.offset);
  link.forms = {{p, -anchor, p, -anchor}};
  link.rest = (reference_of(nodes, point) - anchor).norm();
  return link;
}

Link directed_ground_link(const NodeTable& nodes, const LinkPoint& point, const Vec3& n,
                          bool follows) {
  Link link = link_between(point.node, -1, Measure::component);
  const SlotSum p = model::attached_point(0, 1, point.offset);
  LinkForm form{p, -reference_of(nodes, point), {}, n};
  if (follows) {
    form.beta = model::attached_vector(0, 1, in_directors(nodes, point.node, n));
    form.w.setZero();
  }
  link.forms = {std::move(form)};
  return link;
}

Link plane_ground_link(const NodeTable& nodes, const LinkPoint& point, const Vec3& n) {
  Link link = link_between(point.node, -1, Measure::radius);
  const Vec3 across = any_normal(n);
  for (const Vec3& e : {across, Vec3(n.cross(across))}) {
    link.forms.push_back(directed_ground_link(nodes, point, e, false).forms.front());
  }
  return link;
}

Link angle_link(const joint::MarkerPair& pair, const Vec3& axis) {
  Link link = link_between(pair.nodes().front(), pair.nodes().back(), Measure::angle);
  const Vec3 n1 = pair.across(axis);
  const SlotSum of_second = pair.vector(1, n1);
  for (const Vec3& e : {n1, Vec3(axis.cross(n1))}) {
    link.forms.push_back({pair.vector(0, e), Vec3::Zero(), of_second, Vec3::Zero()});
  }
  return link;
}

}  // namespace culm::load
