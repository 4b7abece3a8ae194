/// Springs, dampers and drives of the deck: what they read besides the link they act on.
#pragma once

#include <culm/load/link.hpp>
#include <culm/load/link_law.hpp>
#include <culm/model/build_context.hpp>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace culm::load {

/// The units and names of a coordinate and its force.
struct LinkUnits {
  std::string coordinates;  ///< name of the parameter of a table
  std::string coordinate_unit;
  std::string forces;
  std::string force_unit;

  static LinkUnits lengths() { return {"Elongations", "m", "Forces", "N"}; }
  static LinkUnits angles() { return {"Angles", "rad", "Moments", "N m"}; }
};

/// The links of a deck entry; none, and issues, where it asks for something that is not there.
using MakeLinks = std::function<std::vector<Link>(const Options&, model::BuildContext&)>;
using MakeLaw = std::function<std::unique_ptr<LinkLaw>(const Options&, model::BuildContext&)>;

/// A kind of link.
struct LinkType {
  std::string prefix;  ///< of the names "… Spring" and "… Damper" in the deck
  std::string doc;     ///< where it acts, after "Spring " and "Damper "
  Schema fields;
  LinkUnits units;
  MakeLinks make;
};

/// Registers "… Spring" and "… Damper".
void register_spring_and_damper(model::BuilderRegistry& registry, const LinkType& type);
/// Registers one type with any law.
void register_link(model::BuilderRegistry& registry, const Schema& schema, MakeLinks make,
                   MakeLaw law);

/// Parameters "Stiffness" or a table; "Damping" or a table.
void add_spring_fields(const LinkUnits& units, Schema& schema);
void add_damper_fields(const LinkUnits& units, Schema& schema);
PiecewiseLinear read_spring(const Options& options, const LinkUnits& units);
PiecewiseLinear read_damper(const Options& options, const LinkUnits& units);

/// Parameters "First" and "Second", and offsets of the points on them.
Schema point_pair_schema();
/// The points of the pair; none, and issues, if the deck names no pair.
std::vector<LinkPoint> select_points(const Options& options, model::BuildContext& context);
/// Parameters "Node" and "Offset".
Schema ground_schema();
/// One point for each selected node.
std::vector<LinkPoint> select_ground_points(const Options& options, model::BuildContext& context);
/// Parameter "Frame" of a direction, and whether it turns with the node.
Field frame_field(const std::string& node);
bool follows(const Options& options);
/// Parameter "Free Length", and its value in place of the rest of links.
Field free_length_field();
void set_free_length(const Options& options, std::vector<Link>& links);

}  // namespace culm::load
