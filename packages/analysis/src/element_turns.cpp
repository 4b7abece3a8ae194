#include <culm/analysis/element_turns.hpp>
#include <culm/base/error.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <utility>

namespace culm::analysis {
namespace {

// Elements within this share of the largest turn count as turned by as much.
constexpr double same = 1e-6;
// An element that has come so near to its greatest moment may be what ends a path.
constexpr double near_its_limit = 0.8;
constexpr double good_error = 0.01;  // of the strain energy, what a cure aims at

std::string percent(double share) { return fmt::format("{:.3g} %", 100.0 * share); }

// Number in the deck of a cell.
int deck_number(const model::Structure& structure, int cell) {
  const auto& numbers = structure.deck.cells;
  const auto of = std::find_if(numbers.begin(), numbers.end(), [&](const std::vector<int>& parts) {
    return std::find(parts.begin(), parts.end(), cell) != parts.end();
  });
  return of == numbers.end() ? cell : static_cast<int>(of - numbers.begin());
}

const model::TurnSource* turns_of(const model::Cell& cell) {
  return dynamic_cast<const model::TurnSource*>(cell.source);
}

// Structure and cell of an item.
std::pair<const model::Structure*, int> place_of(const model::TurnSource& turns, int item,
                                                 const std::deque<model::Structure>& structures) {
  for (const model::Structure& structure : structures) {
    int number = 0;
    for (const model::Cell& cell : structure.cells) {
      if (cell.item == item && turns_of(cell) == &turns) return {&structure, number};
      ++number;
    }
  }
  internal_check(false, "every element belongs to a structure");
  return {};
}

}  // namespace

void ElementTurn::save(Snapshot& snapshot) const {
  snapshot.set("turn", {share, turn, reference, static_cast<double>(kind.order),
                        kind.of_frame ? 1.0 : 0.0, static_cast<double>(element)});
  snapshot.set_text("turn/structure", structure);
  snapshot.set_text("turn/place", place);
}

void ElementTurn::restore(const Snapshot& snapshot) {
  const std::span<const double> numbers = snapshot.numbers("turn", 6);
  *this = {numbers[0],
           numbers[1],
           numbers[2],
           {static_cast<int>(numbers[3]), numbers[4] != 0.0},
           snapshot.text("turn/structure"),
           static_cast<int>(numbers[5]),
           snapshot.text("turn/place")};
}

model::TurnErrors ElementTurn::errors() const {
  return model::TurnLaw(kind.order).errors(turn, reference);
}

bool ElementTurn::may_be_the_limit() const {
  return share > 1.0 && turn > near_its_limit * model::TurnLaw(kind.order).greatest_moment();
}

std::string ElementTurn::name() const {
  if (kind.of_frame) {
    return fmt::format(
        "element {} of '{}', of fidelity 'Linear', is turned by {:.3g} rad against "
        "the first node",
        element, structure, turn);
  }
  return fmt::format("element {} of '{}', of order {}, is turned by {:.3g} rad between its ends",
                     element, structure, kind.order, turn);
}

bool ElementTurn::is_meaningless() const {
  return turn >= model::TurnLaw(kind.order).greatest_moment();
}

std::string ElementTurn::consequence() const {
  if (is_meaningless()) {
    return fmt::format("beyond {:.3g} rad its moment falls, and results mean nothing",
                       model::TurnLaw(kind.order).greatest_moment());
  }
  const model::TurnErrors e = errors();
  std::string text =
      fmt::format("its strain energy under a given load is {} too high", percent(e.energy));
  if (std::abs(turn - reference) < 0.1 * turn) return text;
  return text + fmt::format(
                    ", its moment for this turn {} and its stiffness against further turns "
                    "{} too low",
                    percent(e.moment), percent(e.stiffness));
}

std::string ElementTurn::cure() const {
  if (kind.of_frame) return "'Fidelity' = Full, which is good for any turn";
  const model::TurnLaw law(kind.order);
  const std::string more = fmt::format("{:.2g} times as many 'Elements' ({})",
                                       turn / law.turn_with(good_error), percent(good_error));
  if (kind.order > 1) return more;
  const model::TurnLaw higher(2);
  const double factor = turn / higher.turn_with(good_error);
  if (factor > 1.0) {
    return fmt::format("'Order' = 2 and {:.2g} times as many 'Elements' ({})", factor,
                       percent(good_error));
  }
  return fmt::format("'Order' = 2 ({} with as many elements), or {}",
                     percent(higher.errors(turn, reference).energy), more);
}

std::string ElementTurn::warning() const {
  return fmt::format("{} {}: {}; take {}", name(), place, consequence(), cure());
}

ElementTurns::ElementTurns(const assembly::System& system) : system_(system) {
  for (const model::Structure& structure : system.model().structures()) {
    for (const model::Cell& cell : structure.cells) {
      const model::TurnSource* const turns = turns_of(cell);
      if (turns == nullptr || !turns->turn_kind()) continue;
      auto of = std::ranges::find(sources_, turns, &Source::turns);
      if (of == sources_.end()) {
        const model::TurnLaw law(turns->turn_kind()->order);
        of = sources_.insert(of, {turns, law.turn_with(worth_a_warning), 0});
      }
      of->items = std::max(of->items, cell.item + 1);
    }
  }
}

double ElementTurns::largest_share(const model::Coordinates& q) const {
  if (sources_.empty()) return 0.0;
  double share = 0.0;
  for (const Source& source : sources_) {
    share = std::max(share, source.turns->largest_turn(q) / source.good_for);
  }
  return system_.comm().max(share);
}

ElementTurn ElementTurns::find(const model::Coordinates& q, double share) const {
  // number of the element in the order of all sources, and what is known of it on its owner
  const int all = std::numeric_limits<int>::max();
  int first = all;
  int before = 0;
  for (const Source& source : sources_) {
    const int item = source.turns->first_turned(q, (1.0 - same) * share * source.good_for);
    if (item >= 0) first = std::min(first, before + item);
    before += source.items;
  }
  first = -system_.comm().max(-first);
  ElementTurn found;
  for (const Source& source : sources_) {
    if (first >= source.items) {
      first -= source.items;
      continue;
    }
    const auto [structure, cell] = place_of(*source.turns, first, system_.model().structures());
    const auto& reference = system_.model().nodes().reference();
    const double turn = source.turns->owns(first) ? source.turns->turn_of(first, reference) : 0.0;
    found = {share,
             share * source.good_for,
             system_.comm().max(turn),
             *source.turns->turn_kind(),
             structure->name,
             deck_number(*structure, cell),
             {}};
    break;
  }
  return found;
}

}  // namespace culm::analysis
