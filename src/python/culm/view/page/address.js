// The view in the address of the page: a link shows what one sees.
//
//   #time=0.5&field=N3&directors=1&pick=beam/12

const FLAGS = Object.keys(SWITCHES);

/** What an address says; what it does not say is missing. */
function readAddress(model) {
  const words = new URLSearchParams(window.location.hash.slice(1));
  const view = {};
  if (words.has("time")) view.state = model.stateAt(Number(words.get("time")));
  if (words.has("state")) view.state = Math.min(Math.max(Number(words.get("state")) - 1, 0), model.times.length - 1) || 0;
  for (const name of ["shape", "field", "range"]) if (words.has(name)) view[name] = words.get(name);
  for (const name of ["scale", "phase"]) if (words.has(name)) view[name] = Number(words.get(name)) || 0;
  for (const name of FLAGS) if (words.has(name)) view[name] = words.get(name) === "1";
  if (words.has("pick") || words.has("node")) view.pick = findPick(model, words.get("pick"), words.get("node"));
  const numbers = (words.get("camera") || "").split(",").map(Number);
  if (numbers.length === 6 && numbers.every(Number.isFinite)) view.camera = numbers;
  return view;
}

/** "structure/element" and "structure/node" to places; null where there is no such thing. */
function findPick(model, element, node) {
  const split = (text) => [text.slice(0, text.lastIndexOf("/")), Number(text.slice(text.lastIndexOf("/") + 1))];
  const structure = model.find(split(element || node)[0]);
  if (structure === null) return null;
  const find = (text, count, number) => {
    if (!text) return null;
    const wanted = split(text)[1];
    for (let place = 0; place < count; place++) if (number(place) === wanted) return place;
    return null;
  };
  const pick = {
    structure,
    cell: find(element, structure.cellCount, (place) => structure.cellNumber(place)),
    node: find(node, structure.count, (place) => structure.nodeNumber(place)),
  };
  if (pick.cell !== null && pick.node === null) pick.node = structure.cell(pick.cell)[0];
  return pick.cell === null && pick.node === null ? null : pick;
}

/** Writes the view into the address, leaving out what is as it was at first. */
function writeAddress(model, view, first, camera) {
  const words = new URLSearchParams();
  if (view.state !== first.state) {
    if (model.hasOrderedTimes) words.set("time", Number(model.times[view.state].toPrecision(7)));
    else words.set("state", view.state + 1);
  }
  for (const name of ["shape", "field", "range", "scale"]) if (view[name] !== first[name]) words.set(name, view[name]);
  for (const name of FLAGS) if (view[name] !== first[name]) words.set(name, view[name] ? "1" : "0");
  if (view.pick) {
    const { structure, cell, node } = view.pick;
    if (cell !== null) words.set("pick", `${structure.name}/${structure.cellNumber(cell)}`);
    if (node !== null) words.set("node", `${structure.name}/${structure.nodeNumber(node)}`);
  }
  if (camera) words.set("camera", camera.join(","));
  const text = words.toString().replace(/%2F/g, "/").replace(/%2C/g, ",");
  history.replaceState(null, "", text ? `#${text}` : window.location.pathname);
}
