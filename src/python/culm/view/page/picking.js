// Finds the element and the node under the pointer, and marks what is picked.

const PICKED_COLOUR = 0xe91e8c;

/** What lies under a point of the canvas, or null. @param drawn  structures in the scene */
function pickAt(drawn, camera, canvas, event) {
  const frame = canvas.getBoundingClientRect();
  const pointer = new THREE.Vector2(
    ((event.clientX - frame.left) / frame.width) * 2 - 1, 1 - ((event.clientY - frame.top) / frame.height) * 2,
  );
  const ray = new THREE.Raycaster();
  ray.setFromCamera(pointer, camera.eye);
  let nearest = null;
  for (const one of drawn) {
    one.mesh.geometry.boundingSphere = null; // it has moved
    const [hit] = ray.intersectObject(one.mesh);
    if (hit && (nearest === null || hit.distance < nearest.hit.distance)) nearest = { one, hit };
  }
  if (nearest === null) return null;
  const { one, hit } = nearest;
  const { cells, nodes } = one.surface;
  const corner = new THREE.Vector3();
  const [vertex] = [hit.face.a, hit.face.b, hit.face.c]
    .map((v) => [v, corner.fromArray(one.places.array, 3 * v).distanceTo(hit.point)])
    .sort((a, b) => a[1] - b[1])[0];
  return { structure: one.structure, cell: cells[hit.face.a], node: nodes[vertex] };
}

/** The mark on a picked element and node. */
class PickMark {
  constructor(scene, symbol) {
    this.scene = scene;
    this.ball = new THREE.Mesh(
      new THREE.SphereBufferGeometry(symbol * 0.45, 16, 12), new THREE.MeshBasicMaterial({ color: PICKED_COLOUR }),
    );
    this.ball.visible = false;
    this.face = null;
    this.pick = null;
    scene.add(this.ball);
  }

  /** @param drawn  the structure of the pick in the scene, or null for no pick */
  set(pick, drawn) {
    if (this.face) this.scene.remove(this.face);
    this.face = null;
    this.pick = pick;
    this.ball.visible = pick !== null && pick.node !== null;
    if (pick === null || pick.cell === null) return;
    const { cells, triangles } = drawn.surface;
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", drawn.places);
    const index = [];
    for (let i = 0; i < triangles.length; i += 3) {
      if (cells[triangles[i]] === pick.cell) index.push(triangles[i], triangles[i + 1], triangles[i + 2]);
    }
    geometry.setIndex(index);
    const material = surfaceMaterial({ color: PICKED_COLOUR, transparent: true, opacity: 0.75, polygonOffsetFactor: 0, polygonOffsetUnits: 0 });
    this.face = new THREE.Mesh(geometry, material);
    this.face.frustumCulled = false;
    this.scene.add(this.face);
  }

  move() {
    if (this.ball.visible) this.ball.position.fromArray(this.pick.structure.position, 3 * this.pick.node);
  }
}
