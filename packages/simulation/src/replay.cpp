#include <culm/base/error.hpp>
#include <culm/base/findings.hpp>
#include <culm/coupling/remote_partner.hpp>
#include <culm/coupling/replay.hpp>
#include <culm/simulation/replay.hpp>

#include "mpi_partner.hpp"
#include "on_root.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <string_view>

namespace culm::simulation {
namespace {

using Path = std::filesystem::path;

constexpr std::string_view prefix = "coupling_";

// Of one partner each.
std::vector<Path> find_records(const Path& records) {
  if (!std::filesystem::is_directory(records)) return {records};
  std::vector<Path> found;
  for (const auto& entry : std::filesystem::directory_iterator(records)) {
    const Path& file = entry.path();
    const bool is_record =
        file.extension() == ".record" && file.filename().string().starts_with(prefix);
    if (is_record) found.push_back(file);
  }
  if (found.empty()) throw FileError(records.string(), "holds no record of a coupling");
  std::sort(found.begin(), found.end());
  return found;
}

// As the partner had it when the record was made.
std::string partner_of(const Path& record) {
  const std::string stem = record.stem().string();
  return stem.starts_with(prefix) ? stem.substr(prefix.size()) : stem;
}

std::vector<std::string> settings_of(const Path& records) {
  std::vector<std::string> settings;
  double window = 0.0;
  for (const Path& file : find_records(records)) {
    const coupling::Record record = coupling::read_record(file);
    const std::string partner = "Coupling/Partners/" + partner_of(file) + "/";
    settings.push_back(partner + "Type=Recorded");
    settings.push_back(partner + "File Name=" + std::filesystem::absolute(file).string());
    settings.push_back(partner + "Port=" + record.beginning.port);
    for (const coupling::RecordedWindow& one : record.windows) {
      if (one.accepted.steps.size() > 1) window = std::max(window, one.accepted.length());
    }
  }
  if (window > 0.0) settings.push_back(fmt::format("Coupling/Window={:.17g}", window));
  return settings;
}

}  // namespace

std::vector<std::string> replay_settings(const parallel::Comm& comm, const Catalogue& catalogue,
                                         const DeckSource& source, const Path& records) {
  if (read_deck(catalogue, source).has_list("Coupling")) return {};
  std::vector<std::string> settings;
  on_root(comm, [&] { settings = settings_of(records); });
  if (comm.size() == 1) return settings;
  double count = static_cast<double>(settings.size());
  comm.broadcast({&count, 1});
  settings.resize(static_cast<std::size_t>(count));
  for (std::string& one : settings) one = comm.broadcast(one);
  return settings;
}

std::string replay_to_partner(const parallel::Comm& comm, const Path& record,
                              const std::string& address, double patience) {
  std::string found, objection;
  on_root(comm, [&] {
    const coupling::Record then = coupling::read_record(record);
    coupling::RemotePartner partner([&] { return open_channel(address, patience); }, patience,
                                    std::numeric_limits<double>::infinity());
    coupling::PartnerReplay now;
    try {
      now = coupling::replay(then, partner);
    } catch (const Error& error) {
      partner.end(error.what());
      throw;
    }
    partner.end("");
    found = fmt::format("{}: {} windows, {} attempts, {} answered with the same bits",
                        record.string(), now.windows, now.attempts, now.equal);
    if (now.loads > coupling::replay_rounding) {
      objection = fmt::format(
          "{}; the partner answers differently, in window {}, attempt {} by {:.2g} of its loads",
          found, now.window, now.attempt, now.loads);
    } else if (now.energy > coupling::replay_rounding) {
      objection = fmt::format("{}; the partner keeps other books, by {:.2g} of its energy", found,
                              now.energy);
    }
  });
  if (comm.size() > 1) {
    found = comm.broadcast(found);
    objection = comm.broadcast(objection);
  }
  if (!objection.empty()) throw PromiseBroken(objection);
  return found;
}

}  // namespace culm::simulation
