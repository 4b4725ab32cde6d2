/**
 * The connection to the server. One edit is under way at a time: those that come meanwhile are
 * gathered, and only what has changed since is sent. A plan that takes long is overtaken: the server
 * breaks it off when it is told of the next edit.
 */

import { diff } from "./diff.js";

const RETRY_MS = [200, 500, 1000, 2000, 4000];
const BUSY_AFTER_MS = 300;

export class Link {
  /** @param {(message: any) => void} hear every message that nobody waits for */
  constructor(hear) {
    this.hear = hear;
    this.token = new URLSearchParams(location.search).get("token");
    /** @type {WebSocket|null} */ this.socket = null;
    this.tries = 0;
    this.number = 0;
    /** @type {Map<number, {resolve: (m: any) => void, reject: (e: Error) => void}>} */
    this.waiting = new Map();
    /** @type {any} */ this.sent = undefined; // the document that the server has
    /** @type {number|null} */ this.underway = null; // the revision that is being planned
    /** When it was sent. */ this.sentAt = 0;
    this.overtaking = 0; // the timer of the next edit
    /** @type {{doc: any, revision: number, inputAt: number}|null} */ this.wanted = null;
    /** @type {Map<number, number>} */ this.inputs = new Map(); // when the input of a revision came
    this.connect();
  }

  connect() {
    const query = this.token === null ? "" : `?token=${encodeURIComponent(this.token)}`;
    const scheme = location.protocol === "https:" ? "wss" : "ws";
    const socket = new WebSocket(`${scheme}://${location.host}/talk${query}`);
    this.socket = socket;
    socket.onmessage = (event) => this.take(JSON.parse(event.data));
    socket.onopen = () => { this.tries = 0; };
    socket.onclose = () => {
      this.socket = null;
      this.sent = undefined;
      this.underway = null;
      this.waiting.forEach(({ reject }) => reject(new Error("the connection was lost")));
      this.waiting.clear();
      this.hear({ type: "closed" });
      setTimeout(() => this.connect(), RETRY_MS[Math.min(this.tries++, RETRY_MS.length - 1)]);
    };
  }

  /** @param {any} message */
  take(message) {
    if (message.type === "planned") {
      message.inputAt = this.inputs.get(message.rev);
      for (const revision of this.inputs.keys()) if (revision <= message.rev) this.inputs.delete(revision);
      if (message.rev === this.underway) {
        this.underway = null;
        this.pump();
      }
    }
    if (message.type === "provisional") { // the next edit needn't wait for the plan
      message.inputAt = this.inputs.get(message.rev);
      this.inputs.delete(message.rev);
      if (message.rev === this.underway) {
        this.underway = null;
        this.pump();
      }
    }
    if (message.type === "refused" && message.about === "edit") {
      this.underway = null;
      this.sent = undefined; // next time the whole document is sent
    }
    const waiting = message.id === undefined || message.id === null ? undefined : this.waiting.get(message.id);
    if (waiting) {
      this.waiting.delete(message.id);
      if (message.type === "refused") waiting.reject(new Error(message.message));
      else waiting.resolve(message);
    } else this.hear(message);
  }

  /** Have a document planned. @param {any} doc @param {number} revision @param {number} inputAt */
  plan(doc, revision, inputAt) {
    this.wanted = { doc, revision, inputAt };
    this.pump();
  }

  pump() {
    if (!this.wanted || this.socket?.readyState !== WebSocket.OPEN) return;
    const wait = this.underway === null ? 0 : this.sentAt + BUSY_AFTER_MS - performance.now();
    if (wait > 0) {
      this.overtaking ||= setTimeout(() => {
        this.overtaking = 0;
        this.pump();
      }, wait);
      return;
    }
    const { doc, revision, inputAt } = this.wanted;
    this.wanted = null;
    const changes = this.sent === undefined ? [[[], doc]] : diff(this.sent, doc);
    this.underway = revision;
    this.sent = doc;
    this.sentAt = performance.now();
    this.inputs.set(revision, inputAt);
    this.send({ type: "edit", rev: revision, changes });
  }

  /** Wait until the server has been told of every edit. @returns {Promise<void>} */
  async told() {
    while (this.wanted) await new Promise((resolve) => setTimeout(resolve, 10));
  }

  /** @param {any} message */
  send(message) {
    this.socket?.send(JSON.stringify(message));
  }

  /** Ask for something. @param {any} message @returns {Promise<any>} the answer */
  ask(message) {
    if (this.socket?.readyState !== WebSocket.OPEN) return Promise.reject(new Error("there is no connection to the studio"));
    const id = ++this.number;
    return new Promise((resolve, reject) => {
      this.waiting.set(id, { resolve, reject });
      this.send({ ...message, id });
    });
  }
}
