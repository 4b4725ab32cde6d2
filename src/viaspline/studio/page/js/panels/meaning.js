/** Words that lead to what they mean: the page of what is proven, under which assumptions, and what is not. */

import { h } from "./dom.js";

/**
 * Words that open that page in a tab of its own.
 * @param {"a-path"|"how-it-drives"|"what-moves"|"fleets-and-space"} section
 * @param {string} words
 */
export function meaning(section, words) {
  return h("a", { class: "meaning", href: `/page/proven.html#${section}`, target: "_blank", rel: "noopener", title: "What exactly is proven, and what is not" }, words);
}
