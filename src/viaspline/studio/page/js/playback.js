/** A time that is played from a beginning to an end, so many times as fast as clocks go. */

export class Playback {
  constructor() {
    this.begin = 0; // [s]
    this.end = 0; // [s]
    this.time = 0; // [s]
    this.factor = 1;
    this.isPlaying = false;
    this.last = 0;
    /** @type {(() => void)[]} */ this.listeners = [];
  }

  /** @param {() => void} listener */
  on(listener) {
    this.listeners.push(listener);
  }

  tell() {
    this.listeners.forEach((listener) => listener());
  }

  /** Something else is played from now on: time stays where it is, if it is within that. @param {number} begin @param {number} end [s] */
  over(begin, end) {
    const wasAtBegin = this.time === this.begin;
    this.begin = begin;
    this.end = end;
    this.time = wasAtBegin ? begin : Math.min(end, Math.max(begin, this.time));
  }

  play() {
    if (this.end <= this.begin) return;
    if (this.time >= this.end) this.time = this.begin;
    this.isPlaying = true;
    this.last = performance.now();
    const frame = (/** @type {number} */ now) => {
      if (!this.isPlaying) return;
      this.time = Math.min(this.end, this.time + (Math.max(0, now - this.last) / 1000) * this.factor);
      this.last = now;
      if (this.time >= this.end) this.isPlaying = false;
      this.tell();
      if (this.isPlaying) requestAnimationFrame(frame);
    };
    requestAnimationFrame(frame);
    this.tell();
  }

  pause() {
    this.isPlaying = false;
    this.tell();
  }

  /** @param {number} time [s] */
  seek(time) {
    this.time = Math.min(this.end, Math.max(this.begin, time));
    this.tell();
  }

  /** To the moment before or after; there to the beginning or the end. @param {1|-1} way @param {number[]} moments in order [s] */
  stepTo(way, moments) {
    this.isPlaying = false;
    const next = way > 0 ? moments.find((t) => t > this.time + 1e-6) : moments.filter((t) => t < this.time - 1e-6).at(-1);
    this.seek(next ?? (way > 0 ? this.end : this.begin));
  }
}
