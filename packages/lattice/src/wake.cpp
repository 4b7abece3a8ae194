#include <culm/lattice/wake.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace culm::lattice {
namespace {

constexpr double lamb = 1.25643;  // where a viscous vortex turns fastest, r^2 / (4 nu t)

void prepend(Points& lines, const Points& line) {
  const auto put = [](std::vector<double>& all, const std::vector<double>& first) {
    all.insert(all.begin(), first.begin(), first.end());
  };
  put(lines.x, line.x);
  put(lines.y, line.y);
  put(lines.z, line.z);
}

}  // namespace

Wake::Wake(const BoundLattice& lattice, int max_rows, WakeCore core)
    : surfaces_(lattice.surfaces()),
      num_edge_points_(lattice.num_edge_points()),
      num_strips_(lattice.num_strips()),
      max_rows_(max_rows),
      core_(core) {}

void Wake::make_straight(const Points& far, std::vector<double> circulation) {
  lines_ = far;
  circulation_ = std::move(circulation);
  ages_.assign(1, 0.0);
}

void Wake::advance(double step, const Points& edges, const Points& edge_velocities,
                   const Points& line_velocities, const std::vector<double>& circulation) {
  const auto move = [step](Points& places, const Points& velocities) {
    for (std::size_t i = 0; i < places.size(); ++i) places.add(i, step * velocities.at(i));
  };
  Points first = edges;
  move(first, edge_velocities);
  move(lines_, line_velocities);
  for (double& age : ages_) age += step;
  prepend(lines_, first);
  circulation_.insert(circulation_.begin(), circulation.begin(), circulation.end());
  ages_.insert(ages_.begin(), step);
  if (rows() <= max_rows_) return;
  ages_.pop_back();
  lines_.resize(ages_.size() * num_edge_points_);
  circulation_.resize(ages_.size() * num_strips_);
}

double Wake::core(const Panelling& surface, double age) const {
  const double start = core_.width * surface.side();
  return std::sqrt(start * start + 4.0 * lamb * core_.growth * age);
}

double Wake::strength(int row, std::size_t strip) const {
  return row < rows() ? circulation_[static_cast<std::size_t>(row) * num_strips_ + strip] : 0.0;
}

Wake::Sheet Wake::near_part(const Points& edges) const {
  Sheet sheet;
  if (rows() == 0) return sheet;
  for (const Panelling& s : surfaces_) {
    const double radius = core(s, 0.0);
    for (int j = 0; j < s.panels.span; ++j) {
      sheet.segments.push_back(edges.at(s.edge_point(j)), edges.at(s.edge_point(j + 1)),
                               s.bound_core());
      sheet.strengths.push_back(strength(0, s.strip(j)));
    }
    for (int j = 0; j <= s.panels.span; ++j) {
      const double left = j > 0 ? strength(0, s.strip(j - 1)) : 0.0;
      const double right = j < s.panels.span ? strength(0, s.strip(j)) : 0.0;
      sheet.segments.push_back(edges.at(s.edge_point(j)), lines_.at(s.edge_point(j)), radius);
      sheet.strengths.push_back(left - right);
    }
  }
  return sheet;
}

Wake::Sheet Wake::far_part() const {
  Sheet sheet;
  for (const Panelling& s : surfaces_) {
    for (int line = 0; line < rows(); ++line) {
      const double radius = core(s, ages_[static_cast<std::size_t>(line)]);
      const auto place = [&](int at, int j) { return lines_.at(line_point(at, s.edge_point(j))); };
      for (int j = 0; j < s.panels.span; ++j) {
        sheet.segments.push_back(place(line, j), place(line, j + 1), radius);
        sheet.strengths.push_back(strength(line + 1, s.strip(j)) - strength(line, s.strip(j)));
      }
      if (line + 1 == rows()) continue;
      for (int j = 0; j <= s.panels.span; ++j) {
        const double left = j > 0 ? strength(line + 1, s.strip(j - 1)) : 0.0;
        const double right = j < s.panels.span ? strength(line + 1, s.strip(j)) : 0.0;
        sheet.segments.push_back(place(line, j), place(line + 1, j), radius);
        sheet.strengths.push_back(left - right);
      }
    }
  }
  return sheet;
}

std::size_t Wake::memory_size() const {
  return 1 + static_cast<std::size_t>(max_rows_) * (3 * num_edge_points_ + num_strips_ + 1);
}

void Wake::save(std::span<double> memory) const {
  std::fill(memory.begin(), memory.end(), 0.0);
  auto out = memory.begin();
  *out++ = rows();
  for (const std::vector<double>* part : {&lines_.x, &lines_.y, &lines_.z, &circulation_, &ages_}) {
    out = std::copy(part->begin(), part->end(), out);
  }
}

void Wake::restore(std::span<const double> memory) {
  auto in = memory.begin();
  const auto rows = static_cast<std::size_t>(*in++);
  const auto take = [&in](std::vector<double>& part, std::size_t count) {
    part.assign(in, in + static_cast<std::ptrdiff_t>(count));
    in += static_cast<std::ptrdiff_t>(count);
  };
  take(lines_.x, rows * num_edge_points_);
  take(lines_.y, rows * num_edge_points_);
  take(lines_.z, rows * num_edge_points_);
  take(circulation_, rows * num_strips_);
  take(ages_, rows);
}

}  // namespace culm::lattice
