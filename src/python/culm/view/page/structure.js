// A structure of the model, and where its nodes are at the moment.

class Structure {
  constructor(data) {
    this.name = data.name;
    this.kind = data.kind;
    this.reference = new Numbers(data.reference).values;
    this.count = this.reference.length / 3;
    this.connectivity = new Numbers(data.connectivity).values;
    this.ends = new Numbers(data.ends).values;
    this.nodeNumbers = unpack(data.nodes);
    this.cellNumbers = unpack(data.cells);
    this.displacements = new Numbers(data.displacement);
    this.bends = unpack(data.bend);
    this.directors = data.directors;
    this.triads = unpack(data.triads);
    const referenceTriads = unpack(data.referenceTriads);
    this.outlines = data.outlines && {
      ofNode: new Numbers(data.outlines.ofNode).values,
      ends: new Numbers(data.outlines.ends).values,
      points: new Numbers(data.outlines.points).values,
    };
    this.body = data.body;
    this.reach = reachOf(this.outlines, this.body);
    this.held = data.held;
    this.loaded = data.loaded.map((load) => ({ ...load, actions: new Numbers(load.actions).values }));
    this.fields = data.fields.map((field) => ({ ...field, values: new Numbers(field.values) }));
    // of what is shown: places, displacements, what imperfections bend, directors d1 d2 d3 of each node
    this.position = new Float32Array(3 * this.count);
    this.displacement = new Float32Array(3 * this.count);
    this.bend = new Float32Array(3 * this.count);
    this.triad = new Float32Array(9 * this.count);
    this.packedTriad = new Float32Array(3 * this.directors.length * this.count);
    if (referenceTriads) referenceTriads.copy(0, this.packedTriad);
    this.spreadTriads();
    this.referenceTriad = this.triad.slice();
    this.showState(0);
  }

  get cellCount() {
    return this.ends.length;
  }

  /** Nodes of a cell, by their places. */
  cell(number) {
    return this.connectivity.subarray(number === 0 ? 0 : this.ends[number - 1], this.ends[number]);
  }

  /** Numbers as the result file has them. */
  nodeNumber(place) {
    return this.nodeNumbers ? this.nodeNumbers.at(place) : place;
  }
  cellNumber(place) {
    return this.cellNumbers ? this.cellNumbers.at(place) : place;
  }

  showState(state) {
    this.displacements.copy(state * this.displacement.length, this.displacement);
    if (this.bends) this.bends.copy(state * this.bend.length, this.bend);
    for (let i = 0; i < this.position.length; i++) {
      this.position[i] = this.reference[i] + this.bend[i] + this.displacement[i];
    }
    if (this.triads === null) return;
    this.triads.copy(state * this.packedTriad.length, this.packedTriad);
    this.spreadTriads();
  }

  /** To d1, d2, d3 of each node, of which a shell has d3 only. */
  spreadTriads() {
    const n = this.directors.length;
    for (let node = 0; node < this.count; node++) {
      for (let d = 0; d < n; d++) {
        for (let k = 0; k < 3; k++) {
          // packed as (nodes, 3, directors)
          this.triad[9 * node + 3 * (this.directors[d] - 1) + k] = this.packedTriad[(3 * node + k) * n + d];
        }
      }
    }
  }

  /**
   * A state moved along a shape: six numbers per node, displacement and rotation vector, of a shell the
   * change of the director.
   */
  showShape(state, shape, factor) {
    this.showState(state);
    for (let node = 0; node < this.count; node++) {
      for (let k = 0; k < 3; k++) {
        const u = factor * shape[6 * node + k];
        this.displacement[3 * node + k] = u;
        this.position[3 * node + k] += u;
      }
      if (this.kind === "Shell") {
        for (let k = 0; k < 3; k++) this.triad[9 * node + 6 + k] += factor * shape[6 * node + 3 + k];
      } else {
        turnTriad(this.triad, 9 * node, factor, shape, 6 * node + 3);
      }
    }
  }
}

/** How far from its nodes a structure reaches [m]. */
function reachOf(outlines, body) {
  let reach = body ? bodyReach(body) : 0;
  const points = outlines ? outlines.points : [];
  for (let i = 0; i < points.length; i += 2) reach = Math.max(reach, Math.hypot(points[i], points[i + 1]));
  return reach;
}

/** Turns three vectors by a rotation vector, factor times the one that stands at `from`. */
function turnTriad(triad, place, factor, vectors, from) {
  const axis = new THREE.Vector3(vectors[from], vectors[from + 1], vectors[from + 2]);
  const angle = factor * axis.length();
  if (angle === 0) return;
  axis.normalize();
  const vector = new THREE.Vector3();
  for (let d = 0; d < 9; d += 3) {
    vector.fromArray(triad, place + d).applyAxisAngle(axis, angle).toArray(triad, place + d);
  }
}
