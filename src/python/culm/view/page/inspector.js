// Numbers and history of what is picked.

/** Where a field has its numbers of a pick: a node or a cell, or null. */
function placeOf(field, pick) {
  return field.on === "nodes" ? pick.node : pick.cell;
}

/** The number of a field at a pick in a state; null where there is none. */
function numberAt(field, pick, state) {
  const place = placeOf(field, pick);
  return place === null ? null : field.at(pick.structure, place, state);
}

class Inspector {
  constructor(model, ghost, fields) {
    Object.assign(this, { model, ghost, fields });
    this.name = document.getElementById("picked-name");
    this.plot = document.getElementById("plot");
    this.numbers = document.getElementById("picked-numbers");
  }

  /** @param field  that colours the model, or null  @param isShape  whether a shape is shown */
  show(pick, field, isShape) {
    this.numbers.textContent = "";
    this.plot.hidden = true;
    this.name.textContent = pick === null ? "Nothing. Click on an element." : this.describe(pick);
    if (pick === null || isShape) return;
    const plotted = this.choose(pick, field);
    for (const [name, value, one] of this.rows(pick)) addRow(this.numbers, name, value, one === plotted);
    if (plotted === undefined || this.model.times.length < 2) return;
    this.plot.hidden = false;
    this.drawHistory(pick, plotted);
  }

  describe({ structure, cell, node }) {
    const words = [structure.name];
    if (cell !== null) words.push(`element ${structure.cellNumber(cell)}`);
    if (node !== null) words.push(`node ${structure.nodeNumber(node)}`);
    const held = structure.held.filter((one) => one.nodes.includes(node)).map((one) => one.name);
    return words.join(", ") + (held.length ? `; held by ${held.join(", ")}` : "");
  }

  rows(pick) {
    const { structure, node } = pick;
    const rows = COMPONENTS.map((name, k) => [`${name} [m]`, node === null ? null : structure.position[3 * node + k]]);
    for (const field of this.fields) rows.push([field.label, numberAt(field, pick, this.model.state), field]);
    return rows.filter(([, value]) => value !== null);
  }

  /** The field to plot: the one that colours, otherwise the first that has numbers here. */
  choose(pick, field) {
    return [field, ...this.fields].find((one) => one && numberAt(one, pick, this.model.state) !== null);
  }

  drawHistory(pick, field) {
    const history = (model, structure) => ({
      x: model.times,
      y: model.times.map((_, state) => numberAt(field, { ...pick, structure }, state)),
    });
    const curves = [history(this.model, pick.structure)];
    const twin = this.ghost && field instanceof DisplacementField ? this.ghost.find(pick.structure.name) : null;
    if (twin && twin.count === pick.structure.count) curves.push({ ...history(this.ghost, twin), isGhost: true });
    const { level, state, times } = this.model;
    const labels = { x: labelOf(level.name, "", level.unit), y: field.label };
    drawPlot(this.plot, curves, { x: times[state], y: curves[0].y[state] }, labels);
  }
}

/** The cell shows some digits, its title all. */
function addRow(table, name, value, isShown) {
  const row = table.insertRow();
  if (isShown) row.className = "shown";
  row.insertCell().textContent = name;
  const cell = row.insertCell();
  cell.textContent = readable(value);
  cell.title = value;
}
