#include "bladed_file.hpp"
#include "box.hpp"
#include "mean_wind.hpp"
#include "tower_influence.hpp"

namespace culm::flow {
namespace {

SharedFlow make_bladed_box(const Options& options, model::BuildContext&) {
  BladedScaling scaling;
  if (options.has("Speed")) scaling.speed = options.number("Speed");
  if (options.has("Intensities")) {
    const std::vector<double>& given = options.numbers("Intensities");
    scaling.intensities = {given[0], given[1], given[2]};
  }
  scaling.contains_mean = !options.has("Height");
  scaling.is_left_handed = options.text("Components Across") == "Right";
  scaling.begins_at_left = options.text("Points From") == "Left";
  scaling.is_periodic = options.flag("Periodic");
  TurbulenceGrid grid = read_bladed(options.text("File Name"), options.where("File Name"), scaling);
  const double speed = grid.speed;
  SharedFlow box = make_box(options, std::move(grid));
  return scaling.contains_mean ? box : add_mean_wind(options, speed, std::move(box));
}

}  // namespace

void register_bladed_box(FlowRegistry& registry) {
  add_wind(
      registry, "Bladed Box",
      box_schema("Bladed Box", "Turbulence of a file of Bladed, or of TurbSim in this format.")
          .add(text("File Name", "Binary file (.wnd), relative to the deck."))
          .add(number("Speed", "m/s",
                      "Mean speed, with which the box moves and with which values are scaled; that "
                      "of the file if absent.")
                   .positive()
                   .optional())
          .add(numbers("Intensities", "1",
                       "Turbulence intensities of the components along the wind, across it and "
                       "upwards, which scale values; those of the file if absent.")
                   .size(3)
                   .non_negative()
                   .optional())
          .add(
              number("Height", "m",
                     "Height above the origin, along 'Up', at which the mean wind has 'Speed': for "
                     "files of Bladed, which hold fluctuations only. If absent the file holds all "
                     "of the wind beside its mean speed, as TurbSim writes it.")
                  .positive()
                  .optional())
          .add_all(mean_profile_schema())
          .add(
              choice("Components Across", {"Right", "Left"},
                     "Where positive components across the wind point, seen along it: to the right "
                     "in Bladed's files, to the left in those that TurbSim writes.")
                  .optional("Right"))
          .add(choice("Points From", {"Right", "Left"},
                      "Side, seen along the wind, where points across begin: the left one in files "
                      "that TurbSim writes for rotors that turn clockwise.")
                   .optional("Right"))
          .add(flag("Periodic", "Whether the box repeats itself along the wind.").optional(true))
          .check([](const Options& options, InputIssues& issues) {
            for (const char* name : {"Exponent", "Roughness"}) {
              if (options.has(name) && !options.has("Height")) {
                issues.add(options.where(name), "belongs to a mean wind, which needs 'Height'");
              }
            }
          }),
      make_bladed_box);
}

}  // namespace culm::flow
