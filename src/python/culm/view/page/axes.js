// The axes of space in the corner of the picture.

const AXES_PIXELS = 110;

class Axes {
  constructor() {
    this.scene = new THREE.Scene();
    this.eye = new THREE.OrthographicCamera(-1.5, 1.5, 1.5, -1.5, 0.1, 10);
    ["x", "y", "z"].forEach((name, k) => {
      const direction = new THREE.Vector3().setComponent(k, 1);
      const colour = DIRECTOR_COLOURS[k];
      this.scene.add(new THREE.ArrowHelper(direction, new THREE.Vector3(), 1, colour, 0.25, 0.14));
      const label = labelSprite(name, colour);
      label.position.copy(direction).multiplyScalar(1.25);
      this.scene.add(label);
    });
  }

  draw(renderer, camera) {
    const offset = camera.eye.position.clone().sub(camera.orbit.target).setLength(5);
    this.eye.position.copy(offset);
    this.eye.up.copy(camera.eye.up);
    this.eye.lookAt(0, 0, 0);
    renderer.setViewport(0, 0, AXES_PIXELS, AXES_PIXELS);
    renderer.clearDepth();
    renderer.render(this.scene, this.eye);
  }
}

function labelSprite(text, colour) {
  const canvas = document.createElement("canvas");
  canvas.width = canvas.height = 64;
  const pen = canvas.getContext("2d");
  pen.font = "600 48px system-ui, sans-serif";
  pen.textAlign = "center";
  pen.textBaseline = "middle";
  pen.fillStyle = `#${new THREE.Color(colour).getHexString()}`;
  pen.fillText(text, 32, 32);
  const sprite = new THREE.Sprite(new THREE.SpriteMaterial({ map: new THREE.CanvasTexture(canvas) }));
  sprite.scale.set(0.5, 0.5, 1);
  return sprite;
}
