#include "shell_frame.hpp"

#include <culm/model/constraint_batch.hpp>
#include <culm/model/product_sum.hpp>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

namespace culm::shell {

namespace {

using Points = Eigen::Matrix3Xd;

Points positions(const std::vector<int>& nodes, const model::NodeTable& table) {
  Points x(3, static_cast<Eigen::Index>(nodes.size()));
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    x.col(static_cast<Eigen::Index>(i)) =
        model::NodeTable::slots(table.reference(), nodes[i]).col(0);
  }
  return x;
}

// Columns of points that are far from each other: first the one farthest from the mean, then
// always the one farthest from all before; of those that are as far to rounding the first, so that
// a shell that lies elsewhere in space has the same.
std::vector<Eigen::Index> spread_out(const Points& x, int most) {
  Eigen::RowVectorXd distance = (x.colwise() - x.rowwise().mean()).colwise().norm();
  const double size = distance.maxCoeff();
  std::vector<Eigen::Index> chosen;
  while (static_cast<int>(chosen.size()) < most && distance.maxCoeff() > 1e-6 * size) {
    const double least = (1.0 - 1e-9) * distance.maxCoeff();
    const Eigen::Index farthest =
        std::find_if(distance.begin(), distance.end(), [least](double d) { return d >= least; }) -
        distance.begin();
    if (chosen.empty()) distance.setConstant(std::numeric_limits<double>::infinity());
    chosen.push_back(farthest);
    distance = distance.cwiseMin((x.colwise() - x.col(farthest)).colwise().norm());
  }
  return chosen;
}

using Inertia = Eigen::SelfAdjointEigenSolver<Mat3>;

Points about_mean(const Points& x) { return x.colwise() - x.rowwise().mean(); }

// How far a frame on these points rolls about their longest axis where they are bent along it:
// angle [rad] per curvature and length of that axis. Points that lie alike on both sides of the
// axis do not roll.
double roll_by_bending(const Points& x) {
  const Points from_mean = about_mean(x);
  const Inertia inertia(from_mean * from_mean.transpose());
  const double length = std::sqrt(inertia.eigenvalues()[2]);
  const Eigen::RowVectorXd along = inertia.eigenvectors().col(2).transpose() * from_mean;
  const Eigen::RowVectorXd across = inertia.eigenvectors().col(1).transpose() * from_mean;
  const Eigen::RowVectorXd squares = along.cwiseAbs2();
  const double cubes = across.dot(squares.cwiseProduct(along)) / length;
  return std::hypot(across.dot(squares), cubes) / (inertia.eigenvalues()[1] * length);
}

// The points that lie farthest to each corner of a shell as seen along its principal axes.
std::vector<Eigen::Index> corners(const Points& x) {
  const Points from_mean = about_mean(x);
  const Inertia inertia(from_mean * from_mean.transpose());
  const Eigen::RowVectorXd along = inertia.eigenvectors().col(2).transpose() * from_mean;
  const Eigen::RowVectorXd across = inertia.eigenvectors().col(1).transpose() * from_mean;
  std::vector<Eigen::Index> found;
  for (const double first : {-1.0, 1.0}) {
    for (const double second : {-1.0, 1.0}) {
      Eigen::Index farthest = 0;
      (first / along.cwiseAbs().maxCoeff() * along + second / across.cwiseAbs().maxCoeff() * across)
          .maxCoeff(&farthest);
      if (std::ranges::find(found, farthest) == found.end()) found.push_back(farthest);
    }
  }
  return found;
}

// Points for a frame. In a slender strip those that are far from each other lie in a row, on one
// edge here and on the other there, so that bending makes them roll.
std::vector<Eigen::Index> choose_points(const Points& x, int most) {
  constexpr double little = 0.5;
  const auto roll = [&](const std::vector<Eigen::Index>& points) {
    return roll_by_bending(x(Eigen::all, points));
  };
  std::vector<Eigen::Index> far = spread_out(x, most);
  if (roll(far) < little) return far;
  std::vector<Eigen::Index> four = corners(x);
  const bool is_worse = roll(four) >= roll(far);  // far ones may lie on one edge, and have none
  return four.size() == 4 && !is_worse ? four : far;
}

}  // namespace

int add_frame(const std::string& shell, const std::vector<int>& nodes, model::Model& model) {
  constexpr int most = model::ConstraintBatch::max_nodes - 1;
  const Points all = positions(nodes, model.nodes());
  const std::vector<Eigen::Index> points = choose_points(all, most);
  std::vector<int> chosen;
  for (Eigen::Index column : points) chosen.push_back(nodes[static_cast<std::size_t>(column)]);
  const Vec3 mean = all(Eigen::all, points).rowwise().mean();
  const Points x = about_mean(all(Eigen::all, points));
  const Inertia inertia(x * x.transpose());
  const Vec3 largest = inertia.eigenvectors().col(2);
  const Vec3 second = inertia.eigenvectors().col(1);

  model::NodeSlots slots;
  slots << mean, largest, second, largest.cross(second);
  const int frame = model.nodes().add(slots);
  model::Structure& structure = model.add_structure(shell + " frame");
  structure.nodes = {frame};
  structure.sets = {{"first", {frame}}, {"last", {frame}}, {"all", {frame}}};
  structure.cells.push_back({{frame}, nullptr, 0});

  model::Constraint c;
  c.name = structure.name;
  c.type = "Shell Frame";
  c.is_internal = true;
  c.is_structural = true;
  c.nodes = {frame};
  c.nodes.insert(c.nodes.end(), chosen.begin(), chosen.end());
  const auto count = static_cast<int>(c.nodes.size());
  // sum of factors times the positions of the chosen nodes
  const auto sum = [&](const Eigen::RowVectorXd& factors) {
    model::SlotSum result(static_cast<std::size_t>(4 * count), 0.0);
    for (Eigen::Index a = 0; a < factors.size(); ++a) {
      result[static_cast<std::size_t>(4 * (a + 1))] = factors[a];
    }
    return result;
  };
  const auto director = [&](int i) { return model::attached_vector(0, count, Vec3::Unit(i)); };
  const Eigen::Matrix3Xd q = model::slots_of(c, model.nodes().reference());
  model::SlotSum from_frame = sum(Eigen::RowVectorXd::Constant(x.cols(), 1.0 / (count - 1)));
  from_frame[0] = -1.0;
  for (int i = 0; i < 3; ++i) c.rows.push_back(model::product_row(from_frame, director(i), q));
  // the moment of the points about the frame vanishes, which does not depend on the axes taken in
  // it
  const auto moment = [&](const Vec3& axis, double size) {
    return sum(axis.transpose() * x / size);
  };
  const double in_first = inertia.eigenvalues()[2];
  const double in_second = inertia.eigenvalues()[1];
  c.rows.push_back(model::product_row(moment(largest, in_first), director(2), q));
  c.rows.push_back(model::product_row(moment(second, in_second), director(2), q));
  const double in_both = in_first + in_second;
  c.rows.push_back(model::sum_row(
      {{moment(largest, in_both), director(1)}, {moment(-second, in_both), director(0)}}, q));
  model.add_constraint(std::move(c));
  return frame;
}

}  // namespace culm::shell
