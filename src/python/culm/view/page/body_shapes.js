// Surfaces of rigid bodies in the directors of their node.

/** A geometry of three.js for what the deck says of a body. `symbol` is the size of marks [m]. */
function bodyGeometry(body, symbol) {
  switch (body.kind) {
    case "box":
      return new THREE.BoxBufferGeometry(...body.size);
    case "sphere":
      return new THREE.SphereBufferGeometry(body.radius, 32, 20);
    case "cylinder":
      // three.js has them along y
      return new THREE.CylinderBufferGeometry(body.radius, body.radius, body.height, 40).rotateX(Math.PI / 2);
    case "cone":
      return new THREE.CylinderBufferGeometry(0, body.radius, body.height, 40)
        .rotateX(Math.PI / 2)
        .translate(0, 0, body.height / 2);
    default:
      return markerGeometry(body.centre, symbol);
  }
}

/** The largest distance of such a surface from the node [m]. */
function bodyReach(body) {
  switch (body.kind) {
    case "box":
      return Math.hypot(...body.size) / 2;
    case "sphere":
      return body.radius;
    case "cylinder":
      return Math.hypot(body.radius, body.height / 2);
    case "cone":
      return Math.hypot(body.radius, body.height);
    default:
      return Math.hypot(...body.centre);
  }
}

/** A cube at the centre of mass, which shows that it turns, and a bar from the node to it. */
function markerGeometry(centre, symbol) {
  const cube = new THREE.BoxBufferGeometry(symbol, symbol, symbol).translate(...centre);
  const arm = new THREE.Vector3(...centre);
  const length = arm.length();
  if (length < symbol) return cube;
  const bar = new THREE.CylinderBufferGeometry(symbol / 6, symbol / 6, length, 8).translate(0, length / 2, 0);
  const turn = new THREE.Quaternion().setFromUnitVectors(new THREE.Vector3(0, 1, 0), arm.normalize());
  bar.applyMatrix(new THREE.Matrix4().makeRotationFromQuaternion(turn));
  return joinGeometries([cube, bar]);
}

function joinGeometries(parts) {
  const positions = [], index = [];
  for (const part of parts) {
    const first = positions.length / 3;
    positions.push(...part.attributes.position.array);
    index.push(...Array.from(part.index.array, (i) => first + i));
  }
  const joined = new THREE.BufferGeometry();
  joined.setAttribute("position", new THREE.BufferAttribute(new Float32Array(positions), 3));
  joined.setIndex(index);
  return joined;
}
