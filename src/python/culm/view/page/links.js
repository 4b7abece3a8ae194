// Springs, dampers, drives and mooring lines of a model that is not solved yet.

const LINK_COLOUR = 0x1a7f7f;
const MOST_LINKS = 2000; // of one entry of the deck
const WINDINGS = 7;

/** A zigzag between both ends; a double pyramid where both are one place, as of a spring to the ground. */
class Links {
  constructor(links, size, up) {
    this.group = new THREE.Group();
    const material = new THREE.LineBasicMaterial({ color: LINK_COLOUR });
    const solid = new THREE.MeshPhongMaterial({ color: LINK_COLOUR, flatShading: true, specular: 0 });
    const mark = new THREE.OctahedronBufferGeometry(0.7 * size);
    for (const { type, ends } of links) {
      const places = [];
      const count = ends.length / 6, stride = Math.ceil(count / MOST_LINKS);
      for (let i = 0; i < count; i += stride) {
        const from = new THREE.Vector3().fromArray(ends, 6 * i), to = new THREE.Vector3().fromArray(ends, 6 * i + 3);
        if (from.distanceTo(to) > 0.5 * size) {
          places.push(...zigzag(from, to, /Catenary/.test(type) ? 0 : 0.8 * size, up));
        } else {
          const at = new THREE.Mesh(mark, solid);
          at.position.copy(to);
          this.group.add(at);
        }
      }
      if (places.length === 0) continue;
      const geometry = new THREE.BufferGeometry().setFromPoints(places);
      this.group.add(new THREE.LineSegments(geometry, material));
    }
  }
}

/** Pairs of points of the line from end to end, straight in its outer fifths. */
function zigzag(from, to, width, up) {
  const along = to.clone().sub(from);
  let across = along.clone().cross(up);
  if (across.length() < 1e-6 * along.length()) across = along.clone().cross(new THREE.Vector3(up.y, up.z, up.x));
  across.setLength(width);
  const points = [from];
  for (let i = 0; width > 0 && i <= WINDINGS; i++) {
    const side = i === 0 || i === WINDINGS ? 0 : i % 2 === 0 ? 1 : -1;
    points.push(from.clone().addScaledVector(along, 0.2 + (0.6 * i) / WINDINGS).addScaledVector(across, side));
  }
  points.push(to);
  return points.slice(1).flatMap((point, i) => [points[i], point]);
}

function listLinks(links) {
  listThings("linked", links, () => LINK_COLOUR);
}
