/** Where on the screen there is room for words: boxes that are taken, and cells that the path runs through. */

const BUCKET_PX = 64;
const CELL_PX = 8;

export class LabelRoom {
  /** @param {import("../geometry/camera.js").Camera} camera */
  constructor(camera) {
    this.camera = camera;
    this.across = Math.ceil(camera.width / CELL_PX) + 1;
    this.down = Math.ceil(camera.height / CELL_PX) + 1;
    this.path = new Uint8Array(this.across * this.down);
    /** @type {Map<number, number[][]>} */ this.boxes = new Map();
  }

  /** A place of the path. @param {number} x @param {number} y [CSS pixel] */
  mark(x, y) {
    const i = Math.floor(x / CELL_PX), j = Math.floor(y / CELL_PX);
    if (i >= 0 && j >= 0 && i < this.across && j < this.down) this.path[j * this.across + i] = 1;
  }

  /** @param {number[]} box */
  take(box) {
    this.buckets(box, (key) => {
      const list = this.boxes.get(key);
      if (list) list.push(box);
      else this.boxes.set(key, [box]);
    });
  }

  /** How many of the boxes that are taken another lies on. @param {number[]} box */
  overlaps(box) {
    /** @type {Set<number[]>} */ const found = new Set();
    this.buckets(box, (key) => {
      for (const other of this.boxes.get(key) ?? []) if (overlap(box, other)) found.add(other);
    });
    return found.size;
  }

  /** How much of the path a box would cover, in cells. @param {number[]} box */
  onPath([x0, y0, x1, y1]) {
    let count = 0;
    const last = Math.min(Math.floor(y1 / CELL_PX), this.down - 1);
    const right = Math.min(Math.floor(x1 / CELL_PX), this.across - 1);
    for (let j = Math.max(0, Math.floor(y0 / CELL_PX)); j <= last; j += 1) {
      for (let i = Math.max(0, Math.floor(x0 / CELL_PX)); i <= right; i += 1) count += this.path[j * this.across + i];
    }
    return count;
  }

  /** Whether a box lies on the screen as a whole. @param {number[]} box */
  holds([x0, y0, x1, y1]) {
    return x0 >= 4 && y0 >= 4 && x1 <= this.camera.width - 4 && y1 <= this.camera.height - 4;
  }

  /** @param {number[]} box @param {(key: number) => void} each */
  buckets([x0, y0, x1, y1], each) {
    for (let i = Math.floor(x0 / BUCKET_PX); i <= Math.floor(x1 / BUCKET_PX); i += 1) {
      for (let j = Math.floor(y0 / BUCKET_PX); j <= Math.floor(y1 / BUCKET_PX); j += 1) each(i * 65536 + j);
    }
  }
}

/** @param {number[]} a @param {number[]} b */
const overlap = (a, b) => a[0] < b[2] && a[2] > b[0] && a[1] < b[3] && a[3] > b[1];
