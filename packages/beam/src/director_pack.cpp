#include <culm/beam/director_pack.hpp>
#include <culm/math/types.hpp>
#include <culm/math/vector_units.hpp>
#include <culm/mechanics/pack_geometry.hpp>

#include <cstring>
#include <utility>

namespace culm::beam {

namespace {

// Cyclic partners of a director: (i, j, k) = (0, 1, 2), (1, 2, 0), (2, 0, 1).
// Coordinates of the slots x, d1, d2, d3, interpolated: those of director i start here.
constexpr int director(int i) { return 3 * (1 + i); }

// Axis and triad at a point, and their derivatives by arc length.
template <int Order>
struct PackFrame {
  Pack f[12], df[12];

  CULM_INLINE PackFrame(const typename DirectorPack<Order>::Point& p, const Pack* q) {
    for (int c = 0; c < 12; ++c) {
      f[c] = p.N[0] * q[c];
      df[c] = p.dN[0] * q[c];
      for (std::size_t a = 1; a <= Order; ++a) {
        f[c] += p.N[a] * q[12 * a + static_cast<std::size_t>(c)];
        df[c] += p.dN[a] * q[12 * a + static_cast<std::size_t>(c)];
      }
    }
  }
};

// e += weight (Γ, K) less that of the reference, with Γ_i = d_i . x' and
// K_i = 1/2 (d_j' . d_k - d_k' . d_j)
template <int Order>
CULM_INLINE void add_strain(const typename DirectorPack<Order>::Point& p,
                            const PackFrame<Order>& frame, double weight, Pack* e) {
  for (int i = 0; i < 3; ++i) {
    const int j = next_axis(i);
    const int k = next_axis(j);
    Pack shear = -p.reference[static_cast<std::size_t>(i)];
    Pack bend = {};
    for (int c = 0; c < 3; ++c) {
      shear += frame.f[director(i) + c] * frame.df[c];
      bend += frame.df[director(j) + c] * frame.f[director(k) + c] -
              frame.df[director(k) + c] * frame.f[director(j) + c];
    }
    e[i] += weight * shear;
    e[3 + i] += weight * (0.5 * bend - p.reference[static_cast<std::size_t>(3 + i)]);
  }
}

// e += weight B^T dq, with the frames of q and dq
template <int Order>
CULM_INLINE void add_strain_increment(const PackFrame<Order>& q, const PackFrame<Order>& dq,
                                      double weight, Pack* e) {
  for (int i = 0; i < 3; ++i) {
    const int j = director(next_axis(i));
    const int k = director(next_axis(next_axis(i)));
    Pack shear = {};
    Pack bend = {};
    for (int c = 0; c < 3; ++c) {
      shear += q.f[director(i) + c] * dq.df[c] + dq.f[director(i) + c] * q.df[c];
      bend += q.df[j + c] * dq.f[k + c] + dq.df[j + c] * q.f[k + c] - q.df[k + c] * dq.f[j + c] -
              dq.df[k + c] * q.f[j + c];
    }
    e[i] += weight * shear;
    e[3 + i] += 0.5 * weight * bend;
  }
}

// e += the mean of the strains at both ends of the step that the stencil asks for
template <int Order>
CULM_INLINE void add_mean_strain(const typename DirectorPack<Order>::Point& p,
                                 const PackMotion<Order + 1>& motion, const PackFrame<Order>& next,
                                 const Stencil& stencil, Pack* e) {
  const double weight = stencil.theta_strain;
  add_strain<Order>(p, next, weight, e);
  if (weight != 1.0) {
    add_strain<Order>(p, PackFrame<Order>(p, motion.prev.data()), 1.0 - weight, e);
  }
}

// The stiffness of the length that a point stands for, in full.
template <int Order>
CULM_INLINE void unpack_stiffness(const Pack& length,
                                  const Packs<DirectorPack<Order>::entries(6)>& section, Pack* C) {
#pragma GCC unroll 6
  for (int i = 0; i < 6; ++i) {
#pragma GCC unroll 6
    for (int j = 0; j < 6; ++j) {
      C[6 * i + j] =
          i <= j ? length * section.numbers[DirectorPack<Order>::entry(6, i, j)] : C[6 * j + i];
    }
  }
}

CULM_INLINE void compute_stress(const Pack* C, const Pack* e, Pack* stress) {
  for (int i = 0; i < 6; ++i) {
    stress[i] = C[6 * i] * e[0];
    for (int j = 1; j < 6; ++j) stress[i] += C[6 * i + j] * e[j];
  }
}

// force += B^T S on slots: on x_a  N'_a Σ S_i d_i,  on d_i,a  N_a S_i x' + S_3+k h_j - S_3+j h_k
// with h_i = 1/2 (N'_a d_i - N_a d_i')
template <int Order>
CULM_INLINE void add_force(const typename DirectorPack<Order>::Point& p,
                           const PackFrame<Order>& frame, const Pack* S, Pack* force) {
  Pack resultant[3], by_derivative[9], by_value[9];
  for (int c = 0; c < 3; ++c) {
    resultant[c] = S[0] * frame.f[director(0) + c] + S[1] * frame.f[director(1) + c] +
                   S[2] * frame.f[director(2) + c];
    for (int i = 0; i < 3; ++i) {
      const int j = next_axis(i);
      const int k = next_axis(j);
      by_derivative[3 * i + c] =
          0.5 * (S[3 + k] * frame.f[director(j) + c] - S[3 + j] * frame.f[director(k) + c]);
      by_value[3 * i + c] = S[i] * frame.df[c] - 0.5 * (S[3 + k] * frame.df[director(j) + c] -
                                                        S[3 + j] * frame.df[director(k) + c]);
    }
  }
  for (std::size_t a = 0; a <= Order; ++a) {
    Pack* on_node = force + 12 * a;
    for (int c = 0; c < 3; ++c) on_node[c] += p.dN[a] * resultant[c];
    for (int c = 0; c < 9; ++c) {
      on_node[3 + c] += p.dN[a] * by_derivative[c] + p.N[a] * by_value[c];
    }
  }
}

// Γ_i: A[x_b, d_i,a] = N_a N'_b S_i      K_i: A[d_j,a, d_k,b] = 1/2 (N'_a N_b - N_a N'_b) S_3+i
template <int Order>
CULM_INLINE void add_curvature(const typename DirectorPack<Order>::Point& p, const Pack* S,
                               double factor, Pack* A) {
  constexpr std::size_t row = 4 * (Order + 1);
  for (std::size_t a = 0; a <= Order; ++a) {
    for (std::size_t b = 0; b <= Order; ++b) {
      const Pack shear = factor * p.N[a] * p.dN[b];
      const Pack bend = 0.5 * factor * (p.N[b] * p.dN[a] - p.N[a] * p.dN[b]);
      for (int i = 0; i < 3; ++i) {
        const auto d_i = static_cast<std::size_t>(1 + i);
        const auto d_j = static_cast<std::size_t>(1 + next_axis(i));
        const auto d_k = static_cast<std::size_t>(1 + next_axis(next_axis(i)));
        A[row * (4 * b) + 4 * a + d_i] += shear * S[i];
        A[row * (4 * a + d_i) + 4 * b] += shear * S[i];
        A[row * (4 * a + d_j) + 4 * b + d_k] += bend * S[3 + i];
        A[row * (4 * b + d_k) + 4 * a + d_j] += bend * S[3 + i];
      }
    }
  }
}

// Derivatives of the strains by dx and dθ of the nodes, a strain per row; dx bends nothing.
template <int Order>
CULM_INLINE void compute_rows(const typename DirectorPack<Order>::Point& p,
                              const PackFrame<Order>& frame, const Pack* q, Pack* R) {
  constexpr std::size_t row = 6 * (Order + 1);
  constexpr Pack one = {1, 1, 1, 1, 1, 1, 1, 1};
  for (std::size_t a = 0; a <= Order; ++a) {
    const Pack* own = q + 12 * a;
    Pack h[9], pull[3];
    for (int c = 0; c < 9; ++c) {
      h[c] = 0.5 * (p.dN[a] * frame.f[3 + c] - p.N[a] * frame.df[3 + c]);
    }
    for (int c = 0; c < 3; ++c) pull[c] = p.N[a] * frame.df[c];
    for (int i = 0; i < 3; ++i) {
      const int j = next_axis(i);
      const int k = next_axis(j);
      Pack* shear = R + row * static_cast<std::size_t>(i) + 6 * a;
      Pack* bend = R + row * static_cast<std::size_t>(3 + i) + 6 * a;
      for (int c = 0; c < 3; ++c) {
        shear[c] = p.dN[a] * frame.f[director(i) + c];
        shear[3 + c] = bend[c] = bend[3 + c] = Pack{};
      }
      add_cross(own + director(i), pull, one, shear + 3);
      add_cross(own + director(j), h + 3 * k, one, bend + 3);
      add_cross(own + director(k), h + 3 * j, -one, bend + 3);
    }
  }
}

// How many strains an unknown stretches: dx those of shear and stretch alone.
constexpr int strains_of(int unknown) { return unknown % 6 < 3 ? 3 : 6; }

// K += factor R_mid^T C R_next
template <int Order>
CULM_INLINE void add_product(const Pack* C, double factor, const Pack* R_mid, const Pack* R_next,
                             Pack* K) {
  constexpr int W = 6 * (Order + 1);
  Pack CR[6 * W];
  for (int i = 0; i < 6; ++i) {
    for (int w = 0; w < W; ++w) {
      Pack sum = C[6 * i] * R_next[w];
      for (int j = 1; j < strains_of(w); ++j) sum += C[6 * i + j] * R_next[W * j + w];
      CR[W * i + w] = factor * sum;
    }
  }
  for (int u = 0; u < W; ++u) {
    for (int w = 0; w < W; ++w) {
      Pack sum = R_mid[u] * CR[w];
      for (int i = 1; i < strains_of(u); ++i) sum += R_mid[W * i + u] * CR[W * i + w];
      K[W * u + w] += sum;
    }
  }
}

// The integral of the mass of the sections.
template <int Order>
CULM_INLINE void integrate_mass(const typename DirectorPack<Order>::Geometry& geometry,
                                const typename DirectorPack<Order>::Sections& sections,
                                typename DirectorPack<Order>::Mass& mass) {
  constexpr int nodes = DirectorPack<Order>::entries(Order + 1);
  constexpr int entries = DirectorPack<Order>::entries(3);
  mass = {};
  for (std::size_t g = 0; g <= Order; ++g) {
    for (int ab = 0; ab < nodes; ++ab) {
      const Pack length = geometry.NN[g][static_cast<std::size_t>(ab)] * geometry.mass_lengths[g];
      for (int i = 0; i < entries; ++i) {
        mass.numbers[entries * ab + i] += length * sections.mass[g].numbers[i];
      }
    }
  }
}

// Calls visit(s, t, m) with the mass m between the slots s and t. The slot d3 carries none.
template <int Order, class Visit>
CULM_INLINE void for_masses(const Pack* mass, const Visit& visit) {
  using Beam = DirectorPack<Order>;
  constexpr int N = Order + 1;
  for (int a = 0; a < N; ++a) {
    for (int b = 0; b < N; ++b) {
      const Pack* between = mass + Beam::entries(3) * Beam::entry(N, a, b);
#pragma GCC unroll 3
      for (int r = 0; r < 3; ++r) {
#pragma GCC unroll 3
        for (int q = 0; q < 3; ++q) {
          visit(4 * a + r, 4 * b + q, between[Beam::entry(3, r, q)]);
        }
      }
    }
  }
}

// force += M a, A += inertia M
template <int Order>
CULM_INLINE void add_inertia(const Pack* mass, const Pack* acceleration, double inertia, Pack* A,
                             Pack* force) {
  constexpr int S = 4 * (Order + 1);
  for_masses<Order>(
      mass, [&](int s, int t, const Pack& m) __attribute__((always_inline)) {
        for (int c = 0; c < 3; ++c) force[3 * s + c] += m * acceleration[3 * t + c];
        A[S * s + t] += inertia * m;
      });
}

template <int Order>
CULM_FOR_EACH_VECTOR_UNIT void evaluate_pack(const typename DirectorPack<Order>::Geometry& geometry,
                                             const typename DirectorPack<Order>::Sections& sections,
                                             const PackMotion<Order + 1>& motion,
                                             const Pack* predicted, const Stencil& stencil,
                                             bool with_tangent, PackSum<Order + 1>& sum) noexcept {
  constexpr int N = Order + 1;
  constexpr int W = 6 * N;
  const double theta = stencil.theta;
  const double weight = stencil.theta_strain;
  Pack mid[12 * N];
  for (int c = 0; c < 12 * N; ++c) {
    const auto at = static_cast<std::size_t>(c);
    mid[c] =
        theta == 1.0 ? motion.next[at] : (1.0 - theta) * motion.prev[at] + theta * motion.next[at];
  }
  Pack force[12 * N] = {};          // on slots
  Pack tangent_force[12 * N] = {};  // that the tangent belongs to
  Pack A[16 * N * N] = {};
  if (with_tangent) sum.tangent = {};
  for (std::size_t g = 0; g < Order; ++g) {
    const auto& p = geometry.points[g];
    const PackFrame<Order> next_frame(p, motion.next.data());
    const PackFrame<Order> mid_frame(p, mid);
    Pack C[36], e[6] = {}, stress[6];
    add_mean_strain<Order>(p, motion, next_frame, stencil, e);
    unpack_stiffness<Order>(p.length, sections.stiffness[g], C);
    compute_stress(C, e, stress);
    add_force<Order>(p, mid_frame, stress, force);
    if (!with_tangent) continue;
    const Pack* S = stress;
    if (predicted != nullptr) {
      S = predicted + 6 * g;
      add_force<Order>(p, mid_frame, S, tangent_force);
    }
    add_curvature<Order>(p, S, theta, A);
    Pack R_next[6 * W], R_mid[6 * W];
    compute_rows<Order>(p, next_frame, motion.next.data(), R_next);
    compute_rows<Order>(p, mid_frame, mid, R_mid);
    add_product<Order>(C, weight, R_mid, R_next, sum.tangent.data());
  }
  if (with_tangent && predicted == nullptr) {
    for (int c = 0; c < 12 * N; ++c) tangent_force[c] = force[c];
  }
  if (stencil.inertia != 0.0) {
    Pack acceleration[12 * N];
    for (int c = 0; c < 12 * N; ++c) {
      const auto at = static_cast<std::size_t>(c);
      acceleration[c] =
          motion.acceleration_offset[at] + stencil.inertia * (motion.next[at] - motion.prev[at]);
    }
    Pack inertia_force[12 * N] = {};
    typename DirectorPack<Order>::Mass mass;
    integrate_mass<Order>(geometry, sections, mass);
    add_inertia<Order>(mass.data(), acceleration, stencil.inertia, A, inertia_force);
    for (int c = 0; c < 12 * N; ++c) {
      force[c] += inertia_force[c];
      tangent_force[c] += inertia_force[c];
    }
  }
  constexpr Pack one = {1, 1, 1, 1, 1, 1, 1, 1};
  for (int a = 0; a < N; ++a) {
    Pack* residual = sum.residual.data() + 6 * a;
    for (int c = 0; c < 3; ++c) {
      residual[c] = force[12 * a + c];
      residual[3 + c] = Pack{};
      sum.pull[static_cast<std::size_t>(3 * a + c)] = tangent_force[12 * a + c];
    }
    for (int i = 0; i < 3; ++i) {
      add_cross(mid + 12 * a + director(i), force + 12 * a + director(i), one, residual + 3);
    }
  }
  if (with_tangent) {
    add_pack_geometry<N>(A, tangent_force, mid, motion.next.data(), theta, sum.tangent.data());
  }
}

template <int Order>
CULM_FOR_EACH_VECTOR_UNIT void extrapolate_pack(
    const typename DirectorPack<Order>::Geometry& geometry,
    const typename DirectorPack<Order>::Sections& sections, const PackMotion<Order + 1>& motion,
    const Pack* increment, const Stencil& stencil, Pack* stress) noexcept {
  for (std::size_t g = 0; g < Order; ++g) {
    const auto& p = geometry.points[g];
    const PackFrame<Order> next(p, motion.next.data());
    Pack C[36], e[6] = {};
    add_mean_strain<Order>(p, motion, next, stencil, e);
    add_strain_increment<Order>(next, PackFrame<Order>(p, increment), stencil.theta_strain, e);
    unpack_stiffness<Order>(p.length, sections.stiffness[g], C);
    compute_stress(C, e, stress + 6 * g);
  }
}

template <int Order>
CULM_FOR_EACH_VECTOR_UNIT void find_strain_energy(
    const typename DirectorPack<Order>::Geometry& geometry,
    const typename DirectorPack<Order>::Sections& sections, const Pack* slots, const Pack* less,
    Pack* energy) noexcept {
  Pack twice = {};
  for (std::size_t g = 0; g < Order; ++g) {
    const auto& p = geometry.points[g];
    Pack C[36], e[6] = {}, stress[6];
    add_strain<Order>(p, PackFrame<Order>(p, slots), 1.0, e);
    if (less != nullptr) add_strain<Order>(p, PackFrame<Order>(p, less), -1.0, e);
    unpack_stiffness<Order>(p.length, sections.stiffness[g], C);
    compute_stress(C, e, stress);
    for (int i = 0; i < 6; ++i) twice += e[i] * stress[i];
  }
  *energy = 0.5 * twice;
}

// M v
template <int Order>
CULM_INLINE void find_momenta(const typename DirectorPack<Order>::Geometry& geometry,
                              const typename DirectorPack<Order>::Sections& sections, const Pack* v,
                              Pack* p) {
  typename DirectorPack<Order>::Mass mass;
  integrate_mass<Order>(geometry, sections, mass);
  for (int c = 0; c < 12 * (Order + 1); ++c) p[c] = Pack{};
  for_masses<Order>(
      mass.data(), [&](int s, int t, const Pack& m) __attribute__((always_inline)) {
        for (int c = 0; c < 3; ++c) p[3 * s + c] += m * v[3 * t + c];
      });
}

// T = 1/2 v . M v
template <int Order>
CULM_FOR_EACH_VECTOR_UNIT void find_kinetic_energy(
    const typename DirectorPack<Order>::Geometry& geometry,
    const typename DirectorPack<Order>::Sections& sections, const Pack* v, Pack* energy) noexcept {
  Pack p[12 * (Order + 1)];
  find_momenta<Order>(geometry, sections, v, p);
  *energy = Pack{};
  for (int c = 0; c < 12 * (Order + 1); ++c) *energy += 0.5 * p[c] * v[c];
}

// T as above, L = sum of M v over positions, J = sum_s q_s x (M v)_s
template <int Order>
CULM_FOR_EACH_VECTOR_UNIT void find_pack_momentum(
    const typename DirectorPack<Order>::Geometry& geometry,
    const typename DirectorPack<Order>::Sections& sections, const Pack* q, const Pack* v,
    PackMomentum& momentum) noexcept {
  constexpr Pack one = {1, 1, 1, 1, 1, 1, 1, 1};
  Pack p[12 * (Order + 1)];
  find_momenta<Order>(geometry, sections, v, p);
  momentum = PackMomentum{};
  for (int s = 0; s < 4 * (Order + 1); ++s) {
    for (int c = 3 * s; c < 3 * s + 3; ++c) momentum.kinetic_energy += 0.5 * p[c] * v[c];
    add_cross(q + 3 * s, p + 3 * s, one, momentum.angular.data());
    if (s % 4 != 0) continue;
    for (std::size_t c = 0; c < 3; ++c) momentum.linear[c] += p[3 * index(s) + c];
  }
}

}  // namespace

template <int Order>
DirectorPack<Order>::DirectorPack(
    const std::array<const DirectorBeam<Order>*, pack_lanes>& elements,
    const DirectorPack* before) {
  auto sections = std::make_shared<Sections>();
  for (int l = 0; l < pack_lanes; ++l) {
    const DirectorBeam<Order>& element = *elements[static_cast<std::size_t>(l)];
    for (int g = 0; g < Order; ++g) {
      Point& point = geometry_.points[static_cast<std::size_t>(g)];
      for (int a = 0; a < num_nodes; ++a) {
        point.N[static_cast<std::size_t>(a)] = element.shape(g)[a];
        point.dN.of(l, a) = element.shape_derivative(g)[a];
      }
      point.length[l] = element.length(g);
      const auto& C = element.section_stiffness(g);
      for (int i = 0; i < 6; ++i) {
        point.reference.of(l, i) = element.reference_strain(g)[i];
        for (int j = i; j < 6; ++j) {
          sections->stiffness[static_cast<std::size_t>(g)].of(l, entry(6, i, j)) =
              0.5 * C(i, j) + 0.5 * C(j, i);
        }
      }
    }
    for (int g = 0; g < num_nodes; ++g) {
      const auto& N = element.mass_shape(g);
      for (int a = 0; a < num_nodes; ++a) {
        for (int b = a; b < num_nodes; ++b) {
          geometry_
              .NN[static_cast<std::size_t>(g)][static_cast<std::size_t>(entry(num_nodes, a, b))] =
              N[a] * N[b];
        }
      }
      geometry_.mass_lengths.of(l, g) = element.mass_length(g);
      const auto& mass = element.section_mass(g);
      for (int r = 0; r < 3; ++r) {
        for (int q = r; q < 3; ++q) {
          sections->mass[static_cast<std::size_t>(g)].of(l, entry(3, r, q)) = mass(r, q);
        }
      }
    }
  }
  const bool same = before != nullptr &&
                    std::memcmp(before->sections_.get(), sections.get(), sizeof(Sections)) == 0;
  sections_ = same ? before->sections_ : std::move(sections);
}

template <int Order>
void DirectorPack<Order>::evaluate(const Motion& motion, const Pack* predicted,
                                   const Stencil& stencil, bool with_tangent,
                                   Sum& sum) const noexcept {
  evaluate_pack<Order>(geometry_, *sections_, motion, predicted, stencil, with_tangent, sum);
  if (!tells_change(stencil, with_tangent)) return;
  strain_energy(motion.next.data(), motion.prev.data(), &sum.change_energy);
}

template <int Order>
void DirectorPack<Order>::extrapolate(const Motion& motion, const Pack* increment,
                                      const Stencil& stencil, Pack* stress) const noexcept {
  extrapolate_pack<Order>(geometry_, *sections_, motion, increment, stencil, stress);
}

template <int Order>
void DirectorPack<Order>::strain_energy(const Pack* slots, const Pack* less,
                                        Pack* energy) const noexcept {
  find_strain_energy<Order>(geometry_, *sections_, slots, less, energy);
}

template <int Order>
void DirectorPack<Order>::kinetic_energy(const Pack* velocity, Pack* energy) const noexcept {
  find_kinetic_energy<Order>(geometry_, *sections_, velocity, energy);
}

template <int Order>
void DirectorPack<Order>::find_momentum(const Pack* slots, const Pack* velocity,
                                        PackMomentum& momentum) const noexcept {
  find_pack_momentum<Order>(geometry_, *sections_, slots, velocity, momentum);
}

template class DirectorPack<1>;
template class DirectorPack<2>;
template class DirectorPack<3>;

}  // namespace culm::beam
