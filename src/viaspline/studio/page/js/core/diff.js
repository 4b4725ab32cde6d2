/**
 * What has changed between two documents, as the server wants to be told.
 *
 * Documents are never changed in place, so parts that are the same object are the same.
 */

/** @typedef {(string|number)[]} Path */
/** @typedef {[Path, unknown]|[Path]} Change */

/**
 * @param {any} before
 * @param {any} after
 * @param {Path} [path]
 * @param {Change[]} [found]
 * @returns {Change[]}
 */
export function diff(before, after, path = [], found = []) {
  if (before === after) return found;
  if (isList(before) && isList(after) && before.length === after.length) {
    after.forEach((/** @type {unknown} */ item, /** @type {number} */ i) => diff(before[i], item, [...path, i], found));
  } else if (isMapping(before) && isMapping(after)) {
    for (const key of Object.keys(before)) if (!(key in after)) found.push([[...path, key]]);
    for (const [key, item] of Object.entries(after)) {
      if (key in before) diff(before[key], item, [...path, key], found);
      else found.push([[...path, key], item]);
    }
  } else if (isList(before) || isMapping(before) || isList(after) || isMapping(after) || !Object.is(before, after)) {
    found.push([path, after]);
  }
  return found;
}

const isList = (/** @type {unknown} */ value) => Array.isArray(value);
const isMapping = (/** @type {unknown} */ value) =>
  typeof value === "object" && value !== null && !Array.isArray(value);

/**
 * A document with one part replaced; without a value it is taken out.
 *
 * @param {any} node
 * @param {Path} path
 * @param {unknown} value undefined takes the part out
 * @returns {any}
 */
export function replaced(node, path, value) {
  if (path.length === 0) return value;
  const [step, ...rest] = path;
  if (typeof step === "number") {
    const list = [...(node ?? [])];
    if (rest.length === 0 && value === undefined) list.splice(step, 1);
    else list[step] = replaced(list[step], rest, value);
    return list;
  }
  const mapping = { ...(node ?? {}) };
  if (rest.length === 0 && value === undefined) delete mapping[step];
  else mapping[step] = replaced(mapping[step], rest, value);
  return mapping;
}

/**
 * @param {any} node
 * @param {Path} path
 * @returns {any} undefined if there is nothing
 */
export function part(node, path) {
  return path.reduce((inner, step) => inner?.[step], node);
}
