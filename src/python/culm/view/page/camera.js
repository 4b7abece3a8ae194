// Where the model is seen from.

// that the colour bar and the title take
const BAR_PIXELS = 130;
const TITLE_PIXELS = 50;

/** What points up where nothing tells: across a shallow shell, within a plane, otherwise z. */
function naturalUp(model, box) {
  const size = box.getSize(new THREE.Vector3()).toArray();
  const order = [0, 1, 2].sort((a, b) => size[a] - size[b]);
  const up = (axis) => new THREE.Vector3().setComponent(axis, 1);
  if (model.structures.every((one) => one.kind === "Shell") && size[order[0]] < 0.3 * size[order[1]]) return up(order[0]);
  return order[0] === 2 && size[2] < 0.02 * size[order[1]] ? up(1) : up(2);
}

class Camera {
  constructor(canvas, up, whenMoved) {
    this.eye = new THREE.PerspectiveCamera(30, 1, 0.1, 1000);
    this.eye.up.copy(up);
    this.up = up;
    this.orbit = new THREE.OrbitControls(this.eye, canvas);
    this.orbit.enableKeys = false;
    this.orbit.addEventListener("change", () => {
      this.clip();
      whenMoved();
    });
    const light = new THREE.DirectionalLight(0xffffff, 0.4);
    light.position.set(0.4, 0.8, 1);
    this.eye.add(light);
  }

  /** Two directions that are level, and the one that points up. */
  basis() {
    const { up } = this;
    const start = Math.abs(up.x) < 0.8 ? new THREE.Vector3(1, 0, 0) : new THREE.Vector3(0, 1, 0);
    const first = start.addScaledVector(up, -start.dot(up)).normalize();
    return [first, new THREE.Vector3().crossVectors(up, first), up];
  }

  /** Where to look from first: across what is flat, otherwise from a corner. */
  firstDirection(box) {
    const [first, second, up] = this.basis();
    const size = box.getSize(new THREE.Vector3());
    const extents = [first, second, up].map((axis) => Math.abs(size.dot(axis.clone().set(...axis.toArray().map(Math.abs)))));
    const most = Math.max(...extents);
    const direction = new THREE.Vector3();
    if (extents[1] < 0.02 * most) return direction.addScaledVector(second, -1).addScaledVector(up, 0.2).addScaledVector(first, 0.2);
    if (extents[0] < 0.02 * most) return direction.addScaledVector(first, 1).addScaledVector(up, 0.2).addScaledVector(second, -0.2);
    return direction.addScaledVector(first, 0.55).addScaledVector(second, -1).addScaledVector(up, 0.6);
  }

  /** Looks at a box along a direction, from where all of it is seen. */
  look(box, direction) {
    const target = box.getCenter(new THREE.Vector3());
    const back = direction.clone().normalize();
    const side = new THREE.Vector3().crossVectors(this.up, back);
    if (side.length() < 1e-6) side.copy(this.basis()[0]);
    side.normalize();
    const upward = new THREE.Vector3().crossVectors(back, side);
    const half = Math.tan((this.eye.fov * Math.PI) / 360);
    const height = half * (1 - TITLE_PIXELS / this.height);
    const width = half * this.eye.aspect * (1 - BAR_PIXELS / this.width);
    let distance = 1e-6;
    for (let corner = 0; corner < 8; corner++) {
      const arm = new THREE.Vector3(
        corner & 1 ? box.max.x : box.min.x, corner & 2 ? box.max.y : box.min.y, corner & 4 ? box.max.z : box.min.z,
      ).sub(target);
      const reach = Math.max(Math.abs(arm.dot(side)) / width, Math.abs(arm.dot(upward)) / height);
      distance = Math.max(distance, arm.dot(back) + reach);
    }
    this.orbit.target.copy(target);
    this.eye.position.copy(target).addScaledVector(back, 1.14 * distance);
    this.clip();
    this.orbit.update();
  }

  shift(arm) {
    this.eye.position.add(arm);
    this.orbit.target.add(arm);
    this.orbit.update();
  }

  clip() {
    const distance = this.eye.position.distanceTo(this.orbit.target);
    this.eye.near = distance / 100;
    this.eye.far = distance * 100;
    this.eye.updateProjectionMatrix();
  }

  resize(width, height) {
    Object.assign(this, { width, height });
    this.eye.aspect = width / height;
    this.eye.setViewOffset(width, height, BAR_PIXELS / 2, -TITLE_PIXELS / 2, width, height);
  }

  /** Position and target as six numbers, to keep and to take up. */
  get numbers() {
    return [...this.eye.position.toArray(), ...this.orbit.target.toArray()].map((x) => Number(x.toPrecision(5)));
  }
  set numbers(numbers) {
    this.eye.position.fromArray(numbers, 0);
    this.orbit.target.fromArray(numbers, 3);
    this.clip();
    this.orbit.update();
  }
}
