// Directors at the nodes, and marks of supports and joints.

const DIRECTOR_COLOURS = [0xc0392b, 0x27903f, 0x2456c4];
const MOST_DIRECTORS = 4000;
const MOST_MARKS = 200; // of one constraint

/** What a constraint is by the name of its type: how it is marked. */
function kindOfConstraint(type) {
  if (/Support|Symmetry|^Rotation|Director/.test(type)) return "support";
  if (/Joint|Weld|Angular Velocity/.test(type)) return "joint";
  return "connection";
}

const MARK_COLOURS = { support: 0x3b4754, joint: 0xd9730d, connection: 0x7a5195 };

/** The directors of a structure as lines at its nodes. */
class Directors {
  constructor(structure, length) {
    this.structure = structure;
    this.length = length;
    this.stride = Math.ceil(structure.count / MOST_DIRECTORS);
    this.nodes = Math.ceil(structure.count / this.stride);
    const count = 2 * this.nodes * structure.directors.length;
    this.places = new THREE.BufferAttribute(new Float32Array(3 * count), 3);
    const colours = new Float32Array(3 * count);
    for (let v = 0; v < count; v++) {
      const director = structure.directors[Math.floor(v / 2) % structure.directors.length];
      new THREE.Color(DIRECTOR_COLOURS[director - 1]).toArray(colours, 3 * v);
    }
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", this.places);
    geometry.setAttribute("color", new THREE.BufferAttribute(colours, 3));
    this.lines = new THREE.LineSegments(geometry, new THREE.LineBasicMaterial({ vertexColors: THREE.VertexColors }));
    this.lines.frustumCulled = false;
    this.lines.visible = false;
  }

  move() {
    if (!this.lines.visible) return;
    const { position, triad, directors } = this.structure;
    const out = this.places.array;
    let at = 0;
    for (let i = 0; i < this.nodes; i++) {
      const node = i * this.stride;
      for (const director of directors) {
        for (let k = 0; k < 3; k++, at++) {
          out[at] = position[3 * node + k];
          out[at + 3] = out[at] + this.length * triad[9 * node + 3 * (director - 1) + k];
        }
        at += 3;
      }
    }
    this.places.needsUpdate = true;
  }
}

/** Marks at the nodes that supports and joints act on. */
class Marks {
  constructor(structure, size, up) {
    this.structure = structure;
    this.group = new THREE.Group();
    this.marks = [];
    const turn = new THREE.Quaternion().setFromUnitVectors(new THREE.Vector3(0, 1, 0), up);
    for (const held of structure.held) {
      const kind = kindOfConstraint(held.type);
      const geometry = markOf(kind, size);
      const material = new THREE.MeshPhongMaterial({ color: MARK_COLOURS[kind], flatShading: true, specular: 0 });
      const stride = Math.ceil(held.nodes.length / MOST_MARKS);
      for (let i = 0; i < held.nodes.length; i += stride) {
        const mark = new THREE.Mesh(geometry, material);
        mark.quaternion.copy(turn);
        this.marks.push([held.nodes[i], mark]);
        this.group.add(mark);
      }
    }
  }

  move() {
    for (const [node, mark] of this.marks) mark.position.fromArray(this.structure.position, 3 * node);
  }
}

/** Supports are pyramids below the node, joints balls, connections cubes. */
function markOf(kind, size) {
  if (kind === "support") return new THREE.CylinderBufferGeometry(0, size, 1.6 * size, 4).translate(0, -0.8 * size, 0);
  if (kind === "joint") return new THREE.IcosahedronBufferGeometry(0.8 * size, 1);
  return new THREE.BoxBufferGeometry(size, size, size);
}

/** Lists things by their names, with the colours of their marks. @param things  [{name, type}] */
function listThings(section, things, colour) {
  const list = document.getElementById(`${section}-list`);
  const seen = new Set();
  for (const { name, type } of things) {
    if (seen.has(name)) continue;
    seen.add(name);
    const line = document.createElement("li");
    const swatch = document.createElement("span");
    swatch.className = "swatch";
    swatch.style.background = `#${new THREE.Color(colour(type)).getHexString()}`;
    line.append(swatch, `${name} (${type})`);
    list.append(line);
  }
  document.getElementById(section).hidden = seen.size === 0;
}

function listHeld(structures) {
  listThings("held", structures.flatMap((one) => one.held), (type) => MARK_COLOURS[kindOfConstraint(type)]);
}
