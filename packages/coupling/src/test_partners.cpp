#include <culm/coupling/partner_error.hpp>
#include <culm/coupling/test_partners.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <limits>
#include <random>
#include <span>
#include <thread>

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

FaultyPartner::FaultyPartner(Fault fault, int window, double mass)
    : fault_(fault), window_(window), truth_(make_added_mass(mass), 1, WindowLoad::mean) {}

void FaultyPartner::begin(const Beginning& beginning) {
  port_ = beginning.port;
  old_ = Eigen::VectorXd::Zero(6 * static_cast<Eigen::Index>(beginning.points()));
  truth_.begin(beginning);
}

Eigen::VectorXd FaultyPartner::loads(const Window& window) {
  Eigen::VectorXd loads = truth_.loads(window);
  if (window.number < window_) return loads;
  switch (fault_) {
    case Fault::death:
      throw PartnerError(
          fmt::format("the partner at port '{}' failed in window {}, attempt {}, from "
                      "{:g} s to {:g} s: as the deck wants it",
                      port_, window.number, window.attempt, window.start, window.end));
    case Fault::no_number:
      loads[0] = std::numeric_limits<double>::quiet_NaN();
      break;
    case Fault::infinite:
      loads[0] = std::numeric_limits<double>::infinity();
      break;
    case Fault::wrong_count:
      loads.conservativeResize(loads.size() - 6);
      break;
    case Fault::scaled:
      loads *= 0.5;
      break;
    case Fault::turned:
      loads = -loads;
      break;
    case Fault::old:
      loads = old_;
      break;
    case Fault::slow:
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
      break;
    case Fault::wrong_energy:
    case Fault::infinite_energy:
    case Fault::lost_books:
      break;
  }
  return loads;
}

void FaultyPartner::accept(const Window& window) {
  has_lied_ = window.number >= window_;
  if (!has_lied_) old_ = truth_.loads(window);
  truth_.accept(window);
}

Books FaultyPartner::books() const {
  Books books = truth_.books();
  if (!has_lied_) return books;
  if (fault_ == Fault::wrong_energy) books.energy += 1.0;
  if (fault_ == Fault::infinite_energy) books.energy = std::numeric_limits<double>::infinity();
  if (fault_ == Fault::lost_books) {
    books.energy = books.dissipated = std::numeric_limits<double>::quiet_NaN();
  }
  return books;
}

void FaultyPartner::save(const std::string& prefix, Snapshot& snapshot) {
  truth_.save(prefix, snapshot);
  snapshot.set(prefix + "old", {old_.begin(), old_.end()});
  snapshot.set(prefix + "has lied", has_lied_ ? 1.0 : 0.0);
}

void FaultyPartner::restore(const std::string& prefix, const Snapshot& snapshot) {
  truth_.restore(prefix, snapshot);
  const std::span<const double> old =
      snapshot.numbers(prefix + "old", static_cast<std::size_t>(old_.size()));
  std::copy(old.begin(), old.end(), old_.begin());
  has_lied_ = snapshot.number(prefix + "has lied") != 0.0;
}

}  // namespace culm::coupling
