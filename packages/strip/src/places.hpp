/// Where strips stand: what all loads of sections read from a deck alike.
#pragma once

#include <culm/strip/register_strip.hpp>

#include <cstddef>
#include <initializer_list>
#include <memory>
#include <optional>
#include <vector>

namespace culm::strip {

/// A place on the table of positions: between entry `index` and the next one.
struct Between {
  std::size_t index = 0;
  double share = 0.0;
};

/// @param positions  rising from 0 to 1 @param s  fraction of the length
Between find_between(const std::vector<double>& positions, double s);

/// What may vary along the span: one value, or one at each of the positions, linear in between.
class Distribution {
 public:
  /// @param one, several  parameters of a deck, of which one is given or has a default
  Distribution(const Options& options, const char* one, const char* several);
  double at(double s) const;

 private:
  std::vector<double> values_, positions_;
};

/// A point of the axis of a line, or a node, with the span that it stands for.
struct Place {
  model::Marker point;
  double length = 0.0;  ///< [m]
  double s = 0.0;       ///< fraction of the length of the line
};

/// Adds Structure, or Node and Length, Flow, Function, Stations, Positions.
void add_place_fields(Schema& schema);
/// @param tables  parameters with one value per position
void check_places(const Options& options, std::initializer_list<const char*> tables,
                  InputIssues& issues);
void check_one_of(const char* one, const char* several, const Options& options,
                  InputIssues& issues);
/// Those of all stations; none, and an issue, if they cannot be found.
std::vector<Place> places_of(const Options& options, model::BuildContext& context);
/// Parameter Flow, without what the structure itself changes in it; null, and an issue, if there is
/// none.
flow::SharedFlow find_wind(const Options& options, StripContext& context);
/// Parameter Function; nothing, and an issue, if it is none of time.
std::optional<model::Amplitude> find_time_function(const Options& options,
                                                   model::BuildContext& context);
/// Adds the load to the model, and an issue if another one has its chords; in a rotating frame it
/// knows that.
void add_strips(const Options& options, std::unique_ptr<StripLoad> load, StripContext& context);

}  // namespace culm::strip
