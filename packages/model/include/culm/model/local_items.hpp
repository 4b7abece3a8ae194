/// Items of a batch, of which a rank may need few.
#pragma once

#include <culm/base/error.hpp>

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace culm::model {

/// All items of a batch, by their numbers in the model, until `keep` takes those of other ranks
/// away. To ask for one of them from then on is a bug, and is told so.
template <class Item>
class LocalItems {
 public:
  void add(Item item) {
    items_.push_back(std::move(item));
    ++size_;
  }
  /// How many the model has.
  int size() const { return size_; }
  /// Those that are here, rising by number.
  std::span<const Item> here() const { return items_; }
  bool has(int item) const { return place_of(item) < items_.size(); }
  Item& operator[](int item) { return items_[checked_place_of(item)]; }
  const Item& operator[](int item) const { return items_[checked_place_of(item)]; }

  /// The i-th of the items that a rank evaluates: without a search.
  const Item& local(const std::vector<int>& items, std::size_t i) const {
    return items_[numbers_.empty() ? static_cast<std::size_t>(items[i]) : i];
  }

  /// Takes all but those away that a rank evaluates; rising.
  void keep(const std::vector<int>& items) {
    if (items.size() == static_cast<std::size_t>(size_)) return;
    if (!numbers_.empty() && items == numbers_) return;
    std::vector<Item> kept;
    kept.reserve(items.size());
    for (const int item : items) kept.push_back(std::move((*this)[item]));
    items_ = std::move(kept);
    numbers_ = items;
  }

 private:
  // beyond all of them if it is not here
  std::size_t place_of(int item) const {
    if (numbers_.empty()) {
      return items_.size() == static_cast<std::size_t>(size_) ? static_cast<std::size_t>(item)
                                                              : items_.size();
    }
    const auto found = std::ranges::lower_bound(numbers_, item);
    if (found == numbers_.end() || *found != item) return items_.size();
    return static_cast<std::size_t>(found - numbers_.begin());
  }
  std::size_t checked_place_of(int item) const {
    const std::size_t place = place_of(item);
    internal_check(place < items_.size(), "an item of another rank was asked for");
    return place;
  }

  std::vector<Item> items_;
  std::vector<int> numbers_;  // of items_ in the model; empty while all are here
  int size_ = 0;
};

}  // namespace culm::model
