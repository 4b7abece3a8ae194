#include <culm/analysis/unknown_names.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace culm::analysis {
namespace {

using assembly::Vector;

const char* coordinate_name(int i) {
  constexpr const char* names[] = {"x",    "y",    "z",    "d1 x", "d1 y", "d1 z",
                                   "d2 x", "d2 y", "d2 z", "d3 x", "d3 y", "d3 z"};
  return names[i];
}

}  // namespace

const char* direction_name(int i) {
  constexpr const char* names[] = {"x", "y", "z", "rotation x", "rotation y", "rotation z"};
  return names[i];
}

std::string quoted_name(const model::Constraint& constraint) {
  return fmt::format("{} '{}'", constraint.type, constraint.name);
}

UnknownNames::Place UnknownNames::place_of(int unknown) const {
  const model::UnknownTable& unknowns = system_.model().unknowns();
  const model::Block block = unknowns.block(unknowns.block_of(unknown));
  const int place = unknown - block.first;
  int written = 0;
  while (block.shape.position[static_cast<std::size_t>(written)] != place) ++written;
  return {block, written};
}

std::string UnknownNames::name_of(int unknown) const {
  const model::Model& model = system_.model();
  const auto [block, written] = place_of(unknown);
  if (block.kind == model::BlockKind::multipliers) {
    const model::Constraint& c = model.equations()[static_cast<std::size_t>(block.owner)];
    return fmt::format("{}, equation {}", quoted_name(c), written + 1);
  }
  if (block.kind == model::BlockKind::own) {
    const model::OwnBlock& own = model.own_blocks()[static_cast<std::size_t>(block.owner)];
    return fmt::format("{}, {}", own.name, own.unknowns[static_cast<std::size_t>(written)].name);
  }
  const bool null_space = model.unknowns().form() == model::Form::null_space;
  return fmt::format("{}, {}", model.node_name(block.owner),
                     null_space ? direction_name(written) : coordinate_name(written));
}

std::vector<UnknownNames::Entry> UnknownNames::largest_entries(const Vector& vector,
                                                               std::size_t count) const {
  const auto values = vector.values();
  std::vector<std::size_t> order(values.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  const std::size_t kept = std::min(count, order.size());
  const auto larger = [&](std::size_t a, std::size_t b) {
    return std::abs(values[a]) > std::abs(values[b]);
  };
  std::partial_sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(kept), order.end(),
                    larger);
  std::vector<long long> mine;
  std::vector<double> sizes;
  for (std::size_t i = 0; i < kept; ++i) {
    mine.push_back(vector.rows().global(order[i]));
    sizes.push_back(values[order[i]]);
  }
  const auto& comm = system_.comm();
  const auto unknowns = comm.gather(std::span<const long long>(mine));
  const auto all = comm.gather(std::span<const double>(sizes));
  std::vector<std::pair<double, int>> sorted;
  for (std::size_t i = 0; i < all.size(); ++i) {
    sorted.emplace_back(all[i], static_cast<int>(unknowns[i]));
  }
  std::sort(sorted.begin(), sorted.end(),
            [](const auto& a, const auto& b) { return std::abs(a.first) > std::abs(b.first); });
  std::vector<Entry> entries;
  for (std::size_t i = 0; i < std::min(count, sorted.size()); ++i) {
    entries.push_back({name_of(sorted[i].second), sorted[i].first});
  }
  return entries;
}

std::map<int, double> UnknownNames::entries(const Vector& v, double least) const {
  const parallel::Comm& comm = system_.comm();
  const auto values = v.values();
  std::vector<long long> mine;
  std::vector<double> sizes;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (std::abs(values[i]) < least) continue;
    mine.push_back(v.rows().global(i));
    sizes.push_back(values[i]);
  }
  const auto unknowns = comm.gather(std::span<const long long>(mine));
  const auto all = comm.gather(std::span<const double>(sizes));
  std::map<int, double> entries;
  for (std::size_t i = 0; i < all.size(); ++i) entries[static_cast<int>(unknowns[i])] = all[i];
  return entries;
}

}  // namespace culm::analysis
