/** The card over the map: what variants differ in, and the table of what came of each. */

import { isDark, onTheme } from "../draw/theme.js";
import { robotColour } from "../fleet/colours.js";
import { fill, h, icon, iconButton, lazily } from "../panels/dom.js";
import { meaning } from "../panels/meaning.js";
import { down, metres, seconds } from "../units.js";
import { letterOf } from "./compare_row.js";
import { kindsOf, numbersIn } from "./variant_kinds.js";

/** @typedef {import("./compare_row.js").Row} Row */

const COLUMNS = ["Variant", "Length", "Time", "Sharpest", "Clear", "Jumps", "Drives", ""];
const BEST = /** @type {[string, 1|-1][]} */ ([["length", 1], ["duration", 1], ["radius", -1], ["clearance", -1], ["jumps", 1]]); // 1: the least is best

export class CompareCard {
  /** @param {import("./compare.js").Compare} compare */
  constructor(compare) {
    this.compare = compare;
    this.element = h("section", { id: "compare", class: "compare", "aria-label": "Compare variants", hidden: true, onkeydown: (/** @type {KeyboardEvent} */ event) => this.key(event) });
    document.querySelector("#bottom")?.after(this.element);
    this.kind = "clearance";
    /** What is typed, by the kind. @type {Record<string, string>} */ this.values = {};
    this.later = lazily(() => this.render(), 30);
    onTheme(() => this.render());
  }

  /** How much of the map it covers, from below: on narrow screens [CSS pixel]. */
  get covers() {
    if (this.element.hidden) return 0;
    const map = this.compare.app.scene.canvas.getBoundingClientRect();
    return Math.max(0, map.bottom - this.element.getBoundingClientRect().top);
  }

  show() {
    this.element.hidden = false;
    this.values = {};
    this.render();
  }

  hide() {
    this.element.hidden = true;
  }

  focus() {
    this.element.querySelector("select")?.focus();
  }

  /** @param {KeyboardEvent} event */
  key(event) {
    event.stopPropagation(); // letters are typed here, and not the map's keys
    if (event.key !== "Escape") return;
    this.compare.close();
    this.compare.app.scene.canvas.focus();
  }

  render() {
    if (this.element.hidden) return;
    const { compare } = this;
    fill(this.element,
      h("header", { class: "compare-head" }, h("h2", {}, "Compare variants"), this.form(), iconButton("close", "Close the comparison", () => compare.close(), { class: "icon-button small compare-close" })),
      compare.isOfNow ? null : h("p", { class: "compare-note" }, "The mission has changed since. ", h("button", { type: "button", class: "link", onclick: () => compare.plan() }, "Plan them anew")),
      h("div", { class: `compare-table${compare.isOfNow ? "" : " is-late"}` }, this.table()));
  }

  form() {
    const { compare } = this;
    const { store } = compare.app;
    const kinds = kindsOf(store.doc, store.ledger);
    const kind = kinds.find(({ key }) => key === this.kind) ?? kinds[0];
    const select = h("select", { "aria-label": "What differs", onchange: () => { this.kind = select.value; this.render(); } },
      ...kinds.map(({ key, label }) => h("option", { value: key, selected: key === kind.key }, label)));
    const values = kind.usual === null ? null : h("input", { type: "text", "aria-label": "Values", value: this.values[kind.key] ?? kind.usual, spellcheck: "false", oninput: () => { this.values[kind.key] = values.value; } });
    const submit = (/** @type {Event} */ event) => {
      event.preventDefault();
      this.add(kind, values);
    };
    return h("form", { class: "compare-form", onsubmit: submit }, select, values, h("button", { type: "submit", class: "button" }, "Add"),
      compare.isRunning
        ? h("button", { type: "button", class: "button", onclick: () => compare.stop() }, icon("stop", 14), "Stop")
        : compare.rows.some((row) => row.state === "stopped") ? h("button", { type: "button", class: "button", onclick: () => compare.plan() }, "Go on") : null);
  }

