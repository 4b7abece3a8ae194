// Puts the parts together: the view is changed, the model follows, the picture is drawn.

const MOST_WITH_MESH = 20000; // elements; lines of more hide the colours

class Viewer {
  constructor(data) {
    this.model = new Model(data.run);
    this.ghost = data.ghost && new Model(data.ghost);
    this.fields = fieldsOf(this.model);
    this.symbol = 0.016 * this.model.size;
    this.box = this.model.boxOfAll().expandByScalar(this.symbol);
    this.first = this.firstView();
    this.view = { ...this.first, pick: null };
    this.ranges = new Map();
    this.buildScene(data.run.up);
    this.tell(data);
    this.controls = new Controls(this.model, this.ghost, this.fields, (changes) => this.change(changes), (name) => this.lookFrom(name));
    this.timeline = new Timeline((place) => this.change(this.view.shape ? { phase: place } : { state: place }));
    this.inspector = new Inspector(this.model, this.ghost, this.fields);
    this.listen();
    this.resize();
    this.takeAddress();
  }

  /** The state at the end, or the first shape where there is no motion. */
  firstView() {
    const { times, analyses, size } = this.model;
    const travel = this.box.getSize(new THREE.Vector3()).length();
    const isStill = times.length < 2 && analyses.length > 0;
    return {
      state: times.length - 1,
      shape: isStill ? `${analyses[0].name}/1` : "",
      phase: 0,
      scale: 0,
      field: this.model.hasLoads ? "" : "displacement",
      range: "all",
      mesh: this.model.cellCount < MOST_WITH_MESH,
      marks: true,
      loads: true,
      directors: false,
      reference: isStill,
      follow: travel > 2 * size,
      ghost: this.ghost !== null,
    };
  }

  buildScene(up) {
    this.canvas = document.getElementById("picture");
    this.renderer = new THREE.WebGLRenderer({ canvas: this.canvas, antialias: true, preserveDrawingBuffer: true });
    this.renderer.setPixelRatio(window.devicePixelRatio);
    this.renderer.autoClear = false;
    this.scene = new THREE.Scene();
    this.scene.background = backgroundTexture();
    this.scene.add(new THREE.AmbientLight(0xffffff, 0.8));
    const { symbol } = this;
    const upward = up ? new THREE.Vector3(...up) : naturalUp(this.model, this.box);
    this.camera = new Camera(this.canvas, upward, () => {
      this.cameraMoved = true;
      this.redraw();
    });
    this.scene.add(this.camera.eye);
    const texture = colourTexture();
    const draw = (model, isGhost) => model.structures.map((one) => new DrawnStructure(one, symbol, texture, isGhost));
    this.drawn = draw(this.model, false);
    this.ghosts = this.ghost ? draw(this.ghost, true) : [];
    this.directors = this.model.structures.map((one) => new Directors(one, 2 * symbol));
    this.marks = this.model.structures.map((one) => new Marks(one, 0.8 * symbol, upward));
    this.loads = new Loads(this.model.structures, 7 * symbol);
    this.links = new Links(this.model.links, symbol, upward);
    for (const one of [...this.drawn, ...this.ghosts, ...this.marks, this.loads, this.links]) this.scene.add(one.group);
    for (const one of this.directors) this.scene.add(one.lines);
    this.pickMark = new PickMark(this.scene, symbol);
    this.axes = new Axes();
  }

  tell({ run, ghost }) {
    const put = (id, text) => (document.getElementById(id).textContent = text);
    put("title", run.title);
    put("subtitle", `${run.folder}, culm ${run.version}${ghost ? ` – with ${ghost.folder} in orange` : ""}`);
    const isBare = this.model.structures.some((one) => one.kind === "Beam" && one.outlines === null);
    const notes = [...run.notes];
    if (ghost) notes.push(...[...ghost.broken, ...ghost.notes].map((note) => `Other run: ${note}`));
    for (const sentence of run.broken) addNote(`A promise is broken: ${sentence}`, "broken");
    for (const note of notes) addNote(note);
    if (isBare) addNote("Beams without an outline are drawn as thin rods.", "plain");
    listHeld(this.model.structures);
    listLoads(this.model.structures);
    listLinks(this.model.links);
  }

