// Loads of a model that is not solved yet: arrows that end at the nodes.

const FORCE_COLOUR = 0xc1121f;
const MOMENT_COLOUR = 0x6a4c93;
const MOST_ARROWS = 600; // of one load and structure

/** Forces have one head, moments two; the largest of each load has the same length. */
class Loads {
  constructor(structures, length) {
    this.group = new THREE.Group();
    this.length = length;
    const all = structures.flatMap((one) => one.loaded);
    const largest = new Map();
    for (const load of all) {
      const sizes = [0, 3].map((part) => largestOf(load.actions, part));
      const before = largest.get(load.name) || [0, 0];
      largest.set(load.name, sizes.map((size, i) => Math.max(size, before[i])));
    }
    for (const structure of structures) {
      for (const load of structure.loaded) this.add(structure, load, largest.get(load.name));
    }
  }

  add(structure, { nodes, actions }, [force, moment]) {
    const stride = Math.ceil(nodes.length / MOST_ARROWS);
    for (let i = 0; i < nodes.length; i += stride) {
      const tip = new THREE.Vector3().fromArray(structure.reference, 3 * nodes[i]);
      this.addArrow(tip, new THREE.Vector3().fromArray(actions, 6 * i), force, FORCE_COLOUR, 1);
      this.addArrow(tip, new THREE.Vector3().fromArray(actions, 6 * i + 3), moment, MOMENT_COLOUR, 2);
    }
  }

  addArrow(tip, vector, largest, colour, heads) {
    const share = vector.length() / largest;
    if (!(share > 1e-3)) return; // rounding, or nothing
    const length = share * this.length, head = Math.min(0.2 * this.length, 0.45 * length);
    const material = new THREE.MeshBasicMaterial({ color: colour });
    const arrow = new THREE.Group();
    const add = (geometry, place) => {
      const part = new THREE.Mesh(geometry, material);
      part.position.y = place;
      arrow.add(part);
    };
    add(new THREE.CylinderBufferGeometry(0.08 * head, 0.08 * head, length - head, 6), -head - (length - head) / 2);
    for (let i = 0; i < heads; i++) add(new THREE.ConeBufferGeometry(0.28 * head, head, 12), -head * (0.5 + 0.8 * i));
    arrow.position.copy(tip);
    arrow.quaternion.setFromUnitVectors(new THREE.Vector3(0, 1, 0), vector.normalize());
    this.group.add(arrow);
  }
}

/** The longest vector of rows of six numbers, from a column on. */
function largestOf(actions, column) {
  let most = 0;
  for (let i = column; i < actions.length; i += 6) most = Math.max(most, Math.hypot(...actions.subarray(i, i + 3)));
  return most;
}

function listLoads(structures) {
  listThings("loaded", structures.flatMap((one) => one.loaded), (type) => (/Moment/.test(type) ? MOMENT_COLOUR : FORCE_COLOUR));
}
