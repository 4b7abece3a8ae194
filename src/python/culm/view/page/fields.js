// What can colour the model. A field has a key (for addresses), a label with unit, whether its numbers
// are of nodes or cells, and `values(structure)`: those at the moment, or null.

const COMPONENTS = ["x", "y", "z"];

function labelOf(name, words, unit) {
  return `${name}${words ? ` (${words})` : ""}${unit ? ` [${unit}]` : ""}`;
}

/** All fields of a model. */
function fieldsOf(model) {
  const fields = [new DisplacementField(null), ...COMPONENTS.map((_, k) => new DisplacementField(k))];
  if (model.moves) fields.push(new SpeedField(model));
  const byKey = new Map();
  for (const structure of model.structures) {
    for (const one of structure.fields) {
      const key = labelOf(one.name, one.words, one.unit);
      if (!byKey.has(key)) byKey.set(key, new RecordedField(one, model));
      byKey.get(key).add(structure, one);
    }
  }
  fields.push(...byKey.values());
  return fields;
}

class DisplacementField {
  constructor(component) {
    this.component = component;
    this.key = component === null ? "displacement" : `displacement ${COMPONENTS[component]}`;
    this.label = labelOf(this.key, "", "m");
    this.on = "nodes";
  }

  values(structure) {
    const u = structure.displacement;
    const out = new Float32Array(structure.count);
    for (let n = 0; n < out.length; n++) {
      out[n] = this.component === null ? Math.hypot(u[3 * n], u[3 * n + 1], u[3 * n + 2]) : u[3 * n + this.component];
    }
    return out;
  }

  /** Of a node or cell in a state. */
  at(structure, place, state) {
    const u = [0, 1, 2].map((k) => structure.displacements.at(3 * (state * structure.count + place) + k));
    return this.component === null ? Math.hypot(...u) : u[this.component];
  }
}

/** Speed by the differences between recorded states, because velocities are not recorded. */
class SpeedField {
  constructor(model) {
    this.model = model;
    this.key = "speed";
    this.label = "speed, mean between states [m/s]";
    this.on = "nodes";
  }

  values(structure) {
    return Float32Array.from({ length: structure.count }, (_, n) => this.at(structure, n, this.model.state));
  }

  at(structure, node, state) {
    const { times } = this.model;
    const before = Math.max(state - 1, 0), after = Math.min(state + 1, times.length - 1);
    const duration = times[after] - times[before];
    if (!(duration > 0)) return 0;
    const change = [0, 1, 2].map((k) => {
      const place = 3 * node + k, size = 3 * structure.count;
      return structure.displacements.at(after * size + place) - structure.displacements.at(before * size + place);
    });
    return Math.hypot(...change) / duration;
  }
}

/** Numbers from the result file, of those structures that have them. */
class RecordedField {
  constructor({ name, words, unit, on }, model) {
    this.model = model;
    this.key = name;
    this.label = labelOf(name, words, unit);
    this.on = on;
    this.recorded = new Map();
  }

  add(structure, { values }) {
    this.recorded.set(structure, values);
  }

  values(structure) {
    const values = this.recorded.get(structure);
    if (!values) return null;
    const count = values.shape[1];
    const out = new Float32Array(count);
    values.copy(this.model.state * count, out);
    return out;
  }

  at(structure, place, state) {
    const values = this.recorded.get(structure);
    return values ? values.at(state * values.shape[1] + place) : null;
  }
}

/** Least and greatest number of a field as the model stands. */
function rangeNow(field, structures) {
  let low = Infinity, high = -Infinity;
  for (const structure of structures) {
    for (const value of field.values(structure) || []) {
      if (value < low) low = value;
      if (value > high) high = value;
    }
  }
  return low <= high ? [low, high] : [0, 0];
}
