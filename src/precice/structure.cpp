#include "structure.hpp"

#include <utility>

namespace culm::adapter {

Structure::Structure(const std::string& deck, const std::vector<std::string>& overrides,
                     const std::string& analysis, std::string port)
    : port_(std::move(port)) {
  std::vector<const char*> texts;
  for (const std::string& one : overrides) texts.push_back(one.c_str());
  culm_simulation* opened = nullptr;
  const int code = culm_open(CULM_API_VERSION, CULM_WORLD, deck.c_str(), texts.data(),
                             static_cast<int>(texts.size()), &opened);
  simulation_.reset(opened);
  check(code);
  check(culm_begin(opened, analysis.empty() ? nullptr : analysis.c_str()));
  check(culm_port_size(opened, port_.c_str(), &points_));
  reference_.resize(3 * static_cast<std::size_t>(points_));
  check(culm_port_reference(opened, port_.c_str(), reference_.data(), 3 * points_));
}

void Structure::check(int code) const {
  if (code != CULM_OK) throw Failure(culm_error(simulation_.get()), code);
}

std::vector<double> Structure::displacement() const {
  std::vector<double> values(reference_.size());
  check(
      culm_port_read(simulation_.get(), port_.c_str(), CULM_POSITION, values.data(), 3 * points_));
  for (std::size_t i = 0; i < values.size(); ++i) values[i] -= reference_[i];
  return values;
}

double Structure::time() const {
  double time = 0.0;
  check(culm_time(simulation_.get(), &time));
  return time;
}

double Structure::proposal() const {
  double target = 0.0;
  check(culm_proposal(simulation_.get(), &target));
  return target;
}

bool Structure::is_at_end() const {
  int is_at_end = 0;
  check(culm_is_at_end(simulation_.get(), &is_at_end));
  return is_at_end != 0;
}

void Structure::set_loads(const std::vector<double>& forces, const std::vector<double>& moments) {
  check(culm_port_set(simulation_.get(), port_.c_str(), forces.data(),
                      moments.empty() ? nullptr : moments.data(), points_));
}

bool Structure::advance(double target) {
  int converged = 0;
  check(culm_attempt(simulation_.get(), target, &converged));
  if (converged == 0) {
    check(culm_fail(simulation_.get()));
    return false;
  }
  double work = 0.0;
  check(culm_port_exchange(simulation_.get(), port_.c_str(), &work, exchange_.force,
                           exchange_.moment));
  exchange_.work += work;
  check(culm_accept(simulation_.get()));
  return true;
}

void Structure::save() {
  culm_snapshot* snapshot = nullptr;
  check(culm_save(simulation_.get(), &snapshot));
  saved_.reset(snapshot);
  saved_exchange_ = exchange_;
}

void Structure::restore() {
  check(culm_restore(simulation_.get(), saved_.get()));
  exchange_ = saved_exchange_;
}

void Structure::finish() { check(culm_finish(simulation_.get())); }

}  // namespace culm::adapter
