// A history as a small plot.

/** Three to six round numbers between two. */
function roundNumbers(low, high) {
  const raw = (high - low) / 5;
  const power = 10 ** Math.floor(Math.log10(raw));
  const step = [1, 2, 5, 10].find((one) => one * power >= raw) * power;
  const numbers = [];
  for (let i = Math.ceil(low / step - 1e-9); i * step <= high + 1e-9 * step; i++) numbers.push(i * step);
  return numbers;
}

/** Least and greatest of all, wide enough to draw. */
function spread(values) {
  let low = Math.min(...values), high = Math.max(...values);
  if (!(high - low > 1e-12 * Math.max(Math.abs(low), Math.abs(high), 1e-30))) {
    const half = Math.abs(low) / 2 || 0.5;
    low -= half;
    high += half;
  }
  return [low, high];
}

/**
 * @param curves  [{x, y, isGhost}]
 * @param now     where the mark is, {x, y}
 */
function drawPlot(canvas, curves, now, labels) {
  const ratio = window.devicePixelRatio || 1;
  const width = canvas.clientWidth, height = canvas.clientHeight;
  canvas.width = width * ratio;
  canvas.height = height * ratio;
  const pen = canvas.getContext("2d");
  pen.scale(ratio, ratio);
  pen.font = "11px system-ui, sans-serif";
  const [xLow, xHigh] = spread(curves.flatMap((curve) => curve.x));
  const [yLow, yHigh] = spread(curves.flatMap((curve) => curve.y));
  const left = 58, right = width - 8, top = 18, bottom = height - 30;
  const px = (x) => left + ((x - xLow) / (xHigh - xLow)) * (right - left);
  const py = (y) => bottom - ((y - yLow) / (yHigh - yLow)) * (bottom - top);
  pen.fillStyle = "#555";
  pen.fillText(labels.y, 2, 10);
  pen.textAlign = "center";
  pen.fillText(labels.x, (left + right) / 2, height - 4);
  for (const x of roundNumbers(xLow, xHigh)) {
    gridLine(pen, px(x), top, px(x), bottom);
    pen.fillText(readable(Number(x.toPrecision(8))), px(x), bottom + 12);
  }
  pen.textAlign = "right";
  for (const y of roundNumbers(yLow, yHigh)) {
    gridLine(pen, left, py(y), right, py(y));
    pen.fillText(readable(Number(y.toPrecision(8))), left - 4, py(y) + 4);
  }
  for (const { x, y, isGhost } of curves) {
    pen.beginPath();
    x.forEach((value, i) => pen.lineTo(px(value), py(y[i])));
    pen.strokeStyle = isGhost ? "#d08770" : "#2456c4";
    pen.lineWidth = 1.5;
    pen.stroke();
  }
  pen.beginPath();
  pen.arc(px(now.x), py(now.y), 4, 0, 2 * Math.PI);
  pen.fillStyle = "#c2185b";
  pen.fill();
}

function gridLine(pen, x0, y0, x1, y1) {
  pen.beginPath();
  pen.moveTo(x0, y0);
  pen.lineTo(x1, y1);
  pen.strokeStyle = "#e3e3e3";
  pen.lineWidth = 1;
  pen.stroke();
}
