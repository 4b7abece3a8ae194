#include "coupled_side.hpp"

#include <culm/base/error.hpp>
#include <culm/base/nearest.hpp>
#include <culm/coupling/partner_error.hpp>
#include <culm/coupling/replay.hpp>
#include <culm/output/file_part.hpp>

#include "on_root.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
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

void InterfaceBooks::add(const coupling::Window& window, double done, const coupling::Books& now) {
  const double gained = now.energy - partner.energy + now.dissipated - partner.dissipated;
  work += done;
  exchanged += std::abs(done);
  largest = std::max(largest, std::abs(done));
  partner = now;
  if (!(std::abs(done + gained) > std::abs(worst_gap))) return;
  worst_gap = done + gained;
  worst_start = window.start;
  worst_end = window.end;
}

void InterfaceBooks::save(const std::string& name, Snapshot& snapshot) const {
  snapshot.set(name, {work, exchanged, largest, partner.energy, partner.dissipated, worst_gap,
                      worst_start, worst_end});
}

void InterfaceBooks::restore(const std::string& name, const Snapshot& snapshot) {
  const std::span<const double> kept = snapshot.numbers(name, 8);
  work = kept[0];
  exchanged = kept[1];
  largest = kept[2];
  partner = {kept[3], kept[4]};
  worst_gap = kept[5];
  worst_start = kept[6];
  worst_end = kept[7];
}

void Pace::start(const std::vector<double>& velocity) {
  last_ = as_vector(velocity);
  before_.resize(0);
  last_length_ = length_before_ = 0.0;
}

void Pace::add(const coupling::Window& window) {
  before_ = std::move(last_);
  length_before_ = last_length_;
  last_length_ = window.length();
  last_ = as_vector(window.of(port::Quantity::motion)) / last_length_;
}

VectorXd Pace::guess(double length) const {
  if (before_.size() == 0) return last_;
  return last_ + (length + last_length_) / (last_length_ + length_before_) * (last_ - before_);
}

void Pace::save(const std::string& prefix, Snapshot& snapshot) const {
  snapshot.set(prefix + "pace/lengths", {last_length_, length_before_});
  snapshot.set(prefix + "pace/last", {last_.begin(), last_.end()});
  snapshot.set(prefix + "pace/before", {before_.begin(), before_.end()});
}

void Pace::restore(const std::string& prefix, const Snapshot& snapshot) {
  const std::span<const double> lengths = snapshot.numbers(prefix + "pace/lengths", 2);
  last_length_ = lengths[0];
  length_before_ = lengths[1];
  last_ = as_vector(snapshot.numbers(prefix + "pace/last"));
  before_ = as_vector(snapshot.numbers(prefix + "pace/before"));
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

void CoupledSide::expect(const std::string& objection, const coupling::Window& about) const {
  if (objection.empty()) return;
  throw PartnerError(fmt::format(
      "the partner '{}' at port '{}' failed in window {}, attempt {}, from {:g} s to {:g} s: {}",
      name, port_name, about.number, about.attempt, about.start, about.end, objection));
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
