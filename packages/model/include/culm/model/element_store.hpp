/// The elements of a batch: which nodes all of them have, and those that a rank evaluates.
#pragma once

#include <culm/base/error.hpp>
#include <culm/mechanics/element.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <unordered_map>
#include <utility>
#include <vector>

namespace culm::model {

/// Elements one behind the other, and how a rank makes those that it wants.
template <class E>
struct ElementSeries {
  using Nodes = std::array<int, E::num_nodes>;

  std::vector<Nodes> nodes;  ///< of each
  /// The k-th of them, the same each time. What it refers to lives as long as the model.
  std::function<E(const Nodes& nodes, int k)> make;
  /// make(nodes, k).mass(), where that can be had for less; else empty.
  std::function<SlotMatrix<E::num_slots>(const Nodes& nodes, int k)> mass = {};
};

/// Every rank knows the nodes of all elements, but makes only those that it evaluates, once it is
/// known which. So memory and time for elements fall with the number of ranks.
template <class E>
class ElementStore {
 public:
  using Nodes = typename ElementSeries<E>::Nodes;
  struct Item {
    E element;
    Nodes nodes;
  };

  /// @return number of the first one
  int add(ElementSeries<E> series) {
    const int first = size();
    nodes_.insert(nodes_.end(), series.nodes.begin(), series.nodes.end());
    series_.push_back({first, std::move(series.make), std::move(series.mass)});
    return first;
  }

  /// How many the model has.
  int size() const { return static_cast<int>(nodes_.size()); }
  const Nodes& nodes(int item) const { return nodes_[index(item)]; }

  /// Made anew, wherever it is evaluated.
  E make(int item) const {
    const Maker& series = series_of(item);
    return series.make(nodes(item), item - series.first);
  }
  /// Of a rank that does not evaluate it: made when it is first asked for, and kept until `place`
  /// or `forget_others`. To ask for it from then on is a bug, and is told so.
  const E& operator[](int item) const {
    const std::size_t place = place_of(item);
    if (place < local_.size()) return local_[place].element;
    internal_check(!only_local_, "an element of another rank was asked for");
    const auto found = others_.find(item);
    return found != others_.end() ? found->second : others_.emplace(item, make(item)).first->second;
  }

  /// Makes those that this rank evaluates, rising by number.
  void place(const std::vector<int>& items) {
    forget();
    local_.clear();
    local_.reserve(items.size());
    for (const int item : items) local_.push_back({make(item), nodes(item)});
    numbers_ = items;
    is_placed_ = true;
  }
  void forget_others() {
    forget();
    only_local_ = true;
  }

  /// The i-th of those that this rank evaluates.
  const Item& local(std::size_t i) const { return local_[i]; }

  /// Calls visit(nodes, mass) for every element of the model, and after `forget_others` for those
  /// that this rank evaluates.
  template <class Visit>
  void for_masses(Visit visit) const {
    if (only_local_) {
      for (const Item& one : local_) visit(one.nodes, one.element.mass());
      return;
    }
    std::size_t here = 0, other = 0;
    for (int item = 0; item < size(); ++item) {
      if (here < numbers_.size() && numbers_[here] == item) {
        visit(local_[here].nodes, local_[here].element.mass());
        ++here;
      } else if (!is_placed_) {
        visit(nodes(item), mass(item));
      } else {
        // modes ask once for each
        if (other == masses_of_others_.size()) masses_of_others_.push_back(mass(item));
        visit(nodes(item), masses_of_others_[other++]);
      }
    }
  }

 private:
  struct Maker {
    int first;
    std::function<E(const Nodes&, int)> make;
    std::function<SlotMatrix<E::num_slots>(const Nodes&, int)> mass;
  };

  void forget() {
    others_.clear();
    masses_of_others_ = {};
  }

  const Maker& series_of(int item) const {
    return *(std::ranges::upper_bound(series_, item, {}, &Maker::first) - 1);
  }
  SlotMatrix<E::num_slots> mass(int item) const {
    const Maker& series = series_of(item);
    if (!series.mass) return make(item).mass();
    return series.mass(nodes(item), item - series.first);
  }
  // beyond all of them if it is not here
  std::size_t place_of(int item) const {
    if (local_.size() == nodes_.size()) return index(item);
    const auto found = std::ranges::lower_bound(numbers_, item);
    if (found == numbers_.end() || *found != item) return local_.size();
    return static_cast<std::size_t>(found - numbers_.begin());
  }

  std::vector<Nodes> nodes_;  // of all
  std::vector<Maker> series_;
  std::vector<Item> local_;
  std::vector<int> numbers_;  // of local_ in the model
  // of other ranks, once somebody has asked
  mutable std::unordered_map<int, E> others_;
  mutable std::vector<SlotMatrix<E::num_slots>> masses_of_others_;
  bool is_placed_ = false;
  bool only_local_ = false;
};

}  // namespace culm::model
