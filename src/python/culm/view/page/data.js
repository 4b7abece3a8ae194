// The numbers of the page: base64 of little-endian arrays, as packing.py writes them.

const ARRAYS = { f4: Float32Array, i4: Int32Array, u2: Uint16Array };

/** An array of numbers with its shape; `at(i)` is a number, also where it is kept in 16 bits. */
class Numbers {
  constructor(packed) {
    const text = atob(packed.data);
    const bytes = new Uint8Array(text.length);
    for (let i = 0; i < text.length; i++) bytes[i] = text.charCodeAt(i);
    this.values = new ARRAYS[packed.kind](bytes.buffer);
    this.shape = packed.shape;
    this.low = packed.low || null;
    this.step = packed.step || null;
  }

  at(i) {
    if (this.low === null) return this.values[i];
    const column = i % this.low.length;
    return this.low[column] + this.step[column] * this.values[i];
  }

  /** Copies `out.length` numbers from place `start` on. */
  copy(start, out) {
    if (this.low === null) {
      out.set(this.values.subarray(start, start + out.length));
    } else {
      for (let i = 0; i < out.length; i++) out[i] = this.at(start + i);
    }
  }

  /** Least and greatest from place `start` to `end`. */
  range(start, end) {
    let low = Infinity, high = -Infinity;
    for (let i = start; i < end; i++) {
      const value = this.at(i);
      if (value < low) low = value;
      if (value > high) high = value;
    }
    return [low, high];
  }
}

/** Numbers, or null for nothing. */
function unpack(packed) {
  return packed === null ? null : new Numbers(packed);
}
