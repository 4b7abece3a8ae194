// Colours of numbers, and their bar.

// viridis, perceptually uniform and safe for the colour-blind: every 17th of its 256 colours.
const COLOUR_MAP = [
  "#440154", "#481a6c", "#472f7d", "#414487", "#39568c", "#31688e", "#2a788e", "#23888e",
  "#1f988b", "#22a884", "#35b779", "#54c568", "#7ad151", "#a5db36", "#d2e21b", "#fde725",
];
const PLAIN = 0x8fb0cc;
const WITHOUT = 0xc9c9c9; // what has no number of this kind
const GHOST = 0xd08770;

/** The map as a texture, of which the first coordinate is the number between least and greatest. */
function colourTexture() {
  const size = 256;
  const texels = new Uint8Array(3 * size);
  const colour = new THREE.Color(), next = new THREE.Color();
  for (let i = 0; i < size; i++) {
    const place = (i / (size - 1)) * (COLOUR_MAP.length - 1);
    const k = Math.min(Math.floor(place), COLOUR_MAP.length - 2);
    colour.set(COLOUR_MAP[k]).lerp(next.set(COLOUR_MAP[k + 1]), place - k);
    [colour.r, colour.g, colour.b].forEach((c, j) => (texels[3 * i + j] = Math.round(255 * c)));
  }
  const texture = new THREE.DataTexture(texels, size, 1, THREE.RGBFormat);
  texture.minFilter = texture.magFilter = THREE.LinearFilter;
  texture.needsUpdate = true;
  return texture;
}

/** White that darkens downwards. */
function backgroundTexture() {
  const canvas = document.createElement("canvas");
  canvas.width = 1;
  canvas.height = 256;
  const pen = canvas.getContext("2d");
  const gradient = pen.createLinearGradient(0, 0, 0, 256);
  gradient.addColorStop(0, "#ffffff");
  gradient.addColorStop(1, "#eceef1");
  pen.fillStyle = gradient;
  pen.fillRect(0, 0, 1, 256);
  const texture = new THREE.CanvasTexture(canvas);
  texture.minFilter = THREE.LinearFilter;
  return texture;
}

/** A number to read: three to five digits. */
function readable(value) {
  if (value === 0) return "0";
  const size = Math.abs(value);
  if (size >= 1e5 || size < 1e-3) return value.toExponential(3).replace("e+", "e").replace("-", "−");
  return String(Number(value.toPrecision(5))).replace("-", "−");
}

/** Writes the bar; hides it where nothing is coloured. */
function showBar(field, low, high) {
  const bar = document.getElementById("bar");
  bar.hidden = field === null;
  if (field === null) return;
  document.getElementById("bar-title").textContent = field.label;
  const canvas = bar.querySelector("canvas");
  const pen = canvas.getContext("2d");
  const gradient = pen.createLinearGradient(0, 256, 0, 0);
  COLOUR_MAP.forEach((colour, i) => gradient.addColorStop(i / (COLOUR_MAP.length - 1), colour));
  pen.fillStyle = gradient;
  pen.fillRect(0, 0, 1, 256);
  const ticks = document.getElementById("bar-ticks");
  ticks.textContent = "";
  const count = high > low ? 5 : 1;
  for (let i = count - 1; i >= 0; i--) {
    const tick = document.createElement("li");
    tick.textContent = readable(low + ((high - low) * i) / 4);
    ticks.append(tick);
  }
}
