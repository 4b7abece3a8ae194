#include <culm/mechanics/relaxation.hpp>

#include <cmath>
#include <cstddef>
#include <string>

namespace culm {

// With x = step / time: kept = exp(-x), gained = (1 - kept) / x, mean_gained = (1 - gained) / x.
MaxwellStep MaxwellStep::of(double step, double time) {
  const double x = step / time;
  MaxwellStep s;
  s.kept = std::exp(-x);
  s.gained = -std::expm1(-x) / x;
  s.mean_kept = s.gained;
  // below, the difference would lose more digits than the series has terms left out
  constexpr double small = 0.02;
  s.mean_gained = x > small ? (1.0 - s.gained) / x
                            : 1.0 / 2.0 - x / 6.0 + x * x / 24.0 - x * x * x / 120.0 +
                                  x * x * x * x / 720.0 - x * x * x * x * x / 5040.0;
  return s;
}

Schema relaxation_schema(int strains) {
  const std::string values = strains == 1 ? "one value" : "one value or " + std::to_string(strains);
  Schema branch("Branch", "A spring and a dashpot in line, beside the lasting stiffness.");
  branch.add(number("Time", "s", "Relaxation time.").positive())
      .add(numbers("Ratios", "1",
                   "Stiffness of its spring over the lasting one: " + values +
                       (strains == 1 ? "." : ", by strain."))
               .non_negative())
      .check([strains, values](const Options& options, InputIssues& issues) {
        const std::size_t count = options.numbers("Ratios").size();
        if (count == 1 || count == static_cast<std::size_t>(strains)) return;
        issues.add(options.where("Ratios"),
                   "must have " + values + ", got " + std::to_string(count));
      });
  return Schema("Relaxation",
                "Viscoelasticity in dynamics: branches by name that relax, on top of the lasting "
                "stiffness, which alone acts in statics.")
      .entries(std::move(branch));
}

std::vector<MaxwellBranch> read_relaxation(const Options& list, int strains) {
  std::vector<MaxwellBranch> branches;
  for (const Options& entry : list.entries()) {
    std::vector<double> ratios = entry.numbers("Ratios");
    if (ratios.size() == 1) ratios.assign(static_cast<std::size_t>(strains), ratios.front());
    branches.push_back({entry.number("Time"), std::move(ratios)});
  }
  return branches;
}

}  // namespace culm
