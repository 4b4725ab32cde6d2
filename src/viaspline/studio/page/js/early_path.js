/** Where the path of a mission will about run whose plan takes long: laid soon, proven of nothing. */

/** @typedef {{rev: number, ms: number, spans: number[], leftOut: string[], inputAt?: number}} Early */

const PLACES = [1 / 2, 3 / 8, 5 / 8, 1 / 4, 3 / 4, 1 / 8, 7 / 8]; // of its way, where its words may stand
const EARLY_WORDS = "provisional, not yet driven";

export class EarlyPath {
  /** @param {import("./core/store.js").Store} store */
  constructor(store) {
    this.store = store;
    /** @type {Early|null} */ this.newest = null;
    store.on("file", () => { this.newest = null; });
  }

  /** @param {Early} message */
  take(message) {
    this.newest = message;
  }

  /** The path, as long as there is no plan that is as new. @returns {Early|null} */
  get shown() {
    const { newest, store } = this;
    return newest && (store.plan?.rev ?? -1) < newest.rev && newest.rev <= store.revision ? newest : null;
  }

  /** What the bar and the map say of it. */
  get words() {
    const left = this.shown?.leftOut ?? [];
    const words = left.includes("it is not yet driven") ? EARLY_WORDS : "provisional, not yet proven";
    return left.includes("its turning circle is not kept") ? `${words}; turning circle not kept` : words;
  }

  /** @param {import("./draw/pen.js").Pen} pen */
  draw(pen) {
    const early = this.shown;
    if (!early) return;
    const { ctx, colours } = pen;
    ctx.lineCap = ctx.lineJoin = "round";
    ctx.beginPath();
    pen.spans(early.spans);
    pen.stroke(colours.casing, 6);
    pen.stroke(colours.select, 3, [9, 6]);
  }

  /** Said beside it, in the middle of its way or where else there is room. @param {import("./draw/pen.js").Pen} pen @returns {import("./draw/labels.js").Label[]} */
  labels({ camera, colours }) {
    const early = this.shown;
    if (!early) return [];
    const count = early.spans.length / 8;
    const [[x, y], ...others] = PLACES.map((part) => {
      const i = 8 * Math.floor(part * count);
      return camera.toScreen(early.spans[i], early.spans[i + 1]);
    });
    return [{ text: this.words, x, y, others, away: 14, colour: colours.select, bold: true, rank: 2, plate: true }];
  }
}
