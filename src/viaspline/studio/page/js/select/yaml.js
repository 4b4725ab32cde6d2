/** Parts of a mission as the text of its file: a section, a list, an item a line. */

const PLAIN = /^[A-Za-z_][A-Za-z0-9_.\/-]*( [A-Za-z0-9_.\/-]+)*$/;
const NO_TEXT = /^(null|true|false|yes|no|on|off|y|n)$/i; // what YAML takes for something else

/** @param {any} parts lists in sections @returns {string} */
export function yamlOf(parts) {
  const lines = [];
  for (const [section, lists] of Object.entries(parts)) {
    lines.push(`${section}:`);
    for (const [key, items] of Object.entries(lists)) {
      lines.push(`  ${key}:`);
      for (const item of items) lines.push(`    - ${flow(item)}`);
    }
  }
  return `${lines.join("\n")}\n`;
}

/** On one line. @param {any} value @returns {string} */
function flow(value) {
  if (Array.isArray(value)) return `[${value.map(flow).join(", ")}]`;
  if (typeof value === "object" && value !== null) return `{${Object.entries(value).map(([key, item]) => `${text(key)}: ${flow(item)}`).join(", ")}}`;
  return typeof value === "string" ? text(value) : JSON.stringify(value);
}

/** @param {string} words */
function text(words) {
  if (PLAIN.test(words) && !NO_TEXT.test(words)) return words;
  // What JSON leaves as it is, and YAML doesn't take, or folds.
  return JSON.stringify(words).replace(/[\u007f-\u00a0\u2028\u2029\ufeff\ufffe\uffff]/g, (one) => `\\u${one.charCodeAt(0).toString(16).padStart(4, "0")}`);
}
