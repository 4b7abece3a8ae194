// A structure in the scene: its surface, its mesh and the outline of its reference.

class DrawnStructure {
  constructor(structure, symbol, texture, isGhost) {
    this.structure = structure;
    this.surface = surfaceOf(structure, symbol);
    this.group = new THREE.Group();
    const geometry = new THREE.BufferGeometry();
    this.places = new THREE.BufferAttribute(new Float32Array(3 * this.surface.size), 3);
    this.values = new THREE.BufferAttribute(new Float32Array(2 * this.surface.size).fill(0.5), 2);
    geometry.setAttribute("position", this.places);
    geometry.setAttribute("uv", this.values);
    geometry.setIndex(new THREE.BufferAttribute(new Uint32Array(this.surface.triangles), 1));
    this.coloured = surfaceMaterial({ map: texture });
    this.plain = surfaceMaterial(
      isGhost ? { color: GHOST, transparent: true, opacity: 0.35, depthWrite: false } : { color: PLAIN },
    );
    this.mesh = new THREE.Mesh(geometry, this.plain);
    this.mesh.frustumCulled = false;
    this.lines = this.makeLines(this.places, isGhost ? GHOST : 0x2b2f36, isGhost ? 0.5 : 0.45);
    this.group.add(this.mesh, this.lines);
    this.reference = null;
  }

  makeLines(places, colour, opacity) {
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", places);
    geometry.setIndex(new THREE.BufferAttribute(new Uint32Array(this.surface.lines), 1));
    const material = new THREE.LineBasicMaterial({ color: colour, transparent: true, opacity });
    const lines = new THREE.LineSegments(geometry, material);
    lines.frustumCulled = false;
    return lines;
  }

  /** Moves it to where its nodes are. */
  move() {
    this.surface.place(this.structure, this.places.array);
    this.places.needsUpdate = true;
  }

  /**
   * Colours it by numbers of its nodes or cells between low and high; plain where `field` is null, grey
   * where the structure has no such numbers.
   */
  colour(field, values, low, high) {
    this.mesh.material = values === null ? this.plain : this.coloured;
    this.plain.color.set(field === null ? PLAIN : WITHOUT);
    if (values === null) return;
    const { nodes, cells } = this.surface;
    const owner = field.on === "nodes" ? nodes : cells;
    const scale = high > low ? 1 / (high - low) : 0;
    const out = this.values.array;
    for (let v = 0; v < owner.length; v++) {
      const share = scale === 0 ? 0.5 : (values[owner[v]] - low) * scale;
      // half a texel from the ends, where the texture would be cut
      out[2 * v] = Math.min(Math.max(share, 0.002), 0.998);
    }
    this.values.needsUpdate = true;
  }

  /** Draws or hides the reference. */
  showReference(isShown) {
    if (isShown && this.reference === null) {
      const still = new THREE.BufferAttribute(new Float32Array(this.places.array.length), 3);
      const { reference, referenceTriad } = this.structure;
      this.surface.place({ position: reference, triad: referenceTriad }, still.array);
      this.reference = this.makeLines(still, 0x555555, 0.35);
      if (this.surface.lines.length === 0) this.reference.geometry.setIndex(this.surface.triangles);
      this.group.add(this.reference);
    }
    if (this.reference !== null) this.reference.visible = isShown;
  }
}

function surfaceMaterial(options) {
  return new THREE.MeshPhongMaterial({
    flatShading: true,
    side: THREE.DoubleSide,
    specular: 0x000000,
    // keeps the lines of the mesh in front
    polygonOffset: true,
    polygonOffsetFactor: 1,
    polygonOffsetUnits: 1,
    ...options,
  });
}

