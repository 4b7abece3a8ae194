#include <culm/analysis/linearisation.hpp>
#include <culm/analysis/modal.hpp>
#include <culm/analysis/mode_properties.hpp>
#include <culm/base/error.hpp>

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace culm::analysis {
namespace {

// Below it a tangent counts as symmetric.
constexpr double largest_asymmetry = 1e-7;
// Eigenvalues below so many times their rounding are zero.
constexpr double zero_bound = 4.0;

struct Mode {
  double eigenvalue = 0.0;  ///< omega^2 [1/s^2]
  bool is_rigid = false;
  ModeProperties properties;
};

double frequency(double eigenvalue) {
  return std::sqrt(std::abs(eigenvalue)) / (2.0 * std::numbers::pi);
}

std::string mode_name(std::size_t i, const Mode& mode) {
  if (mode.is_rigid) return fmt::format("mode {}, 0 Hz", i + 1);
  if (mode.eigenvalue < 0.0) return fmt::format("mode {}, unstable", i + 1);
  return fmt::format("mode {}, {:.4g} Hz", i + 1, frequency(mode.eigenvalue));
}

// The sign of an eigenvector is arbitrary: the largest displacement, or else rotation, is positive.
// Components that differ by rounding count as equal; the first decides.
double sign_of(const std::vector<Vec6>& motions) {
  for (int first : {0, 3}) {
    double size = 0.0;
    double rest = 0.0;
    for (const Vec6& motion : motions) {
      size = std::max(size, motion.segment<3>(first).lpNorm<Eigen::Infinity>());
      rest = std::max(rest, motion.lpNorm<Eigen::Infinity>());
    }
    if (size <= 1e-6 * rest) continue;
    for (const Vec6& motion : motions) {
      for (int i = first; i < first + 3; ++i) {
        if (std::abs(motion[i]) >= 0.999 * size) return motion[i] > 0.0 ? 1.0 : -1.0;
      }
    }
  }
  return 1.0;
}

ReportTable make_table(const std::vector<Mode>& modes, const model::Model& model) {
  ReportTable table;
  table.name = "modes";
  table.columns = {"mode",
                   "frequency [Hz]",
                   "eigenvalue [1/s^2]",
                   "modal mass [kg]",
                   "participation x [kg^0.5]",
                   "participation y [kg^0.5]",
                   "participation z [kg^0.5]",
                   "participation rx [kg^0.5 m]",
                   "participation ry [kg^0.5 m]",
                   "participation rz [kg^0.5 m]",
                   "effective mass x [kg]",
                   "effective mass y [kg]",
                   "effective mass z [kg]",
                   "effective inertia x [kg m^2]",
                   "effective inertia y [kg m^2]",
                   "effective inertia z [kg m^2]"};
  for (std::size_t i = 0; i < modes.size(); ++i) {
    const Mode& mode = modes[i];
    const bool vibrates = !mode.is_rigid && mode.eigenvalue > 0.0;
    std::vector<double> row = {static_cast<double>(i + 1),
                               vibrates ? frequency(mode.eigenvalue) : 0.0,
                               mode.is_rigid ? 0.0 : mode.eigenvalue, mode.properties.modal_mass};
    const Vec6& p = mode.properties.participation;
    row.insert(row.end(), p.data(), p.data() + 6);
    for (int d = 0; d < 6; ++d) row.push_back(p[d] * p[d]);
    table.rows.push_back(std::move(row));
    table.remarks.push_back(describe_shares(model, mode.properties.energy));
  }
  return table;
}

std::string make_text(const std::vector<Mode>& modes, const ReportTable& table, const Vec6& total,
                      const solver::EigenPairs& pairs) {
  std::string text = fmt::format(
      "{:>5} {:>13} {:>12}   effective mass [%]     effective inertia [%]\n"
      "{:>5} {:>13} {:>12} {:>6} {:>6} {:>6}   {:>6} {:>6} {:>6}   kinetic energy\n",
      "", "", "", "mode", "frequency", "modal mass", "x", "y", "z", "x", "y", "z");
  Vec6 sum = Vec6::Zero();
  const auto percent = [&](const Vec6& effective) {
    std::string columns;
    for (int d = 0; d < 6; ++d) {
      const double share = total[d] > 0.0 ? 100.0 * effective[d] / total[d] : 0.0;
      columns += fmt::format("{}{:6.2f} ", d == 3 ? "  " : "", share);
    }
    return columns;
  };
  std::size_t rigid = 0;
  std::size_t unstable = 0;
  for (std::size_t i = 0; i < modes.size(); ++i) {
    const Mode& mode = modes[i];
    const Vec6 effective = mode.properties.participation.cwiseAbs2();
    sum += effective;
    rigid += mode.is_rigid;
    const bool grows = !mode.is_rigid && mode.eigenvalue < 0.0;
    unstable += grows;
    const std::string name =
        grows ? fmt::format("+{:.5g} 1/s", std::sqrt(-mode.eigenvalue))
              : fmt::format("{:.6g} Hz", mode.is_rigid ? 0.0 : frequency(mode.eigenvalue));
    const double mass = mode.properties.modal_mass;
    text += fmt::format("{:>5} {:>13} {:>12} {}  {}\n", i + 1, name,
                        mass > 0.0 ? fmt::format("{:.4g} kg", mass) : "-", percent(effective),
                        table.remarks[i]);
  }
  text += fmt::format("{:>5} {:>13} {:>12} {}\n", "sum", "", fmt::format("{:.4g} kg", total[0]),
                      percent(sum));
  if (rigid > 0) {
    text += fmt::format("{} at 0 Hz: rigid-body motions and mechanisms\n",
                        rigid == 1 ? "1 mode" : fmt::format("{} modes", rigid));
  }
  if (unstable > 0) {
    text += fmt::format(
        "{} unstable: the state is no stable equilibrium, motions grow at the rates "
        "given\n",
        unstable == 1 ? "1 mode is" : fmt::format("{} modes are", unstable));
  }
  return text + fmt::format("eigensolver: {}, largest residual {:.1e}\n", pairs.solver,
                            pairs.worst_residual);
}

}  // namespace

Schema Modal::schema() {
  const ModalSettings defaults;
  return Schema("Modal",
                "Natural frequencies and mode shapes of small vibrations about the present state, "
                "which stays as it is.")
      .add(integer("Modes", "How many modes to find.").at_least(1).optional(defaults.modes))
      .add(number("Near", "Hz",
                  "Frequency next to which modes are looked for; the lowest ones if absent.")
               .positive()
               .optional())
      .add(choice("Solver", solver::eigen_solver_names(),
                  "Of the eigenproblem: Spectra for large models; Dense reduces whole matrices, "
                  "best for small ones and to check; Automatic decides.")
               .optional(defaults.solver));
}

std::unique_ptr<Analysis> Modal::make(const Options& options) {
  ModalSettings settings;
  settings.modes = options.integer("Modes");
  if (options.has("Near")) settings.near = options.number("Near");
  settings.solver = options.text("Solver");
  return std::make_unique<Modal>(std::move(settings));
}

AnalysisReport Modal::advance(Context& context, model::State& state, Observer&) {
  assembly::System& system = context.system;
  const model::Model& model = system.model();
  const Ledger::Scope scope(context.ledger, context.ledger.add("Eigenproblem"));
  const Linearisation linear = linearise(context, state);
  system.synchronise(state);
  if (linear.asymmetry > largest_asymmetry) {
    throw NumericalError(fmt::format(
        "The tangent is not symmetric (by {:.1e}): a state out of balance, or loads that follow "
        "the structure.\nTry: a static analysis before.",
        linear.asymmetry));
  }
  solver::EigenSettings settings;
  settings.solver = settings_.solver;
  settings.linear_solver = context.linear.name();
  settings.count = settings_.modes;
  // just below zero, so that free bodies have factors, too
  settings.shift = -1e-10 * typical_eigenvalue(linear, system);
  if (settings_.near) settings.shift = std::pow(2.0 * std::numbers::pi * *settings_.near, 2);
  const solver::EigenPairs pairs =
      solver::solve_eigenproblem({linear.stiffness, linear.mass}, settings, system.comm());

  const ModeMasses masses(model, state);
  AnalysisReport report;
  std::vector<Mode> modes;
  for (std::size_t i = 0; i < pairs.values.size(); ++i) {
    Mode mode;
    mode.eigenvalue = pairs.values[i];
    mode.is_rigid = std::abs(pairs.values[i]) <= zero_bound * pairs.rounding[i];
    std::vector<Vec6> motions =
        node_motions(system, state, pairs.vectors.col(static_cast<Eigen::Index>(i)));
    const double sign = sign_of(motions);
    for (Vec6& motion : motions) motion *= sign;
    mode.properties = masses.properties(motions);
    report.shapes.push_back({mode_name(i, mode), std::move(motions), {}});
    modes.push_back(std::move(mode));
  }
  report.tables.push_back(make_table(modes, model));
  report.text = make_text(modes, report.tables.back(), masses.total(), pairs);
  return report;
}

}  // namespace culm::analysis