  listen() {
    new ResizeObserver(() => this.resize()).observe(this.canvas.parentElement);
    window.addEventListener("hashchange", () => this.takeAddress());
    let down = null;
    this.canvas.addEventListener("pointerdown", (event) => (down = [event.clientX, event.clientY]));
    this.canvas.addEventListener("pointerup", (event) => {
      const isClick = down && Math.hypot(event.clientX - down[0], event.clientY - down[1]) < 4;
      if (isClick && event.button === 0) this.change({ pick: pickAt(this.drawn, this.camera, this.canvas, event) });
    });
    this.camera.orbit.addEventListener("end", () => this.keepAddress());
  }

  takeAddress() {
    const { camera, ...changes } = readAddress(this.model);
    this.centre = null; // nothing to follow yet
    this.change({ ...this.first, pick: null, ...changes });
    if (camera) this.camera.numbers = camera;
    else this.lookFrom("all");
    this.cameraMoved = camera !== undefined;
    this.keepAddress();
  }

  keepAddress() {
    writeAddress(this.model, this.view, this.first, this.cameraMoved ? this.camera.numbers : null);
  }

  /** From a side such as "+x" at all states, from the first direction, or nearer at what is shown. */
  lookFrom(name) {
    const direction = new THREE.Vector3().subVectors(this.camera.eye.position, this.camera.orbit.target);
    const axis = "xyz".indexOf(name[1]);
    if (name === "all") direction.copy(this.camera.firstDirection(this.box));
    else if (name !== "this state") direction.set(0, 0, 0).setComponent(axis, name[0] === "+" ? 1 : -1);
    const isNear = name === "this state" || this.view.follow;
    this.camera.look(isNear ? this.model.boxNow() : this.box, direction);
    this.keepAddress();
  }

  /** Takes over changes of the view; those that make no sense for this run fall back to the first view. */
  change(changes) {
    Object.assign(this.view, changes);
    const { view } = this;
    this.shape = this.findShape(view.shape);
    if (this.shape === null) view.shape = "";
    this.field = this.fields.find((one) => one.key === view.field) || null;
    if (this.shape && !(this.field instanceof DisplacementField)) this.field = view.field && this.fields[0];
    this.field = this.field || null;
    view.field = this.field ? this.field.key : "";
    this.moveModels();
    this.follow();
    this.update(view);
    if (!this.timeline.isPlaying) this.keepAddress();
    this.redraw();
  }

  /** "modes/3" as analysis and number from 0; null if there is none. */
  findShape(text) {
    const at = text.lastIndexOf("/");
    const analysis = this.model.analyses.find((one) => one.name === text.slice(0, at));
    const number = Number(text.slice(at + 1)) - 1;
    return analysis && analysis.shapes[number] !== undefined ? { analysis, number } : null;
  }

  moveModels() {
    const { view, model, ghost } = this;
    if (this.shape) {
      const phase = (2 * Math.PI * view.phase) / PHASES;
      model.showShape(this.shape.analysis, this.shape.number, phase, 2 ** view.scale);
      const twin = ghost && ghost.analyses.find((one) => one.name === this.shape.analysis.name);
      if (twin && twin.shapes[this.shape.number]) ghost.showShape(twin, this.shape.number, phase, 2 ** view.scale);
    } else {
      model.showState(view.state);
      if (ghost) ghost.showState(this.stateOfGhost());
    }
  }

  /** Keeps the model where it is in the picture. */
  follow() {
    const centre = this.view.follow ? this.model.boxNow().getCenter(new THREE.Vector3()) : null;
    if (centre && this.centre) this.camera.shift(centre.clone().sub(this.centre));
    this.centre = centre;
  }

  /** At the same time, or the same share of all states where times do not rise. */
  stateOfGhost() {
    const { model, ghost, view } = this;
    if (model.hasOrderedTimes && ghost.hasOrderedTimes) return ghost.stateAt(model.times[view.state]);
    return Math.round((view.state / Math.max(model.times.length - 1, 1)) * (ghost.times.length - 1));
  }

