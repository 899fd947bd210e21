/* Large parts of the studio, fetched when they are needed: scripts in parts/, which a page from disk may load too. Each calls
 * studioPart(name, texts, bytes): `texts` as they are, `bytes` compressed by gzip and written in base64. */
const waiting = new Map();

globalThis.studioPart = (name, texts, bytes) => waiting.get(name).resolve({ texts, bytes });

function gunzipped(base64) {
  const packed = Uint8Array.from(atob(base64), (one) => one.charCodeAt(0));
  return new Response(new Blob([packed]).stream().pipeThrough(new DecompressionStream('gzip'))).arrayBuffer();
}

/** The part of that name: { texts: { name: text }, bytes: { name: Uint8Array } }. */
export function part(name) {
  if (!waiting.has(name)) waiting.set(name, loadPart(name));
  return waiting.get(name).whole;
}

function loadPart(name) {
  const one = {}, script = document.createElement('script');
  one.raw = new Promise((resolve, reject) => Object.assign(one, { resolve, reject }));
  one.whole = one.raw.then(async ({ texts, bytes }) => {
    const entries = await Promise.all(Object.entries(bytes).map(async ([key, text]) => [key, new Uint8Array(await gunzipped(text))]));
    return { texts, bytes: Object.fromEntries(entries) };
  });
  script.src = `parts/${name}.js`;
  script.onerror = () => {
    waiting.delete(name);
    one.reject(new Error(`parts/${name}.js is missing: copy the whole folder of the studio`));
  };
  document.head.append(script);
  return one;
}
