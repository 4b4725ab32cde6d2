/** A scene in an address: the document, deflated, after the #. */

/** @param {{name: string|null, doc: any}} scene @returns {Promise<string>} */
export async function packed(scene) {
  const bytes = await through(new TextEncoder().encode(JSON.stringify(scene)), new CompressionStream("deflate-raw"));
  let text = "";
  for (let i = 0; i < bytes.length; i += 8192) text += String.fromCharCode(...bytes.subarray(i, i + 8192));
  return btoa(text).replaceAll("+", "-").replaceAll("/", "_").replace(/=+$/, "");
}

/** @param {string} text @returns {Promise<{name: string|null, doc: any}|null>} null if it is none */
export async function unpacked(text) {
  try {
    const raw = atob(text.replaceAll("-", "+").replaceAll("_", "/"));
    const bytes = await through(Uint8Array.from(raw, (c) => c.charCodeAt(0)), new DecompressionStream("deflate-raw"));
    const scene = JSON.parse(new TextDecoder().decode(bytes));
    return scene && typeof scene.doc === "object" && scene.doc ? scene : null;
  } catch {
    return null;
  }
}

/** @param {Uint8Array} bytes @param {CompressionStream|DecompressionStream} stream */
async function through(bytes, stream) {
  const answer = new Response(new Blob([/** @type {any} */ (bytes)]).stream().pipeThrough(stream));
  return new Uint8Array(await answer.arrayBuffer());
}
