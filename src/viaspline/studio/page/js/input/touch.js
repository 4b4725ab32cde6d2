/** What only fingers need: a long press in place of the right button, and presses that may become a pinch. */

/** @typedef {import("./pointer.js").Gesture} Gesture */

const LONG_MS = 550;

export class LongPress {
  /** @param {(px: number, py: number) => void} act */
  constructor(act) {
    this.act = act;
    this.timer = 0;
  }

  /** @param {number} px @param {number} py */
  begin(px, py) {
    this.end();
    this.timer = setTimeout(() => this.act(px, py), LONG_MS);
  }

  end() {
    clearTimeout(this.timer);
    this.timer = 0;
  }
}

/**
 * A gesture that begins with the first move, or when the finger is lifted: until then a second finger
 * may come, and nothing must have been made.
 * @param {() => Gesture} begin @returns {Gesture}
 */
export function afterwards(begin) {
  /** @type {Gesture|null} */ let gesture = null;
  return {
    move(at, event) {
      gesture ??= begin();
      gesture.move(at, event);
    },
    end(moved, at) {
      gesture ??= begin();
      gesture.end?.(moved, at);
    },
    cancel() {
      gesture?.cancel?.();
    },
  };
}
