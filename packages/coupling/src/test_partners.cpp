#include <culm/coupling/partner_error.hpp>
#include <culm/coupling/test_partners.hpp>

#include <fmt/format.h>

#include <limits>
#include <random>

namespace culm::coupling {

using port::Quantity;

Eigen::VectorXd RandomPartner::loads(const Window& window) {
  std::seed_seq seeds{static_cast<std::uint32_t>(seed_), static_cast<std::uint32_t>(seed_ >> 32U),
                      static_cast<std::uint32_t>(window.number)};
  std::mt19937_64 generator(seeds);
  Eigen::VectorXd loads =
      Eigen::VectorXd::Zero(static_cast<Eigen::Index>(window.of(Quantity::motion).size()));
  for (Eigen::Index i = 0; i < loads.size(); ++i) {
    if (i % 6 >= 3) continue;
    // by hand: the distributions of the library are not the same everywhere
    const double unit = static_cast<double>(generator() >> 11U) * 0x1p-53;
    loads[i] = force_ * (2.0 * unit - 1.0);
  }
  return loads;
}

void RandomPartner::accept(const Window& window) {
  for (std::size_t i = 0; i < window.loads.size(); ++i) {
    given_ += window.loads[i] * window.of(Quantity::motion)[i];
  }
}

void RandomPartner::save(const std::string& prefix, Snapshot& snapshot) {
  snapshot.set(prefix + "given", given_);
}

void RandomPartner::restore(const std::string& prefix, const Snapshot& snapshot) {
  given_ = snapshot.number(prefix + "given");
}

Eigen::VectorXd FaultyPartner::loads(const Window& window) {
  Eigen::VectorXd loads =
      Eigen::VectorXd::Zero(static_cast<Eigen::Index>(window.of(Quantity::motion).size()));
  if (window.number < window_) return loads;
  if (fault_ == Fault::death) {
    throw PartnerError(
        fmt::format("the partner at port '{}' failed in window {}, attempt {}, from "
                    "{:g} s to {:g} s: as the deck wants it",
                    port_, window.number, window.attempt, window.start, window.end));
  }
  if (fault_ == Fault::no_number) loads[0] = std::numeric_limits<double>::quiet_NaN();
  if (fault_ == Fault::wrong_count) loads.conservativeResize(loads.size() - 6);
  return loads;
}

void FaultyPartner::accept(const Window& window) {
  if (fault_ == Fault::wrong_energy && window.number >= window_) books_.energy = 1.0;
}

}  // namespace culm::coupling
