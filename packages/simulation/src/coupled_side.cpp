#include "coupled_side.hpp"

#include <culm/base/error.hpp>
#include <culm/base/nearest.hpp>
#include <culm/coupling/record.hpp>
#include <culm/output/file_part.hpp>

#include "on_root.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace culm::simulation {

using Eigen::VectorXd;

double size_of(const std::vector<double>& points) {
  const Eigen::Map<const Eigen::Matrix3Xd> x(points.data(), 3,
                                             static_cast<Eigen::Index>(points.size() / 3));
  const Vec3 centre = x.rowwise().mean();
  const double size =
      std::sqrt((x.colwise() - centre).squaredNorm() / static_cast<double>(x.cols()));
  return size > 0.0 ? size : 1.0;
}

void set_loads(port::Port& port, const VectorXd& loads) {
  const Eigen::Matrix<double, 6, Eigen::Dynamic> table = loads.reshaped(6, loads.size() / 6);
  const VectorXd forces = table.topRows<3>().reshaped();
  const VectorXd moments = table.bottomRows<3>().reshaped();
  port.set_loads({forces.data(), static_cast<std::size_t>(forces.size())},
                 {moments.data(), static_cast<std::size_t>(moments.size())});
}

VectorXd CoupledSide::loads(const VectorXd& all) const {
  VectorXd own = all.segment(first, count());
  own.reshaped(6, count() / 6).bottomRows<3>() *= size;
  return own;
}

void CoupledSide::put(VectorXd own, VectorXd& all) const {
  own.reshaped(6, count() / 6).bottomRows<3>() /= size;
  all.segment(first, count()) = own;
}

void CoupledSide::set(const VectorXd& all) const { set_loads(*port, loads(all)); }

namespace {

// The port that an entry of "Partners" names, or the only one.
const port::Port& find_port(const Options& entry, const Ports& ports) {
  std::vector<std::string> names;
  for (const auto& port : ports) names.push_back(port->name());
  if (!entry.has("Port")) {
    if (ports.size() == 1) return *ports.front();
    throw InputError(entry.where(),
                     ports.empty() ? "needs a port, and the deck has none"
                                   : "needs 'Port': the deck has " + std::to_string(ports.size()));
  }
  const std::string& name = entry.text("Port");
  const auto port = std::find_if(ports.begin(), ports.end(),
                                 [&](const auto& one) { return one->name() == name; });
  if (port != ports.end()) return **port;
  throw InputError(entry.where("Port"),
                   "there is no port '" + name + "'" + did_you_mean(name, names));
}

std::filesystem::path record_in(const std::filesystem::path& folder, const std::string& partner) {
  return folder / ("coupling_" + output::file_part(partner) + ".record");
}

std::unique_ptr<coupling::Partner> replay(const std::filesystem::path& records,
                                          const std::string& partner, std::size_t partners) {
  const bool is_folder = std::filesystem::is_directory(records);
  if (!is_folder && partners > 1) {
    throw UsageError(fmt::format(
        "{}: the deck has {} partners; its replay needs the folder with the records of all of them",
        records.string(), partners));
  }
  const std::filesystem::path file = is_folder ? record_in(records, partner) : records;
  return std::make_unique<coupling::ReplayedPartner>(coupling::read_record(file), file.string());
}

}  // namespace

std::vector<CoupledSide> make_sides(const Options& settings, const coupling::PartnerRegistry& known,
                                    const CoupledFiles& files, const Ports& ports,
                                    const parallel::Comm& comm) {
  const std::vector<Options>& partners = settings.list("Partners").entries();
  const bool is_replay = !files.replay.empty();
  if (partners.empty()) {
    throw InputError(settings.list("Partners").where(), "must hold at least one partner");
  }
  std::vector<CoupledSide> sides;
  for (const Options& entry : partners) {
    const port::Port& port = find_port(entry, ports);
    const bool is_taken = std::any_of(sides.begin(), sides.end(), [&](const CoupledSide& side) {
      return side.port_name == port.name();
    });
    if (is_taken) {
      throw InputError(entry.where(), "port '" + port.name() + "' has a partner already");
    }
    CoupledSide side;
    side.name = entry.name();
    side.port_name = port.name();
    std::string objection;
    on_root(comm, [&] {
      if (is_replay) {
        side.partner = replay(files.replay, side.name, partners.size());
        return;
      }
      side.partner = known.make(entry.text("Type"), entry);
      objection = side.partner->objection(port.reference());
      if (!settings.flag("Record")) return;
      side.partner = std::make_unique<coupling::RecordedPartner>(
          std::move(side.partner), record_in(files.folder, side.name));
    });
    if (comm.size() > 1) objection = comm.broadcast(objection);
    if (!objection.empty()) throw InputError(entry.where(), objection);
    sides.push_back(std::move(side));
  }
  return sides;
}

}  // namespace culm::simulation