  update(view) {
    const values = this.drawn.map(({ structure }) => (this.field ? this.field.values(structure) : null));
    const [low, high] = this.field ? this.range(this.field) : [0, 0];
    this.drawn.forEach((one, i) => {
      one.move();
      one.colour(this.field, values[i], low, high);
      one.lines.visible = view.mesh;
      one.showReference(view.reference);
    });
    for (const one of this.ghosts) {
      one.group.visible = view.ghost;
      one.move();
    }
    this.directors.forEach((one) => {
      one.lines.visible = view.directors;
      one.move();
    });
    this.marks.forEach((one) => {
      one.group.visible = view.marks;
      one.move();
    });
    this.loads.group.visible = view.loads;
    this.links.group.visible = view.loads;
    this.movePick(view.pick);
    this.showBar(low, high);
    this.controls.show(view);
    const place = this.shape ? view.phase : view.state;
    this.timeline.set(this.shape ? PHASES : this.model.times.length, this.shape !== null, place, this.timeText());
    this.inspector.show(view.pick, this.field, this.shape !== null);
  }

  movePick(pick) {
    if (pick !== this.pickMark.pick) {
      this.pickMark.set(pick, pick && this.drawn.find((one) => one.structure === pick.structure));
    }
    this.pickMark.move();
  }

  /** Shapes have no size of their own: their largest displacement counts as 1. */
  showBar(low, high) {
    if (this.field === null || this.shape === null) showBar(this.field, low, high);
    else showBar({ label: `${this.field.key}, relative` }, low < 0 ? -1 : 0, 1);
  }

  timeText() {
    if (this.shape === null) return this.model.describe(this.view.state);
    return `phase ${Math.round((360 * this.view.phase) / PHASES)}°`;
  }

  /** Least and greatest number that colours stand for. */
  range(field) {
    if (this.shape) return this.rangeOfShape(field);
    if (this.view.range === "one") return rangeNow(field, this.model.structures);
    if (!this.ranges.has(field)) this.ranges.set(field, this.rangeOfAll(field));
    return this.ranges.get(field);
  }

  rangeOfAll(field) {
    const now = this.model.state;
    let low = Infinity, high = -Infinity;
    for (let state = 0; state < this.model.times.length; state++) {
      this.model.showState(state);
      const [least, greatest] = rangeNow(field, this.model.structures);
      low = Math.min(low, least);
      high = Math.max(high, greatest);
    }
    this.model.showState(now);
    return [low, high];
  }

  rangeOfShape(field) {
    const { analysis, number } = this.shape;
    const most = 2 ** this.view.scale * analysis.factor(number, this.model.size) * analysis.amplitudes(number).move;
    return [field.component === null ? 0 : -most, most];
  }

  resize() {
    const { clientWidth, clientHeight } = this.canvas.parentElement;
    this.renderer.setSize(clientWidth, clientHeight, false);
    this.camera.resize(clientWidth, clientHeight);
    this.redraw();
  }

  redraw() {
    if (this.isDue) return;
    this.isDue = true;
    requestAnimationFrame(() => {
      this.isDue = false;
      this.draw();
    });
  }

  draw() {
    const { clientWidth, clientHeight } = this.canvas.parentElement;
    this.renderer.setViewport(0, 0, clientWidth, clientHeight);
    this.renderer.clear();
    this.renderer.render(this.scene, this.camera.eye);
    this.axes.draw(this.renderer, this.camera);
  }
}

function addNote(text, kind = "") {
  const line = document.createElement("li");
  line.className = kind;
  line.textContent = text;
  document.getElementById("notes").append(line);
}

function fail(text) {
  const box = document.getElementById("failure");
  box.hidden = false;
  box.textContent = text;
}

window.addEventListener("error", (event) => fail(`The page does not work in this browser: ${event.message}`));
const probe = document.createElement("canvas");
if (probe.getContext("webgl") === null) fail("This browser shows no 3D pictures: it has no WebGL, or it is switched off.");
else new Viewer(JSON.parse(document.getElementById("data").textContent));
