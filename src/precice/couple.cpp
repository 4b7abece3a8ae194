#include "couple.hpp"

#include "structure.hpp"

#include <precice/precice.hpp>

#include <fstream>
#include <iostream>
#include <limits>
#include <sstream>

namespace culm::adapter {
namespace {

// Of a time window: shorter steps are rounding, or a structure without equilibrium.
constexpr double shortest = 1e-6;

// The mesh of the participant: one vertex per point of the port.
class Interface {
 public:
  Interface(precice::Participant& participant, const Settings& settings,
            const std::vector<double>& vertices)
      : participant_(participant),
        settings_(settings),
        vertices_(vertices.size() / 3),
        force_(vertices.size()),
        moment_(settings.moment.empty() ? 0 : vertices.size()) {
    require_three(participant.getMeshDimensions(settings.mesh), "mesh '" + settings.mesh + "'");
    for (const std::string& data : {settings.displacement, settings.force, settings.moment}) {
      if (data.empty()) continue;
      require_three(participant.getDataDimensions(settings.mesh, data), "data '" + data + "'");
    }
    participant.setMeshVertices(settings.mesh, vertices, vertices_);
  }

  void write(const std::vector<double>& displacement) {
    participant_.writeData(settings_.mesh, settings_.displacement, vertices_, displacement);
  }

  // Loads of a step of this length, which begins where preCICE stands. A load of culm is the mean
  // over the step, which for loads that are linear in time is that in its middle. Read at the end
  // of the step it would be of first order, and would feed or take energy in every vibration.
  void read(double length) {
    participant_.readData(settings_.mesh, settings_.force, vertices_, 0.5 * length, force_);
    if (moment_.empty()) return;
    participant_.readData(settings_.mesh, settings_.moment, vertices_, 0.5 * length, moment_);
  }
  const std::vector<double>& force() const { return force_; }
  const std::vector<double>& moment() const { return moment_; }

 private:
  static void require_three(int found, const std::string& what) {
    if (found == 3) return;
    throw Failure(what + " of preCICE has " + std::to_string(found) +
                      " dimensions; culm moves in space, with 3",
                  CULM_INPUT);
  }

  precice::Participant& participant_;
  const Settings& settings_;
  std::vector<precice::VertexID> vertices_;
  std::vector<double> force_, moment_;
};

// What was exchanged, one row per time window.
class Table {
 public:
  explicit Table(const std::string& path) {
    if (path.empty()) return;
    file_.open(path);
    if (!file_) throw Failure("cannot write '" + path + "'", CULM_FILE);
    file_.precision(std::numeric_limits<double>::max_digits10);
    file_ << "time,work [J],fx [N],fy [N],fz [N],mx [N m],my [N m],mz [N m]\n" << std::flush;
  }
  void write(double time, const Exchange& exchange) {
    if (!file_.is_open()) return;
    file_ << time << ',' << exchange.work;
    for (const double value : exchange.force) file_ << ',' << value;
    for (const double value : exchange.moment) file_ << ',' << value;
    file_ << '\n' << std::flush;
  }

 private:
  std::ofstream file_;
};

std::string seconds(double time) {
  std::ostringstream text;
  text << time << " s";
  return text.str();
}

// Makes a step to the end of the time window, or less where the structure wants less. Returns its
// length.
double make_step(Structure& structure, Interface& interface, double longest) {
  const double start = structure.time();
  if (structure.is_at_end()) {
    throw Failure("the analysis ends at " + seconds(start) +
                      ", and preCICE goes on: 'End Time' must not be before its 'max-time'",
                  CULM_INPUT);
  }
  while (true) {
    double length = structure.proposal() - start;
    if (length > (1.0 - shortest) * longest) length = longest;
    if (length < shortest * longest) {
      throw Failure(
          "culm finds no equilibrium from " + seconds(start) + " on, however small the step",
          CULM_NUMERICAL);
    }
    interface.read(length);
    structure.set_loads(interface.force(), interface.moment());
    if (structure.advance(start + length)) return length;
  }
}

}  // namespace

void couple(const Settings& settings) {
  Structure structure(settings.deck, settings.overrides, settings.analysis, settings.port);
  std::cout << structure.messages() << std::flush;
  Table table(settings.table);
  precice::Participant participant(settings.participant, settings.configuration, 0, 1);
  Interface interface(participant, settings, structure.reference());
  if (participant.requiresInitialData()) interface.write(structure.displacement());
  participant.initialize();
  while (participant.isCouplingOngoing()) {
    if (participant.requiresWritingCheckpoint()) structure.save();
    const double length = make_step(structure, interface, participant.getMaxTimeStepSize());
    interface.write(structure.displacement());
    participant.advance(length);
    if (participant.requiresReadingCheckpoint()) {
      structure.restore();
    } else if (participant.isTimeWindowComplete()) {
      table.write(structure.time(), structure.exchange());
    }
  }
  participant.finalize();
  structure.finish();
  std::cout << structure.messages() << "work of port '" << settings.port
            << "': " << structure.exchange().work << " J\n";
}

}  // namespace culm::adapter
