// The slider below the picture: states in time, or the phase of a shape; and what plays them.

const PHASES = 48; // of one period
const SPEEDS = [0.1, 0.25, 0.5, 1, 2, 4];
const PLAY_SECONDS = 8; // all states at speed 1
const PERIOD_SECONDS = 2;

class Timeline {
  /** @param move  is called with the place of the slider */
  constructor(move) {
    this.slider = document.getElementById("time");
    this.text = document.getElementById("time-text");
    this.button = document.getElementById("play");
    this.speed = document.getElementById("speed");
    this.move = move;
    this.isPlaying = false;
    this.exact = 0;
    for (const speed of SPEEDS) this.speed.add(new Option(`× ${speed}`, speed, speed === 1, speed === 1));
    this.slider.addEventListener("input", () => move(Number(this.slider.value)));
    this.button.addEventListener("click", () => this.play(!this.isPlaying));
    document.addEventListener("keydown", (event) => this.press(event));
  }

  /** What the slider stands for. */
  set(count, isPeriod, place, text) {
    this.slider.max = count - 1;
    this.slider.value = place;
    this.isPeriod = isPeriod;
    this.text.textContent = text;
    document.getElementById("timeline").hidden = count < 2;
  }

  play(isPlaying) {
    this.isPlaying = isPlaying;
    this.button.textContent = isPlaying ? "⏸" : "▶";
    this.exact = Number(this.slider.value);
    this.before = null;
    if (isPlaying) requestAnimationFrame((now) => this.tick(now));
  }

  tick(now) {
    if (!this.isPlaying) return;
    const count = Number(this.slider.max) + 1;
    const seconds = this.isPeriod ? PERIOD_SECONDS : Math.max(PLAY_SECONDS, count / 60);
    if (this.before !== null) {
      this.exact = (this.exact + ((now - this.before) / 1000 / seconds) * count * Number(this.speed.value)) % count;
    }
    this.before = now;
    if (Math.floor(this.exact) !== Number(this.slider.value)) this.move(Math.floor(this.exact));
    requestAnimationFrame((next) => this.tick(next));
  }

  press(event) {
    if (event.target.matches("select, input, button")) return;
    const place = Number(this.slider.value), last = Number(this.slider.max);
    if (event.key === " ") this.play(!this.isPlaying);
    else if (event.key === "ArrowRight" && place < last) this.move(place + 1);
    else if (event.key === "ArrowLeft" && place > 0) this.move(place - 1);
    else return;
    event.preventDefault();
  }
}
