// A participant of preCICE that has a mass at each vertex of the structure's mesh. Where the
// library is, the adapter is tested with it; usage: fluid CONFIGURATION MASS RECORD

#include <culm/coupling/point_partner.hpp>

#include <precice/precice.hpp>

#include <fstream>
#include <string>
#include <vector>

namespace {

using Eigen::VectorXd;

const std::string mesh = "Structure-Mesh";

}  // namespace

int main(int, char** argv) {
  const auto partner = culm::coupling::make_added_mass(std::stod(argv[2]));
  precice::Participant participant("Fluid", argv[1], 0, 1);
  const std::vector<double> everywhere = {-100.0, 100.0, -100.0, 100.0, -100.0, 100.0};
  participant.setMeshAccessRegion(mesh, everywhere);
  participant.initialize();
  std::vector<precice::VertexID> ids(static_cast<std::size_t>(participant.getMeshVertexSize(mesh)));
  std::vector<double> values(3 * ids.size());
  participant.getMeshVertexIDsAndCoordinates(mesh, ids, values);

  const auto size = static_cast<Eigen::Index>(values.size());
  VectorXd start = VectorXd::Zero(size), end = start;
  partner->begin(start, start);
  while (participant.isCouplingOngoing()) {
    participant.requiresWritingCheckpoint();  // `partner` and `start` stay at the window's start
    const double window = participant.getMaxTimeStepSize();
    participant.readData(mesh, "Displacement", ids, window, values);
    end = Eigen::Map<const VectorXd>(values.data(), size);
    const VectorXd force = partner->forces(end - start, window);
    participant.writeData(mesh, "Force", ids, {force.data(), values.size()});
    participant.advance(window);
    if (participant.requiresReadingCheckpoint()) continue;
    partner->accept(end - start, window);
    start = end;
  }
  std::ofstream record(argv[3]);
  record.precision(17);
  record << partner->books().energy << '\n' << end << '\n';
}
