#include "face.hpp"

namespace culm::load {

Schema face_fields() {
  Schema schema("");
  schema.add(text("Structure", "Name of the shell, or of a part of it as 'shell/part'."))
      .add(choice("Face", {"Bottom", "Middle", "Top"},
                  "Surface through the thickness; directors point from Bottom to Top.")
               .optional("Middle"));
  return schema;
}

std::vector<LoadedFace> loaded_faces(const Options& options, model::BuildContext& context) {
  const std::string& name = options.text("Structure");
  const std::string& face = options.text("Face");
  const double side = face == "Top" ? 0.5 : face == "Bottom" ? -0.5 : 0.0;
  std::vector<LoadedFace> result;
  for (const model::Face& patch : context.model.faces(name)) {
    result.push_back({patch.nodes, side * patch.thickness});
  }
  if (!result.empty()) return result;
  const model::Structure* structure = context.model.find_structure(name.substr(0, name.find('/')));
  if (structure == nullptr) {
    model::select_structure(options, context);  // reports the unknown name
  } else if (structure->faces.empty()) {
    context.issues.add(options.where("Structure"),
                       "structure '" + structure->name + "' is no shell: it has no area to load");
  } else {
    std::string parts;
    for (const auto& [part, cells] : structure->parts) {
      parts += (parts.empty() ? "'" : ", '") + part + "'";
    }
    context.issues.add(options.where("Structure"),
                       "no part '" + name + "'; the shell has " +
                           (parts.empty() ? "no parts" : "the parts " + parts));
  }
  return result;
}

}  // namespace culm::load
