/**
 * Copy, cut, paste and duplicate. What is copied is a text of the mission's own keys, so it can be
 * pasted into a mission file, into another mission, and back from either.
 */

import { addVia } from "../core/edits.js";
import { isSpatial } from "../core/heights.js";
import { anchorOf, areasOf, exists, isPoint, obstaclesOf, part, pathOf, placeOf, pointsOf, refOf, replaced } from "../core/mission.js";
import { countWords, groupable, movedBy } from "./group_edits.js";
import { yamlOf } from "./yaml.js";

const WORLD_LISTS = /** @type {[string, string][]} */ ([["known", "known"], ["unseen", "unseen"], ["fences", "fence"], ["speed_zones", "zone"]]);
const ASIDE_PX = 28; // where a copy stands beside what it was made of

export class Clipboard {
  /** @param {any} app */
  constructor(app) {
    this.app = app;
    /** What was copied here last, for browsers that don't give the clipboard away. */ this.text = "";
    const isFields = (/** @type {Event} */ { target }) => target instanceof HTMLElement && !!target.closest("input:not([type=range]):not([type=checkbox]), textarea, select, dialog");
    const isWords = () => !!getSelection()?.toString();
    for (const type of /** @type {const} */ (["copy", "cut"])) {
      document.addEventListener(type, (event) => {
        if (isFields(event) || isWords()) return;
        const text = this.copied();
        if (!text) return;
        event.clipboardData?.setData("text/plain", text);
        event.preventDefault();
        if (type === "cut") app.selecting.erase();
      });
    }
    document.addEventListener("paste", (event) => {
      if (isFields(event) || document.querySelector("dialog[open]")) return;
      event.preventDefault();
      this.paste(event.clipboardData?.getData("text/plain") || this.text, null);
    });
  }

  /** What is selected as a text; empty if that can't be copied. */
  copied() {
    const { store, say, toast } = this.app;
    const ids = store.chosen.map((/** @type {string} */ id) => groupable(id)).filter(Boolean);
    const parts = partsOf(store.doc, ids);
    if (!parts) {
      toast("Nothing that can be copied is selected: points, obstacles and areas can.");
      return "";
    }
    this.text = yamlOf(parts);
    say(`${countWords(ids)} copied`);
    return this.text;
  }

  /** For the menu: the browser is asked to take the text. */
  async copy() {
    const text = this.copied();
    if (!text) return false;
    try {
      await navigator.clipboard.writeText(text);
    } catch {
      this.app.toast("Copied within the studio only: the browser doesn't let it into the clipboard. Ctrl+C does.");
    }
    return true;
  }

  async cut() {
    if (await this.copy()) this.app.selecting.erase();
  }

  /** For the menu: what the browser has, or what was copied here. @param {number[]} at */
  async pasteHere(at) {
    let { text } = this;
    try {
      text = (await navigator.clipboard.readText()) || text;
    } catch { /* it isn't given away */ }
    await this.paste(text, at);
  }

  /** @param {string} text @param {number[]|null} at where its middle is to be [m]; null: where it was */
  async paste(text, at) {
    const { link, toast } = this.app;
    if (!text) {
      toast("There is nothing to paste: copy points, obstacles or areas, or a part of a mission file.");
      return;
    }
    try {
      const { parts } = await link.ask({ type: "paste", text });
      this.put(parts, at);
    } catch (error) {
      toast(/** @type {Error} */ (error).message, "is-bad");
    }
  }

  duplicate() {
    const { store, toast } = this.app;
    const ids = store.chosen.map((/** @type {string} */ id) => groupable(id)).filter((/** @type {string|null} */ id) => id && anchorOf(store.doc, id));
    const parts = partsOf(store.doc, ids);
    if (parts) this.put(parts, null);
    else toast("Nothing that can be duplicated is selected.");
  }

  /** Put parts into the mission, as one step. @param {any} parts @param {number[]|null} at */
  put(parts, at) {
    const { store, camera, say, toast } = this.app;
    let { doc, ids } = added(store.doc, parts, indexAfter(store));
    if (!ids.length) {
      toast("Nothing of it can be put into this mission.", "is-bad");
      return;
    }
    const places = ids.map((id) => anchorOf(doc, id)).filter((place) => place !== null);
    if (places.length) doc = movedBy(doc, ids, this.way(places, at, store.doc));
    store.edit(doc, { select: null });
    const asked = ids.length;
    ids = ids.filter((id) => exists(store.doc, id));
    if (ids.length < asked) toast("The route of this robot stands in another file: no points were put into it.");
    if (!ids.length) return;
    store.select(/** @type {string} */ (ids.at(-1)), ids);
    this.intoView(camera, ids);
    say(`${countWords(ids)} put in`);
  }

  /**
   * How far what is put in is moved: to a place; else it stays, or stands beside what is there.
   * @param {number[][]} places @param {number[]|null} at @param {any} before the mission without it @returns {number[]} [m]
   */
  way(places, at, before) {
    const { camera } = this.app;
    const step = camera.step(ASIDE_PX);
    if (at) {
      const middle = [0, 1].map((k) => (Math.min(...places.map((p) => p[k])) + Math.max(...places.map((p) => p[k]))) / 2);
      return [at[0] - middle[0], at[1] - middle[1]];
    }
    const taken = new Set([...pointsOf(before).map((p) => p.at), ...[...obstaclesOf(before), ...areasOf(before)].map(({ id }) => anchorOf(before, id))].filter(Boolean).map((p) => keyOf(/** @type {number[]} */ (p), [0, 0])));
    for (let k = 0; k < 100; k += 1) {
      const by = [k * step, -k * step];
      if (!places.some((p) => taken.has(keyOf(p, by)))) return by;
    }
    return [0, 0];
  }

