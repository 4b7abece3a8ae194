// Surfaces of structures. A vertex belongs to a node and a cell and lies at constant components in the
// directors of the node, so one loop moves all of them.

const MOST_VERTICES = 600000;
const SYMBOLIC_CORNERS = 8;

/** Collects vertices and triangles; lines for the mesh are pairs of vertices. */
class Surface {
  constructor() {
    this.nodes = [];
    this.cells = [];
    this.offsets = [];
    this.triangles = [];
    this.lines = [];
  }

  add(node, cell, x = 0, y = 0, z = 0) {
    this.nodes.push(node);
    this.cells.push(cell);
    this.offsets.push(x, y, z);
    return this.nodes.length - 1;
  }

  get size() {
    return this.nodes.length;
  }

  /** The places of all vertices for the nodes of a structure as they are now. */
  place(structure, out) {
    const { position, triad } = structure;
    const { nodes, offsets } = this;
    for (let v = 0; v < nodes.length; v++) {
      const p = 3 * nodes[v], t = 9 * nodes[v];
      const x = offsets[3 * v], y = offsets[3 * v + 1], z = offsets[3 * v + 2];
      for (let k = 0; k < 3; k++) {
        out[3 * v + k] = position[p + k] + x * triad[t + k] + y * triad[t + 3 + k] + z * triad[t + 6 + k];
      }
    }
  }
}

/** The surface of a structure. `symbol` is the size of what has no shape of its own [m]. */
function surfaceOf(structure, symbol) {
  const surface = new Surface();
  if (structure.kind === "Shell") addShell(surface, structure);
  else if (structure.kind === "Beam") addBeam(surface, structure, symbol / 4);
  else addBodies(surface, structure, symbol);
  return surface;
}

function addShell(surface, structure) {
  for (let cell = 0; cell < structure.cellCount; cell++) {
    const corners = Array.from(structure.cell(cell), (node) => surface.add(node, cell));
    for (let i = 1; i + 1 < corners.length; i++) surface.triangles.push(corners[0], corners[i], corners[i + 1]);
    corners.forEach((corner, i) => surface.lines.push(corner, corners[(i + 1) % corners.length]));
  }
}

function addBodies(surface, structure, symbol) {
  const geometry = bodyGeometry(structure.body || { kind: "marker", centre: [0, 0, 0] }, symbol);
  const places = geometry.attributes.position.array;
  for (let cell = 0; cell < structure.cellCount; cell++) {
    const node = structure.cell(cell)[0];
    const first = surface.size;
    for (let i = 0; i < places.length; i += 3) surface.add(node, cell, places[i], places[i + 1], places[i + 2]);
    for (const i of geometry.index.array) surface.triangles.push(first + i);
  }
}

function regularPolygon(corners, radius) {
  return Array.from({ length: corners }, (_, i) => {
    const angle = (2 * Math.PI * i) / corners;
    return [radius * Math.cos(angle), radius * Math.sin(angle)];
  });
}

/** The outlines of a beam by their numbers, with so few corners that all fit; the last is symbolic. */
function polygonsOf(structure, radius) {
  const polygons = [];
  if (structure.outlines) {
    const { ends, points } = structure.outlines;
    const segments = structure.connectivity.length;
    ends.forEach((end, i) => {
      const start = i === 0 ? 0 : ends[i - 1];
      const stride = Math.ceil((2 * segments * (end - start)) / MOST_VERTICES);
      const polygon = [];
      for (let p = start; p < end; p += stride) polygon.push([points[2 * p], points[2 * p + 1]]);
      polygons.push(polygon);
    });
  }
  polygons.push(regularPolygon(SYMBOLIC_CORNERS, radius));
  return polygons;
}

function addBeam(surface, structure, radius) {
  const polygons = polygonsOf(structure, radius);
  const symbolic = polygons[polygons.length - 1];
  const outline = (node) => polygons[structure.outlines ? structure.outlines.ofNode[node] : -1] || symbolic;
  const uses = new Uint8Array(structure.count);
  for (let cell = 0; cell < structure.cellCount; cell++) {
    const nodes = structure.cell(cell);
    uses[nodes[0]]++;
    uses[nodes[nodes.length - 1]]++;
  }
  for (let cell = 0; cell < structure.cellCount; cell++) {
    const nodes = structure.cell(cell);
    for (let i = 0; i + 1 < nodes.length; i++) {
      let from = outline(nodes[i]), to = outline(nodes[i + 1]);
      if (from.length !== to.length) from = to = symbolic;
      const isFirst = i === 0, isLast = i + 2 === nodes.length;
      const a = addRing(surface, nodes[i], cell, from, isFirst && from !== symbolic);
      const b = addRing(surface, nodes[i + 1], cell, to, isLast && to !== symbolic);
      for (let j = 0; j < from.length; j++) {
        const next = (j + 1) % from.length;
        surface.triangles.push(a + j, a + next, b + next, a + j, b + next, b + j);
      }
      if (isFirst && uses[nodes[i]] === 1) addCap(surface, a, from.length, true);
      if (isLast && uses[nodes[i + 1]] === 1) addCap(surface, b, to.length, false);
    }
  }
}

function addRing(surface, node, cell, polygon, isLine) {
  const first = surface.size;
  for (const [x, y] of polygon) surface.add(node, cell, x, y);
  for (let j = 0; isLine && j < polygon.length; j++) surface.lines.push(first + j, first + ((j + 1) % polygon.length));
  return first;
}

function addCap(surface, first, corners, isStart) {
  for (let j = 1; j + 1 < corners; j++) {
    if (isStart) surface.triangles.push(first, first + j + 1, first + j);
    else surface.triangles.push(first, first + j, first + j + 1);
  }
}
