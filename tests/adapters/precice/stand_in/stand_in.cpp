#include <culm/coupling/point_partner.hpp>
#include <culm/coupling/scheme.hpp>

#include <precice/precice.hpp>

#include <cmath>
#include <fstream>
#include <map>
#include <string>
#include <utility>

namespace precice {

using Eigen::VectorXd;

namespace {

constexpr double tolerance = 1e-11;  // of forces in a time window
constexpr double rounding = 5e-14;   // of places, 16 units of the last digit of 10 m [m]
constexpr int most = 100;            // iterations

void require(bool holds, const std::string& what) {
  if (!holds) throw Error(what);
}

}  // namespace

struct Participant::Coupling {
  explicit Coupling(const std::string& path) {
    std::ifstream file(path);
    require(file.is_open(), "cannot read '" + path + "'");
    for (std::string name, value; file >> name >> value;) words[name] = value;
    partner = culm::coupling::make_added_mass(number("mass"));
    window = number("window");
  }

  double number(const std::string& name) const { return std::stod(words.at(name)); }

  // How much the forces of a mass change with its motion in a window [N/m].
  double stiffness() const { return 2.0 * number("mass") / (window * window); }

  // Mean loads of the time window from those at its ends.
  VectorXd loads_at(double time) const {
    if (number("waveform") == 0.0) return end_loads;
    return start_loads + (done + time) / window * (end_loads - start_loads);
  }

  // The answer of the partner as loads at the end of the window.
  VectorXd answer() const {
    const VectorXd mean = partner->forces(displacement - start, window);
    return number("waveform") == 0.0 ? mean : VectorXd(2.0 * mean - start_loads);
  }

  void end_iteration() {
    require(windows + 1 != number("ends-at"), "the participant 'Fluid' has left");
    const VectorXd next = answer();
    require(++iterations < most, "the coupling does not converge");
    require(!next.hasNaN(), "displacements are no numbers");
    const double allowed =
        tolerance * next.norm() + rounding * stiffness() * std::sqrt(next.size());
    is_complete = (next - end_loads).norm() <= allowed;
    if (!is_complete) {
      end_loads = scheme->next(end_loads, next);
      return;
    }
    scheme->end_window();
    partner->accept(displacement - start, window);
    start = displacement;
    start_loads = end_loads;
    iterations = 0;
    ++windows;
  }

  void record() const {
    std::ofstream file(words.at("record"));
    file.precision(17);
    file << partner->books().energy << '\n' << displacement << '\n';
  }

  std::map<std::string, std::string> words;
  std::unique_ptr<culm::coupling::PointModel> partner;
  std::unique_ptr<culm::coupling::Scheme> scheme =
      std::make_unique<culm::coupling::QuasiNewton>(0.05, 8, 1e-2);
  VectorXd displacement, start;     // now, and at the start of the window
  VectorXd start_loads, end_loads;  // of the window, as they are known
  double window = 0.0, done = 0.0;  // length, and how much of it has been stepped through [s]
  int windows = 0, iterations = 0;
  bool is_complete = true;  // the last window, so that a new one begins
  bool wants_saving = false, wants_restoring = false;
};

Participant::Participant(std::string_view, std::string_view configuration, int, int)
    : coupling_(std::make_unique<Coupling>(std::string(configuration))) {}
Participant::~Participant() = default;

int Participant::getMeshDimensions(std::string_view mesh) const {
  require(mesh == "Structure-Mesh", "there is no mesh '" + std::string(mesh) + "'");
  return static_cast<int>(coupling_->number("dimensions"));
}

int Participant::getDataDimensions(std::string_view, std::string_view data) const {
  require(data == "Displacement" || data == "Force" || data == "Moment",
          "there is no data '" + std::string(data) + "'");
  return static_cast<int>(coupling_->number("dimensions"));
}

void Participant::setMeshVertices(std::string_view, std::span<const double> coordinates,
                                  std::span<VertexID> ids) {
  const auto size = static_cast<Eigen::Index>(coordinates.size());
  require(coordinates.size() == 3 * ids.size(), "three coordinates belong to a vertex");
  for (std::size_t i = 0; i < ids.size(); ++i) ids[i] = static_cast<VertexID>(i);
  coupling_->displacement = coupling_->start = VectorXd::Zero(size);
  coupling_->start_loads = coupling_->end_loads = VectorXd::Zero(size);
  coupling_->partner->begin(VectorXd::Zero(size), VectorXd::Zero(size));
}

bool Participant::requiresInitialData() { return true; }

void Participant::initialize() {
  coupling_->start = coupling_->displacement;
  coupling_->wants_saving = true;
}

bool Participant::isCouplingOngoing() const {
  return coupling_->windows < coupling_->number("windows");
}

bool Participant::isTimeWindowComplete() const { return coupling_->is_complete; }

double Participant::getMaxTimeStepSize() const { return coupling_->window - coupling_->done; }

bool Participant::requiresWritingCheckpoint() {
  return std::exchange(coupling_->wants_saving, false);
}

bool Participant::requiresReadingCheckpoint() {
  return std::exchange(coupling_->wants_restoring, false);
}

void Participant::readData(std::string_view, std::string_view data, std::span<const VertexID>,
                           double time, std::span<double> values) const {
  require(time >= 0.0 && time <= getMaxTimeStepSize(), "loads are read outside of the window");
  Eigen::Map<VectorXd> read(values.data(), static_cast<Eigen::Index>(values.size()));
  if (data == "Force") {
    read = coupling_->loads_at(time);
  } else {
    read.setZero();
  }
}

void Participant::writeData(std::string_view, std::string_view, std::span<const VertexID>,
                            std::span<const double> values) {
  coupling_->displacement =
      Eigen::Map<const VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

void Participant::advance(double length) {
  Coupling& coupling = *coupling_;
  require(length > 0.0 && length <= getMaxTimeStepSize(), "the step leaves the window");
  coupling.is_complete = false;
  if (length < getMaxTimeStepSize()) {
    coupling.done += length;
    return;
  }
  coupling.done = 0.0;
  coupling.end_iteration();
  (coupling.is_complete ? coupling.wants_saving : coupling.wants_restoring) = true;
}

void Participant::finalize() { coupling_->record(); }

}  // namespace precice
