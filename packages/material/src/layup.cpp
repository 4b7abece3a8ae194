#include <culm/base/error.hpp>
#include <culm/material/layup.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

namespace culm::material {

namespace {

// The number of layers that the lists of a layup state; 1 if all are single values.
std::size_t stated_layers(const Options& layup) {
  if (layup.has("Materials")) return layup.texts("Materials").size();
  if (layup.has("Thicknesses")) return layup.numbers("Thicknesses").size();
  return layup.numbers("Angles").size();
}

void check_lists(const Options& layup, InputIssues& issues) {
  const auto check_choice = [&](const char* one, const char* many) {
    if (layup.has(one) == layup.has(many)) {
      issues.add(layup.where(), fmt::format("give one of '{}' and '{}'", one, many));
      return false;
    }
    return true;
  };
  if (!check_choice("Material", "Materials") || !check_choice("Thickness", "Thicknesses")) return;
  const std::size_t layers = stated_layers(layup);
  const auto check_size = [&](const char* name, std::size_t size) {
    if (size == layers) return;
    issues.add(layup.where(name),
               fmt::format("must have one item per layer, {} as stated by the list before, got {}",
                           layers, size));
  };
  if (layup.has("Thicknesses")) check_size("Thicknesses", layup.numbers("Thicknesses").size());
  if (layup.given("Angles")) check_size("Angles", layup.numbers("Angles").size());
}

// The lists as written, mirrored and repeated.
std::vector<Layer> stack(std::vector<Layer> layers, int repeat, const std::string& symmetry) {
  const std::vector<Layer> once = layers;
  for (int i = 1; i < repeat; ++i) layers.insert(layers.end(), once.begin(), once.end());
  if (symmetry == "None") return layers;
  std::vector<Layer> mirrored = layers;
  if (symmetry == "Middle Layer") mirrored.pop_back();
  std::reverse(mirrored.begin(), mirrored.end());
  layers.insert(layers.end(), mirrored.begin(), mirrored.end());
  return layers;
}

}  // namespace

double Layup::thickness() const {
  double sum = 0.0;
  for (const Layer& layer : layers) sum += layer.thickness;
  return sum;
}

double Layup::bottom(int layer) const {
  double zeta = -0.5 * thickness();
  for (int l = 0; l < layer; ++l) zeta += layers[static_cast<std::size_t>(l)].thickness;
  return zeta;
}

bool Layup::is_linear() const {
  return std::all_of(layers.begin(), layers.end(),
                     [](const Layer& layer) { return layer.material.is_linear(); });
}

Layup single_layer(Material material, double thickness) {
  return {{Layer{std::move(material), thickness, 0.0}}};
}

Schema layup_schema() {
  Schema schema("Layup",
                "The wall of a shell: layers from the bottom upward, the normal pointing "
                "from bottom to top.");
  schema.add(text("Material", "Material of all layers, by its name in Materials.").optional())
      .add(texts("Materials", "Materials of the layers, by their names in Materials.")
               .min_size(1)
               .optional())
      .add(number("Thickness", "m", "Thickness of each layer.").positive().optional())
      .add(numbers("Thicknesses", "m", "Thicknesses of the layers.")
               .positive()
               .min_size(1)
               .optional())
      .add(numbers("Angles", "rad",
                   "Angles of the fibres of the layers from the reference axis, about the normal.")
               .min_size(1)
               .optional({0.0}))
      .add(
          integer("Repeat", "How many times the layers above are stacked.").at_least(1).optional(1))
      .add(choice("Symmetric", {"None", "All Layers", "Middle Layer"},
                  "Whether the layers are mirrored upward: all of them, [a b b a], or with the "
                  "last one in the middle, [a b a].")
               .optional("None"))
      .check(check_lists);
  return schema;
}

Layup read_layup(const Options& options, const std::map<std::string, Material>& materials) {
  const std::string field = options.has("Material") ? "Material" : "Materials";
  const auto find = [&](const std::string& name) {
    const auto found = materials.find(name);
    if (found == materials.end()) {
      std::vector<std::string> known;
      for (const auto& [one, material] : materials) known.push_back(one);
      throw InputError(options.where(field),
                       "unknown material '" + name + "'" + did_you_mean(name, known));
    }
    return found->second;
  };
  const std::vector<double>& angles = options.numbers("Angles");
  std::vector<Layer> layers;
  for (std::size_t l = 0; l < stated_layers(options); ++l) {
    const std::string& name =
        options.has("Material") ? options.text("Material") : options.texts("Materials")[l];
    const double thickness =
        options.has("Thickness") ? options.number("Thickness") : options.numbers("Thicknesses")[l];
    layers.push_back({find(name), thickness, angles.size() == 1 ? angles[0] : angles[l]});
  }
  for (const Layer& layer : layers) {
    if (layer.material.dissipation != layers[0].material.dissipation ||
        layer.material.damping != layers[0].material.damping) {
      throw InputError(options.where(field),
                       "the materials of one layup must have the same Dissipation and Damping");
    }
  }
  return {stack(std::move(layers), options.integer("Repeat"), options.text("Symmetric"))};
}

}  // namespace culm::material
