/// Loads that come in two types, fixed in space and following the directors.
#pragma once

#include <culm/load/axes.hpp>
#include <culm/model/build_context.hpp>
#include <culm/model/one_director.hpp>

#include <memory>
#include <string>
#include <vector>

namespace culm::load {

/// What a load is made from, read from the deck.
struct LoadRequest {
  const Options& options;
  model::BuildContext& context;
  model::Effect effect;
  model::Amplitude function;
  Axes axes;           ///< of the components in the deck
  bool turns = false;  ///< with the directors; if not, it keeps the direction of the reference

  Vec3 vector(const std::string& parameter) const { return model::vector(options, parameter); }
  /// Axes in which the load keeps its components.
  Axes kept_in() const { return turns ? Axes::directors : Axes::space; }
  /// Components in those axes, at a point, of a vector of the deck.
  Vec3 components(const Vec3& vector, const model::Marker& point) const;
  Vec3 components(const std::string& parameter, const model::Marker& point) const {
    return components(vector(parameter), point);
  }
  const model::NodeTable& nodes() const { return context.model.nodes(); }
};

/// Null, after an issue, where the deck asks for something that is not there.
using MakeLoad = std::unique_ptr<model::Batch> (*)(const LoadRequest& request);

struct LoadType {
  std::string name;      ///< in the deck; that of the follower has "Follower " before it
  std::string doc;       ///< what it is, without the end of the sentence
  std::string quantity;  ///< name of the vector parameter; none if empty
  std::string unit;
};

/// Registers a load and its follower. @param fields  the parameters besides vector and function
void register_both_frames(model::BuilderRegistry& registry, const LoadType& type,
                          const Schema& fields, MakeLoad make);

using model::check_components;

/// Adds an issue if a moment shall follow a node of a shell, whose one director does not tell the
/// axes of the moment.
void refuse_following_moment(const LoadRequest& request, const std::vector<int>& nodes);

/// What a load is: its type and its name in the deck.
model::Effect effect_of(const std::string& type, const Options& options);

/// Parameter "Offset" of the point of attack.
Field offset_field();

}  // namespace culm::load
