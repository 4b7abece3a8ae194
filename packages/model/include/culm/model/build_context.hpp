/// What builders of loads and constraints share: the model they add to, and how they read nodes,
/// vectors and functions from the deck.
#pragma once

#include <culm/base/options.hpp>
#include <culm/base/registry.hpp>
#include <culm/math/types.hpp>
#include <culm/model/amplitude.hpp>
#include <culm/model/model.hpp>
#include <culm/model/vector_field.hpp>

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace culm::model {

/// Where builders add to, and where they report mistakes of the deck.
struct BuildContext {
  Model& model;                                       ///< with all structures, not frozen
  const std::map<std::string, Amplitude>& functions;  ///< lists "Functions" and "Signals"
  InputIssues& issues;
  std::map<std::string, SharedField> fields = {};  ///< list "Fields"
};

/// Types that add something to the model. @see Registry
using BuilderRegistry = Registry<void, BuildContext&>;

/// Parameter "Node", or another of this kind.
Field node_field(std::string name = "Node",
                 std::string doc =
                     "Nodes it acts on, each by itself: 'structure/set', "
                     "'structure/number' or 'structure'.");
/// The nodes that a parameter names; none, and an issue, if there are none.
std::vector<int> select_nodes(const Options& options, const std::string& parameter,
                              BuildContext& context);
/// The same for what acts on each node by itself, such as forces and masses: of refined structures
/// those that the deck has numbers for, so that the sum stays what it was.
std::vector<int> select_loaded_nodes(const Options& options, const std::string& parameter,
                                     BuildContext& context);

/// The nodes of a name that stands at `where`; none, and an issue, if there are none.
std::vector<int> find_nodes(const std::string& name, const Where& where, BuildContext& context);

/// Parameter that names one material point, for select_point.
Field point_field(std::string name, std::string doc);
/// The point that a parameter names: a node, or a point of a line at a fraction of its length, as
/// 'beam@0.35'; nothing, and an issue, if there is no such point or more than one.
std::optional<Marker> select_point(const Options& options, const std::string& parameter,
                                   BuildContext& context);

/// Parameter "Structure".
Field structure_field();
/// The structure that parameter "Structure" names; null, and an issue, if there is none.
const Structure* select_structure(const Options& options, BuildContext& context);

/// Three components in space, or in the directors of a node.
Field vector_field(std::string name, std::string unit, std::string doc);
Vec3 vector(const Options& options, const std::string& parameter);

/// Parameter "Function", or another of this kind; `fallback` is "Ramp" or "Constant", which exist
/// in every deck.
Field function_field(std::string fallback, std::string name = "Function");
/// Whether something can follow signals beside functions of time.
enum class Follows { functions, signals };
/// The function or signal that a parameter names; nothing, and an issue, if there is none of this
/// kind.
std::optional<Amplitude> find_function(const Options& options, BuildContext& context,
                                       const std::string& parameter = "Function",
                                       Follows follows = Follows::functions);
/// The field that parameter "Field" names; null, and an issue, if there is none.
SharedField find_field(const Options& options, BuildContext& context);
/// The function of a name that stands at `where`, likewise.
std::optional<Amplitude> find_function(const std::string& name, const Where& where,
                                       BuildContext& context, Follows follows);

}  // namespace culm::model
