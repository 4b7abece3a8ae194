#include <culm/analysis/modal.hpp>
#include <culm/solver/eigen_solver.hpp>

#include "shear_range.hpp"

#include <fmt/format.h>

#include <cmath>

namespace culm::analysis {
namespace {

ReportTable make_table(const ModeSet& set, const model::Model& model) {
  ReportTable table;
  table.name = "modes";
  table.columns = {"mode",
                   "frequency [Hz]",
                   "damping ratio",
                   "eigenvalue real [1/s]",
                   "eigenvalue imaginary [1/s]",
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
  if (!set.modes.empty() && set.modes.front().whirl) {
    for (const char* share : {"collective", "backward whirl", "forward whirl"}) {
      table.columns.emplace_back(share);
    }
  }
  for (std::size_t i = 0; i < set.modes.size(); ++i) {
    const Mode& mode = set.modes[i];
    std::vector<double> row = {
        static_cast<double>(i + 1), mode.frequency(),       mode.damping(),
        mode.eigenvalue.real(),     mode.eigenvalue.imag(), mode.properties.modal_mass};
    const Vec6& p = mode.properties.participation;
    row.insert(row.end(), p.data(), p.data() + 6);
    for (int d = 0; d < 6; ++d) row.push_back(p[d] * p[d]);
    if (mode.whirl) {
      row.insert(row.end(), {mode.whirl->collective, mode.whirl->backward, mode.whirl->forward});
    }
    for (double& value : row) value += 0.0;  // no -0
    table.rows.push_back(std::move(row));
    table.remarks.push_back(describe(mode, model));
  }
  return table;
}

// Frequency, or rate of decay or growth where nothing oscillates.
std::string rate_text(const Mode& mode) {
  if (mode.is_zero()) return "0 Hz";
  if (mode.frequency() == 0.0) return fmt::format("{:+.5g} 1/s", mode.eigenvalue.real());
  return fmt::format("{:.6g} Hz", mode.frequency());
}

// As it is shown, without the sign of what is nothing.
double percent_of(const Mode& mode) { return 1e-3 * std::round(1e5 * mode.damping()) + 0.0; }

std::string count_text(std::size_t count, const char* text) {
  if (count == 0) return "";
  return fmt::format("{} {}\n", count == 1 ? "1 mode" : fmt::format("{} modes", count), text);
}

std::string make_text(const ModeSet& set, const ReportTable& table) {
  const std::string damping_title = set.is_complex ? fmt::format(" {:>9}", "damping") : "";
  std::string text = fmt::format(
      "{:>5} {:>13}{:>{}} {:>12}   effective mass [%]     effective inertia [%]\n"
      "{:>5} {:>13}{} {:>12} {:>6} {:>6} {:>6}   {:>6} {:>6} {:>6}   kinetic energy\n",
      "", "", "", damping_title.size(), "", "mode", "frequency", damping_title, "modal mass", "x",
      "y", "z", "x", "y", "z");
  Vec6 sum = Vec6::Zero();
  const auto percent = [&](const Vec6& effective) {
    std::string columns;
    for (int d = 0; d < 6; ++d) {
      const double share = set.total[d] > 0.0 ? 100.0 * effective[d] / set.total[d] : 0.0;
      columns += fmt::format("{}{:6.2f} ", d == 3 ? "  " : "", share);
    }
    return columns;
  };
  std::size_t zero = 0;
  std::size_t growing = 0;
  for (std::size_t i = 0; i < set.modes.size(); ++i) {
    const Mode& mode = set.modes[i];
    const Vec6 effective = mode.properties.participation.cwiseAbs2();
    sum += effective;
    zero += mode.is_zero();
    growing += mode.damping() < -1e-8;
    const double mass = mode.properties.modal_mass;
    const std::string damping = set.is_complex ? fmt::format(" {:8.3f}%", percent_of(mode)) : "";
    text += fmt::format("{:>5} {:>13}{} {:>12} {}  {}\n", i + 1, rate_text(mode), damping,
                        mass > 0.0 ? fmt::format("{:.4g} kg", mass) : "-", percent(effective),
                        table.remarks[i]);
  }
  text += fmt::format("{:>5} {:>13}{:>{}} {:>12} {}\n", "sum", "", "", damping_title.size(),
                      fmt::format("{:.4g} kg", set.total[0]), percent(sum));
  text += count_text(zero, "at 0 Hz: rigid-body motions and mechanisms");
  text += count_text(growing, "growing: the state is unstable");
  return text +
         fmt::format("eigensolver: {}, largest residual {:.1e}\n", set.solver, set.worst_residual);
}

}  // namespace

Schema& add_mode_fields(Schema& schema) {
  const ModalSettings defaults;
  return schema
      .add(integer("Modes", "How many modes to find.").between(1, 100'000).optional(defaults.modes))
      .add(number(
               "Near", "Hz",
               "Frequency next to which undamped modes are looked for; the lowest ones if absent.")
               .positive()
               .optional())
      .add(choice("Solver", solver::eigen_solver_names(),
                  "Of the eigenproblem: Spectra for large models on one process; Anasazi for those "
                  "on several, complex modes by Spectra as well; Dense reduces whole matrices, "
                  "best for small ones and to check; Automatic decides.")
               .optional(defaults.solver));
}

Schema& add_modal_fields(Schema& schema) {
  const ModalSettings defaults;
  return add_mode_fields(schema)
      .add(flag("Damping",
                "Count dampers, viscous materials, branches of 'Relaxation' and the gyroscopic "
                "forces "
                "of a rotating frame; modes are complex then.")
               .optional(defaults.damping))
      .list(
          "Rotor",
          Schema("Rotor",
                 "A rotor that turns steadily while the rest stands: the structures that the "
                 "load 'Rotating Frame' names. Frequencies are those of an observer at rest.")
              .add(texts("Blades",
                         "Three or more structures, or node sets for blades of several, with equal "
                         "meshes, evenly spaced about the axis; none if the rotor is symmetric "
                         "about its axis.")
                       .optional()),
          Presence::optional);
}

ModalSettings read_mode_settings(const Options& options) {
  ModalSettings settings;
  settings.modes = options.integer("Modes");
  if (options.has("Near")) settings.near = options.number("Near");
  settings.solver = options.text("Solver");
  return settings;
}

ModalSettings read_modal_settings(const Options& options) {
  ModalSettings settings = read_mode_settings(options);
  settings.damping = options.flag("Damping");
  if (options.has_list("Rotor")) {
    const Options& rotor = options.list("Rotor");
    settings.rotor.emplace();
    settings.rotor->where = rotor.where("Blades");
    if (rotor.has("Blades")) settings.rotor->blades = rotor.texts("Blades");
  }
  return settings;
}

Schema Modal::schema() {
  Schema schema("Modal",
                "Natural frequencies and mode shapes of small vibrations about the present state, "
                "which stays as it is.");
  return add_modal_fields(schema);
}

std::unique_ptr<Inspection> Modal::make(const Options& options) {
  return std::make_unique<Modal>(read_modal_settings(options));
}

AnalysisReport Modal::inspect(Context& context, model::State& state) {
  const Ledger::Scope scope(context.ledger, context.ledger.add("Eigenproblem"));
  ModeSet set = find_modes(context, state, settings_);
  AnalysisReport report;
  report.tables.push_back(make_table(set, context.system.model()));
  report.text = make_text(set, report.tables.back());
  warn_of_shear(context, state, set);
  for (Mode& mode : set.modes) report.shapes.push_back(std::move(mode.shape));
  return report;
}

}  // namespace culm::analysis
