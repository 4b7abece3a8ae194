#include <culm/lattice/biot_savart.hpp>
#include <culm/math/vector_units.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

// Compiled with -O3 -ffast-math, see CMakeLists.txt.

namespace culm::lattice {
namespace {

// Points whose coordinates and velocities stay in the first cache while all segments pass.
constexpr std::size_t chunk = 256;
// Keeps the quotient finite where a segment has no length; too small to be seen elsewhere.
constexpr double tiny = 1e-100;

struct Segment {
  double ax, ay, az, bx, by, bz;
  double cut;     // (r_c r0)^4 / 4
  double factor;  // G / (4 pi)
};

Segment segment_of(const Segments& all, std::size_t s, double strength) {
  const Vec3 a = all.from.at(s), b = all.to.at(s);
  const double area = all.core[s] * all.core[s] * (b - a).squaredNorm();
  return {a.x(),
          a.y(),
          a.z(),
          b.x(),
          b.y(),
          b.z(),
          0.25 * area * area + tiny,
          strength / (4.0 * std::numbers::pi)};
}

// Inlined into each clone, so that it is compiled for the same vector unit.
[[gnu::always_inline]] inline void induce(const Segment& s, double x, double y, double z, double& u,
                                          double& v, double& w) {
  const double px = x - s.ax, py = y - s.ay, pz = z - s.az;
  const double qx = x - s.bx, qy = y - s.by, qz = z - s.bz;
  const double r1 = std::sqrt(px * px + py * py + pz * pz);
  const double r2 = std::sqrt(qx * qx + qy * qy + qz * qz);
  const double product = r1 * r2;
  const double dot = px * qx + py * qy + pz * qz;
  const double d = product * (product + dot);
  const double g = s.factor * (r1 + r2) / std::sqrt(d * d + s.cut);
  u = g * (py * qz - pz * qy);
  v = g * (pz * qx - px * qz);
  w = g * (px * qy - py * qx);
}

CULM_FOR_EACH_VECTOR_UNIT
void add_chunk(const Segment* segments, std::size_t num_segments, const double* x, const double* y,
               const double* z, double* u, double* v, double* w, std::size_t count) {
  for (std::size_t s = 0; s < num_segments; ++s) {
    const Segment segment = segments[s];
#pragma GCC ivdep
    for (std::size_t i = 0; i < count; ++i) {
      double du, dv, dw;
      induce(segment, x[i], y[i], z[i], du, dv, dw);
      u[i] += du;
      v[i] += dv;
      w[i] += dw;
    }
  }
}

CULM_FOR_EACH_VECTOR_UNIT
void add_normal(const Segment& given, const double* x, const double* y, const double* z,
                const double* nx, const double* ny, const double* nz, double* sums,
                std::size_t count) {
  const Segment segment = given;
#pragma GCC ivdep
  for (std::size_t i = 0; i < count; ++i) {
    double u, v, w;
    induce(segment, x[i], y[i], z[i], u, v, w);
    sums[i] += u * nx[i] + v * ny[i] + w * nz[i];
  }
}

}  // namespace

void add_velocities(const Segments& segments, std::span<const double> strengths,
                    const Points& points, Points& velocities) {
  std::vector<Segment> prepared;
  prepared.reserve(segments.size());
  for (std::size_t s = 0; s < segments.size(); ++s) {
    prepared.push_back(segment_of(segments, s, strengths[s]));
  }
  for (std::size_t first = 0; first < points.size(); first += chunk) {
    add_chunk(prepared.data(), prepared.size(), points.x.data() + first, points.y.data() + first,
              points.z.data() + first, velocities.x.data() + first, velocities.y.data() + first,
              velocities.z.data() + first, std::min(chunk, points.size() - first));
  }
}

void add_normal_velocities(const Segments& segments, std::size_t segment, double factor,
                           const Points& points, const Points& normals, std::span<double> sums) {
  add_normal(segment_of(segments, segment, factor), points.x.data(), points.y.data(),
             points.z.data(), normals.x.data(), normals.y.data(), normals.z.data(), sums.data(),
             points.size());
}

}  // namespace culm::lattice
