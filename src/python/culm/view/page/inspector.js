// Numbers and history of what is picked.

/** Where a field has its numbers of a pick: a node or a cell, or null. */
function placeOf(field, pick) {
  return field.on === "nodes" ? pick.node : pick.cell;
}

class Inspector {
  constructor(model, ghost, fields) {
    Object.assign(this, { model, ghost, fields });
    this.text = document.getElementById("picked-text");
    this.plot = document.getElementById("plot");
  }

  /** @param field  that colours the model, or null  @param shape  whether a shape is shown */
  show(pick, field, shape) {
    this.plot.hidden = pick === null || shape || this.model.times.length < 2;
    this.text.textContent = "";
    if (pick === null) {
      this.text.textContent = "Nothing. Click on an element.";
      return;
    }
    const table = document.createElement("table");
    for (const [name, value] of this.rows(pick, shape)) addRow(table, name, value);
    this.text.append(table);
    if (!this.plot.hidden) this.drawHistory(pick, field);
  }

  rows(pick, shape) {
    const { structure, cell, node } = pick;
    const rows = [["structure", structure.name]];
    if (cell !== null) rows.push(["element", structure.cellNumber(cell)]);
    if (node !== null) {
      rows.push(["node", structure.nodeNumber(node)]);
      const held = structure.held.filter((one) => one.nodes.includes(node)).map((one) => one.name);
      if (held.length) rows.push(["held by", held.join(", ")]);
    }
    if (shape) return rows;
    if (node !== null) COMPONENTS.forEach((name, k) => rows.push([`${name} [m]`, structure.position[3 * node + k]]));
    for (const field of this.fields) {
      const place = placeOf(field, pick);
      const value = place === null ? null : field.at(structure, place, this.model.state);
      if (value !== null) rows.push([field.label, value]);
    }
    return rows;
  }

  drawHistory(pick, field) {
    const fitting = field && placeOf(field, pick) !== null && field.at(pick.structure, placeOf(field, pick), 0) !== null;
    const shown = fitting ? field : this.fields.find((one) => placeOf(one, pick) !== null && one.at(pick.structure, placeOf(one, pick), 0) !== null);
    this.plot.hidden = shown === undefined;
    if (this.plot.hidden) return;
    const place = placeOf(shown, pick);
    const history = (model, structure) => ({
      x: model.times,
      y: model.times.map((_, state) => shown.at(structure, place, state)),
    });
    const curves = [history(this.model, pick.structure)];
    const twin = this.ghost && shown instanceof DisplacementField ? this.ghost.find(pick.structure.name) : null;
    if (twin && twin.count === pick.structure.count) curves.push({ ...history(this.ghost, twin), isGhost: true });
    const { level, state, times } = this.model;
    const labels = { x: labelOf(level.name, "", level.unit), y: shown.label };
    drawPlot(this.plot, curves, { x: times[state], y: curves[0].y[state] }, labels);
  }
}

function addRow(table, name, value) {
  const row = table.insertRow();
  row.insertCell().textContent = name;
  const cell = row.insertCell();
  const isMeasured = typeof value === "number" && !Number.isInteger(value);
  cell.textContent = isMeasured ? readable(value) : value;
  cell.title = value;
}