  /** Move the map if none of it can be seen. @param {any} camera @param {string[]} ids */
  intoView(camera, ids) {
    const { store } = this.app;
    const places = /** @type {number[][]} */ (ids.map((id) => anchorOf(store.doc, id)).filter((place) => place !== null));
    const isSeen = places.some(([x, y]) => {
      const [px, py] = camera.toScreen(x, y);
      return px > 0 && py > 0 && px < camera.width && py < camera.height;
    });
    if (isSeen || !places.length) return;
    [camera.x, camera.y] = places[0];
    store.tell("view");
  }
}

/** @param {number[]} at @param {number[]} by */
const keyOf = (at, by) => [0, 1].map((k) => Math.round((at[k] + by[k]) * 1000)).join();

/** What ids stand for, as lists of the mission's keys; null if nothing. @param {any} doc @param {string[]} ids */
function partsOf(doc, ids) {
  /** @type {any} */ const parts = {};
  const put = (/** @type {string} */ section, /** @type {string} */ list, /** @type {any} */ item) => {
    ((parts[section] ??= {})[list] ??= []).push(item);
  };
  const order = [...pointsOf(doc), ...obstaclesOf(doc), ...areasOf(doc)].map(({ id }) => id);
  for (const id of order.filter((one) => ids.includes(one))) {
    const item = part(doc, pathOf(id));
    if (isPoint(id)) {
      if (Array.isArray(item)) put("route", "via", item);
      else if (placeOf(item)) {
        const { heading_deg: _, ...rest } = item; // only an end has one
        put("route", "via", Object.keys(rest).length === 1 && rest.at ? rest.at : rest);
      }
    } else put("world", /** @type {[string, string]} */ (WORLD_LISTS.find(([, kind]) => id.startsWith(kind)))[0], item);
  }
  return Object.keys(parts).length ? parts : null;
}

/** Behind the last via point that is selected, or at the end. @param {import("../core/store.js").Store} store */
function indexAfter({ chosen, doc }) {
  const count = (doc.route?.via ?? []).length;
  if (doc.route?.order === "shortest") return count;
  const after = chosen.map((id) => (id === "start" ? -1 : id.startsWith("via:") ? /** @type {any} */ (refOf(id)).index : -2));
  const last = Math.max(-2, ...after);
  return last === -2 ? count : last + 1;
}

/**
 * The document with more parts, and the ids of these.
 * @param {any} doc @param {any} parts @param {number} index of the first of the new via points
 * @returns {{doc: any, ids: string[]}}
 */
function added(doc, parts, index) {
  let next = doc;
  /** @type {string[]} */ const ids = [];
  const names = new Set([...pointsOf(doc), ...obstaclesOf(doc), ...areasOf(doc)].map(({ given }) => given).filter(Boolean));
  const named = (/** @type {any} */ item) => (typeof item?.name === "string" ? { ...item, name: fresh(item.name, names) } : item);
  for (const item of parts.route?.via ?? []) {
    const at = placeOf(item);
    if (!at) continue;
    const id = `via:${index}`;
    next = addVia(next, index, at.slice(0, 2));
    index += 1;
    ids.push(id);
    next = replaced(next, pathOf(id), asVia(part(next, pathOf(id)), named(item), isSpatial(doc)));
  }
  for (const [list, kind] of WORLD_LISTS) {
    for (const item of parts.world?.[list] ?? []) {
      const items = next.world?.[list] ?? [];
      const isThere = !Array.isArray(item) && items.some((/** @type {any} */ one) => JSON.stringify(one) === JSON.stringify(item));
      const id = `${kind}:${items.length}`;
      const grown = replaced(next, ["world", list], [...items, named(item)]);
      if (isThere && !anchorOf(grown, id)) continue; // a map, say, that lies there already
      next = list === "unseen" && !next.robot?.sensor ? replaced(grown, ["robot", "sensor"], { range_m: 20 }) : grown; // else the mission isn't sound
      ids.push(id);
    }
  }
  return { doc: next, ids };
}

/** A pasted via point, as high as the mission wants it. @param {any} usual one at its place @param {any} item @param {boolean} inSpace */
function asVia(usual, item, inSpace) {
  const isHigh = placeOf(item)?.length === 3 || Number.isFinite(item?.agl_m);
  if (Array.isArray(item)) return inSpace === isHigh ? item : usual;
  if (inSpace && isHigh) return item;
  if (!inSpace) {
    const { agl_m: _, look_at: __, gate: ___, ...rest } = item;
    return { ...rest, at: /** @type {number[]} */ (placeOf(item)).slice(0, 2) };
  }
  return { ...item, ...(Array.isArray(usual) ? { at: usual } : usual) };
}

/** A name that nothing else has. @param {string} name @param {Set<unknown>} taken */
function fresh(name, taken) {
  const stem = name.replace(/ \d+$/, "");
  let found = name;
  for (let k = 2; taken.has(found); k += 1) found = `${stem} ${k}`;
  taken.add(found);
  return found;
}
