#include <culm/port/faces.hpp>

#include <fmt/format.h>

#include <cmath>
#include <set>
#include <utility>

namespace culm::port {
namespace {

constexpr double gauss = 0.57735026918962576;  // 1 / sqrt(3)

int corners_of(const Face& face) { return face[3] == -1 ? 3 : 4; }

Eigen::Map<const Vec3> at(std::span<const double> positions, int point) {
  return Eigen::Map<const Vec3>(positions.data() + 3 * static_cast<std::ptrdiff_t>(point));
}

// Weights of the corners at a point of a face, and the normal there times its share of the area.
struct Sample {
  std::array<double, 4> weights = {};
  Vec3 normal = Vec3::Zero();
  Vec3 position = Vec3::Zero();
};

// Of a triangle, by its mid-points of edges: exact for quadratic integrands.
template <class Visit>
void sample_triangle(const std::array<Vec3, 4>& x, Visit visit) {
  const Vec3 normal = 0.5 * (x[1] - x[0]).cross(x[2] - x[0]);
  for (std::size_t i = 0; i < 3; ++i) {
    Sample sample;
    sample.weights[i] = sample.weights[(i + 1) % 3] = 0.5;
    sample.normal = normal / 3.0;
    sample.position = 0.5 * (x[i] + x[(i + 1) % 3]);
    visit(sample);
  }
}

// Of a quadrilateral, by two Gauss points in each direction: exact for cubic integrands.
template <class Visit>
void sample_quadrilateral(const std::array<Vec3, 4>& x, Visit visit) {
  constexpr std::array<double, 4> xi = {-1.0, 1.0, 1.0, -1.0}, eta = {-1.0, -1.0, 1.0, 1.0};
  for (std::size_t g = 0; g < 4; ++g) {
    const double s = gauss * xi[g], t = gauss * eta[g];
    Sample sample;
    Vec3 along_s = Vec3::Zero(), along_t = Vec3::Zero();
    for (std::size_t a = 0; a < 4; ++a) {
      sample.weights[a] = 0.25 * (1.0 + xi[a] * s) * (1.0 + eta[a] * t);
      along_s += 0.25 * xi[a] * (1.0 + eta[a] * t) * x[a];
      along_t += 0.25 * eta[a] * (1.0 + xi[a] * s) * x[a];
      sample.position += sample.weights[a] * x[a];
    }
    sample.normal = along_s.cross(along_t);
    visit(sample);
  }
}

template <class Visit>
void sample(const Face& face, const std::array<Vec3, 4>& x, Visit visit) {
  if (corners_of(face) == 3) {
    sample_triangle(x, visit);
  } else {
    sample_quadrilateral(x, visit);
  }
}

}  // namespace

std::string objection_to(std::span<const Face> faces, int points) {
  for (std::size_t i = 0; i < faces.size(); ++i) {
    const int corners = corners_of(faces[i]);
    std::set<int> different;
    for (int a = 0; a < corners; ++a) {
      const int point = faces[i][static_cast<std::size_t>(a)];
      if (point < 0 || point >= points) {
        return fmt::format("face {} names point {}; there are {}, from 0", i, point, points);
      }
      different.insert(point);
    }
    if (static_cast<int>(different.size()) < corners) {
      return fmt::format("face {} names a point twice", i);
    }
  }
  return {};
}

bool is_closed(std::span<const Face> faces) {
  std::multiset<std::pair<int, int>> edges;
  for (const Face& face : faces) {
    const int n = corners_of(face);
    for (int a = 0; a < n; ++a) {
      edges.insert(
          {face[static_cast<std::size_t>(a)], face[static_cast<std::size_t>((a + 1) % n)]});
    }
  }
  for (const auto& [from, to] : edges) {
    if (edges.count({from, to}) != 1 || edges.count({to, from}) != 1) return false;
  }
  return true;
}

double volume(std::span<const Face> faces, std::span<const double> positions) {
  double sum = 0.0;
  for (const Face& face : faces) {
    std::array<Vec3, 4> x = {};
    for (int a = 0; a < corners_of(face); ++a) {
      x[static_cast<std::size_t>(a)] = at(positions, face[static_cast<std::size_t>(a)]);
    }
    sample(face, x, [&](const Sample& s) { sum += s.position.dot(s.normal) / 3.0; });
  }
  return sum;
}

std::vector<double> face_forces(std::span<const Face> faces, std::span<const double> from,
                                std::span<const double> to, std::span<const double> pressure,
                                std::span<const double> traction) {
  std::vector<double> forces(from.size(), 0.0);
  for (std::size_t i = 0; i < faces.size(); ++i) {
    const Face& face = faces[i];
    const double p = pressure.empty() ? 0.0 : pressure[i];
    const Vec3 t = traction.empty()
                       ? Vec3::Zero().eval()
                       : Vec3(traction[3 * i], traction[3 * i + 1], traction[3 * i + 2]);
    // two points in time: normals are quadratic in the motion
    for (const double share : {0.5 - 0.5 * gauss, 0.5 + 0.5 * gauss}) {
      std::array<Vec3, 4> x = {};
      for (int a = 0; a < corners_of(face); ++a) {
        const int point = face[static_cast<std::size_t>(a)];
        x[static_cast<std::size_t>(a)] = (1.0 - share) * at(from, point) + share * at(to, point);
      }
      sample(face, x, [&](const Sample& s) {
        const Vec3 load = 0.5 * (t * s.normal.norm() - p * s.normal);
        for (int a = 0; a < corners_of(face); ++a) {
          const auto point = static_cast<std::ptrdiff_t>(face[static_cast<std::size_t>(a)]);
          Eigen::Map<Vec3>(forces.data() + 3 * point) +=
              s.weights[static_cast<std::size_t>(a)] * load;
        }
      });
    }
  }
  return forces;
}

}  // namespace culm::port
