/// The ways in which a beam can be modelled.
#pragma once

#include <culm/beam/axis.hpp>
#include <culm/beam/section_table.hpp>
#include <culm/model/model.hpp>
#include <culm/model/strain_damping.hpp>

#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace culm::beam {

/// Where the elements of one chain of a beam go.
struct Place {
  const Chain& chain;
  const std::vector<int>& nodes;  ///< numbers in the model; order * elements + 1 of them
  const SectionTable& sections;
  const model::StrainDamping& damping;
  model::Model& model;
  model::Structure& structure;  ///< gets cells and line points

  model::NodeSlots first_node() const {
    return model::NodeTable::slots(model.nodes().reference(), structure.nodes.front());
  }
};

/// Elements that a deck can choose, by 'Element', 'Order', 'Fidelity' and 'Torsion'.
struct ElementFamily {
  std::string element = {};
  int order = 1;  ///< nodes per element minus one
  std::string fidelity = {};
  bool twists = true;         ///< false: twist is held
  bool damps_strains = true;  ///< has 'Strain Damping' and 'Relaxation'
  bool yields = false;        ///< sections may be plastic
  /// How far the ends of an element may be turned against each other in the reference [rad].
  double most_turn = std::numeric_limits<double>::infinity();
  /// Adds the elements of a chain. @return largest turn of an element in the reference [rad]
  std::function<double(const Place&)> add = {};
};

/// All there are. Each source of elements has a function that adds its own.
class ElementFamilies {
 public:
  ElementFamilies();
  void add(ElementFamily family) { families_.push_back(std::move(family)); }

  /// Null if there is none.
  const ElementFamily* find(const std::string& element, int order, const std::string& fidelity,
                            bool twists) const;
  /// Orders of an element, each once, rising.
  std::vector<int> orders(const std::string& element) const;
  /// Values of 'Element' and 'Fidelity', in the order in which they were added.
  std::vector<std::string> elements() const;
  std::vector<std::string> fidelities() const;
  const std::vector<ElementFamily>& all() const { return families_; }

 private:
  std::vector<ElementFamily> families_;
};

/// In files of their own, because each of these elements has a batch of its own to compile.
void register_director_elements(ElementFamilies& families);
void register_kirchhoff_elements(ElementFamilies& families);
void register_linear_elements(ElementFamilies& families);
void register_untwisted_elements(ElementFamilies& families);
void register_untwisted_kirchhoff_elements(ElementFamilies& families);
void register_rigid_elements(ElementFamilies& families);
void register_helical_elements(ElementFamilies& families);

}  // namespace culm::beam
