/** What is proven of the heights of a path, in rows. */

import { h, sentence } from "../panels/dom.js";

/** @param {any} plan */
export function heightRows({ space }) {
  if (!space?.rows) return [];
  return [
    h("h3", {}, "Heights"),
    h("dl", { class: "height-rows" }, ...space.rows.flatMap((/** @type {string[]} */ [name, words]) => [h("dt", {}, sentence(name)), h("dd", {}, words)])),
  ];
}
