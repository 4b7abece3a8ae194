/// What the elements of a structure look like.
#pragma once

#include <culm/base/cell_nodes.hpp>

#include <cstddef>
#include <initializer_list>
#include <iterator>
#include <vector>

namespace culm::model {

class ResultantSource;

/// What an element looks like in pictures: its nodes in order along the line or around the face.
struct Cell {
  CellNodes nodes;
  const ResultantSource* source = nullptr;  ///< where its stress resultants come from
  int item = 0;                             ///< its number there
};

/// Cells one after the other. Large structures have many, and every process knows them all: those
/// whose numbers go on evenly, along a line or a row of a mesh, are kept together.
class Cells {
 public:
  class Iterator;

  Cells() = default;
  Cells(std::initializer_list<Cell> cells) {
    for (const Cell& cell : cells) push_back(cell);
  }

  void push_back(const Cell& cell);
  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  /// @pre i < size()
  Cell operator[](std::size_t i) const;
  Cell front() const { return (*this)[0]; }
  Iterator begin() const;
  Iterator end() const;

 private:
  struct Run {
    std::size_t begin;
    Cell first;
    int node_step = 0;  // from a cell to the next
    int item_step = 0;
    Cell at(std::size_t k) const;
  };

  std::vector<Run> runs_;
  std::size_t size_ = 0;
};

class Cells::Iterator {
 public:
  using value_type = Cell;
  using difference_type = std::ptrdiff_t;

  Iterator() = default;
  Iterator(const Cells& cells, std::size_t at) : cells_(&cells), at_(at) {}
  Cell operator*() const { return (*cells_)[at_]; }
  Iterator& operator++() {
    ++at_;
    return *this;
  }
  Iterator operator++(int) {
    const Iterator before = *this;
    ++at_;
    return before;
  }
  bool operator==(const Iterator& other) const { return at_ == other.at_; }

 private:
  const Cells* cells_ = nullptr;
  std::size_t at_ = 0;
};
static_assert(std::forward_iterator<Cells::Iterator>);

inline Cells::Iterator Cells::begin() const { return {*this, 0}; }
inline Cells::Iterator Cells::end() const { return {*this, size_}; }

}  // namespace culm::model
