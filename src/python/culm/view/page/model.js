// A run as the page shows it: its structures, states and shapes.

class Model {
  constructor(data) {
    this.title = data.title;
    this.times = data.times;
    this.indices = data.indices;
    this.level = data.level;
    this.structures = data.structures.map((one) => new Structure(one));
    this.links = (data.links || []).map((one) => ({ ...one, ends: unpack(one.ends).values }));
    this.analyses = data.analyses.map((one) => new Analysis(one));
    this.state = 0;
    this.size = this.boxOfReference().getSize(new THREE.Vector3()).length() || 1;
    this.hasOrderedTimes = this.times.every((time, i) => i === 0 || time > this.times[i - 1]);
  }

  get moves() {
    return this.level.moves && this.times.length > 1 && this.hasOrderedTimes;
  }

  get hasLoads() {
    return this.links.length > 0 || this.structures.some((one) => one.loaded.length > 0);
  }

  get cellCount() {
    return this.structures.reduce((sum, one) => sum + one.cellCount, 0);
  }

  find(name) {
    return this.structures.find((one) => one.name === name) || null;
  }

  /** The box around all states. */
  boxOfAll() {
    const now = this.state;
    const box = this.boxOfReference();
    for (let state = 0; state < this.times.length; state++) {
      this.showState(state);
      box.union(this.boxNow());
    }
    this.showState(now);
    return box;
  }

  boxNow() {
    return boxAround(this.structures, (structure) => structure.position);
  }

  boxOfReference() {
    return boxAround(this.structures, (structure) => structure.reference);
  }

  /** The state whose time is next to one. */
  stateAt(time) {
    let best = 0;
    this.times.forEach((one, i) => {
      if (Math.abs(one - time) < Math.abs(this.times[best] - time)) best = i;
    });
    return best;
  }

  showState(state) {
    this.state = state;
    for (const structure of this.structures) structure.showState(state);
  }

  /** @param phase of the period [rad]  @param scale of the amplitude; 1 moves a tenth of the size */
  showShape(analysis, number, phase, scale) {
    this.state = analysis.base;
    const factor = scale * analysis.factor(number, this.size);
    for (const structure of this.structures) {
      structure.showShape(analysis.base, analysis.moment(structure, number, phase), factor);
    }
  }

  describe(state) {
    const { name, unit } = this.level;
    return `${name} ${readable(this.times[state])}${unit && ` ${unit}`} · state ${state + 1} of ${this.times.length}`;
  }
}

/** The box around structures whose nodes are at `places(structure)`, with what they reach beyond these. */
function boxAround(structures, places) {
  const box = new THREE.Box3();
  const own = new THREE.Box3();
  for (const structure of structures) {
    own.setFromArray(places(structure));
    box.union(own.expandByScalar(structure.reach));
  }
  return box;
}

/** Modes or buckling shapes. */
class Analysis {
  constructor(data) {
    this.name = data.name;
    this.base = data.base;
    this.shapes = data.shapes;
    const unpackAll = (sets) => new Map(Object.entries(sets).map(([name, set]) => [name, new Numbers(set)]));
    this.real = unpackAll(data.real);
    this.imaginary = unpackAll(data.imaginary);
    this.largest = new Map();
  }

  /** The shape of a structure at a phase, Re(shape exp(i phase)). */
  moment(structure, number, phase) {
    const size = 6 * structure.count;
    const out = new Float32Array(size);
    const real = this.real.get(structure.name), imaginary = this.imaginary.get(structure.name);
    if (real) for (let i = 0; i < size; i++) out[i] = Math.cos(phase) * real.at(number * size + i);
    if (imaginary) for (let i = 0; i < size; i++) out[i] -= Math.sin(phase) * imaginary.at(number * size + i);
    return out;
  }

  /** By which the largest displacement is a tenth of a size; of rotations alone a third of a radian. */
  factor(number, size) {
    const { move, turn } = this.amplitudes(number);
    const byTurn = turn > 0 ? 1 / (3 * turn) : 0;
    return move > 1e-6 * size * turn ? (0.1 * size) / move : byTurn;
  }

  /** The largest displacement and the largest rotation of a shape. */
  amplitudes(number) {
    if (this.largest.has(number)) return this.largest.get(number);
    let move = 0, turn = 0;
    for (const set of [...this.real.values(), ...this.imaginary.values()]) {
      const count = set.shape[1];
      for (let node = 0; node < count; node++) {
        const at = 6 * (number * count + node);
        move = Math.max(move, Math.hypot(set.at(at), set.at(at + 1), set.at(at + 2)));
        turn = Math.max(turn, Math.hypot(set.at(at + 3), set.at(at + 4), set.at(at + 5)));
      }
    }
    this.largest.set(number, { move, turn });
    return { move, turn };
  }
}