  /** @param {import("./variant_kinds.js").VariantKind} kind @param {HTMLInputElement|null} input */
  add(kind, input) {
    const { app } = this.compare;
    const values = input ? numbersIn(input.value) : [];
    const fault = values === null ? "Give numbers with commas between them, such as 0.2, 0.5" : values.map(kind.fault).find(Boolean);
    if (fault || values === null) {
      input?.setAttribute("aria-invalid", "true");
      app.toast(fault ?? "", "is-bad");
      return;
    }
    this.compare.add(kind.variants(values));
  }

  table() {
    const { rows } = this.compare;
    const best = Object.fromEntries(BEST.map(([key, way]) => [key, bestOf(rows, key, way)]));
    return h("table", {},
      h("thead", {}, h("tr", {}, ...COLUMNS.map((name) => h("th", { scope: "col" }, name === "Clear" ? meaning("a-path", name) : name === "Drives" ? meaning("how-it-drives", name) : name)))),
      h("tbody", {}, ...rows.map((row, i) => this.row(row, i, best))));
  }

  /** @param {Row} row @param {number} i @param {Record<string, number|null>} best */
  row(row, i, best) {
    const { compare } = this;
    return h("tr", { onmouseenter: () => compare.hover(row), onmouseleave: () => compare.hover(null) },
      h("th", { scope: "row" }, h("div", {}, swatch(i), h("span", { class: "compare-name" }, row.name))),
      ...(row.result?.ok ? figures(row.result, best) : [h("td", { colspan: "6", class: "compare-words" }, stateOf(row))]),
      h("td", {}, h("div", { class: "compare-deeds" },
        i && row.result?.ok ? h("button", { type: "button", class: "button is-take", disabled: !compare.isOfNow, "aria-label": `Take over ${row.name}`, onclick: () => compare.takeOver(row) }, "Take") : null,
        i ? iconButton("trash", `Take ${row.name} out of the table`, () => compare.drop(row), { class: "icon-button small" }) : null)));
  }
}

/** The letter of a row in the colour of its path. @param {number} i */
function swatch(i) {
  const square = h("span", { class: "compare-swatch" }, letterOf(i));
  square.style.background = robotColour(i, isDark());
  return square;
}

/** @param {Row} row */
function stateOf({ state, result }) {
  if (state === "planning") return h("span", { class: "compare-busy" }, h("span", { class: "spinner", "aria-hidden": "true" }), "planning …");
  if (state === "waiting") return "waits";
  if (state === "stopped") return "stopped before it was planned";
  const [first, ...more] = result.words;
  return h("span", { class: "compare-refused", title: result.words.join("\n") }, `${result.gaveUp ? "" : "refused: "}${first}${more.length ? ` (and ${more.length} more)` : ""}`);
}

/** @param {any} result @param {Record<string, number|null>} best */
function figures(result, best) {
  const cell = (/** @type {string} */ key, /** @type {string} */ text, /** @type {string} */ title = "") =>
    h("td", { class: result[key] !== null && result[key] === best[key] ? "is-best" : "", title: title || undefined }, text);
  return [
    cell("length", metres(result.length, 1)), cell("duration", seconds(result.duration)),
    cell("radius", result.radius === null ? "straight" : metres(result.radius)),
    cell("clearance", result.clearance === null ? "–" : down(result.clearance), result.clearance === null ? "nothing to keep clear of" : `proven; ${metres(result.required)} asked`),
    cell("jumps", result.jumps === null ? "–" : String(result.jumps), "jumps of the curvature"),
    h("td", { class: result.verdict === "good" ? "is-good" : result.verdict ? "is-rough" : "", title: result.why.join("\n") || undefined }, result.verdict === "good" ? "well" : result.verdict ? "roughly" : "–"),
  ];
}

/** The best of a column, where the rows differ. @param {Row[]} rows @param {string} key @param {1|-1} way */
function bestOf(rows, key, way) {
  const values = rows.flatMap(({ result }) => (result?.ok && result[key] !== null ? [result[key]] : []));
  const least = Math.min(...values.map((value) => way * value));
  return values.length > 1 && values.some((value) => way * value > least) ? way * least : null;
}
