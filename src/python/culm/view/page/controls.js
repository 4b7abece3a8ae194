// The column of choices. Each changes the view; `show` brings all in line with it.

const SWITCHES = {
  mesh: "mesh",
  marks: "supports",
  loads: "loads",
  directors: "directors",
  reference: "reference",
  follow: "follow",
  ghost: "other run",
};

class Controls {
  /** @param change  is called with what of the view changes */
  constructor(model, ghost, fields, change, lookFrom) {
    this.elements = {};
    for (const id of ["show", "scale", "field", "range"]) this.elements[id] = document.getElementById(id);
    const { show, scale, field, range } = this.elements;
    show.add(new Option("states", ""));
    for (const analysis of model.analyses) {
      analysis.shapes.forEach((name, i) => show.add(new Option(`${analysis.name}: ${name}`, `${analysis.name}/${i + 1}`)));
    }
    field.add(new Option("none", ""));
    for (const one of fields) field.add(new Option(one.label, one.key));
    show.parentElement.hidden = model.analyses.length === 0;
    show.addEventListener("change", () => change({ shape: show.value }));
    scale.addEventListener("input", () => change({ scale: Number(scale.value) }));
    field.addEventListener("change", () => change({ field: field.value }));
    range.addEventListener("change", () => change({ range: range.value }));
    this.addSwitches(model, ghost !== null, change);
    this.addViews(lookFrom);
  }

  addSwitches(model, hasGhost, change) {
    this.switches = {};
    for (const [name, text] of Object.entries(SWITCHES)) {
      if (name === "ghost" && !hasGhost) continue;
      if (name === "loads" && !model.hasLoads) continue;
      const box = document.createElement("input");
      box.type = "checkbox";
      box.id = name;
      box.addEventListener("change", () => change({ [name]: box.checked }));
      const label = document.createElement("label");
      label.append(box, text);
      document.getElementById("switches").append(label);
      this.switches[name] = box;
    }
  }

  addViews(lookFrom) {
    for (const name of ["all", "+x", "−x", "+y", "−y", "+z", "−z", "this state"]) {
      const button = document.createElement("button");
      button.textContent = name;
      button.addEventListener("click", () => lookFrom(name));
      document.getElementById("views").append(button);
    }
  }

  show(view) {
    const { show, scale, field, range } = this.elements;
    show.value = view.shape;
    scale.value = view.scale;
    field.value = view.field;
    range.value = view.range;
    document.getElementById("scale-row").hidden = view.shape === "";
    range.parentElement.hidden = view.field === "" || view.shape !== "";
    for (const [name, box] of Object.entries(this.switches)) box.checked = view[name];
  }
}
