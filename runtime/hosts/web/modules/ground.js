/* The grounds of a world. */
import { chosen, number } from './checked.js';

const GROUNDS = ['flat', 'slope', 'stairs', 'noise', 'heights'];

function plainGround(ground = { kind: 'flat' }) {
  const kind = chosen(GROUNDS, ground.kind, 'ground.kind');
  if (kind === 1) {
    const degrees = number(ground.degrees, 'ground.degrees');
    if (Math.abs(degrees) > 45) throw new TypeError('ground.degrees is -45 to 45');
    return [kind, degrees, 0];
  }
  if (kind === 2) return [kind, number(ground.rise, 'ground.rise'), number(ground.run, 'ground.run')];
  if (kind === 3) return [kind, number(ground.height, 'ground.height'), number(ground.seed, 'ground.seed', 1)];
  return [kind, number(ground.height, 'ground.height', 0), 0];
}

/** The parameters of a ground, and a function that frees their memory. */
export function groundNumbers(memory, ground) {
  if (ground?.kind !== 'heights') return [...plainGround(ground), () => {}];
  const { heights, columns, rows } = ground, cell = number(ground.cell, 'ground.cell');
  if (!(columns >= 2 && rows >= 2) || heights?.length !== columns * rows)
    throw new TypeError('ground.heights are columns x rows numbers, at least 2 x 2');
  if (!(cell > 0)) throw new TypeError('ground.cell is above 0');
  if (!Array.prototype.every.call(heights, Number.isFinite)) throw new TypeError('ground.heights are finite numbers');
  const at = memory.room(4 * heights.length);
  memory.floats(at, heights.length).set(heights);
  // An address among numbers: without its sign.
  const field = memory.calls.web_heights_create(at, columns, rows, cell, number(ground.x, 'ground.x', 0), number(ground.z, 'ground.z', 0)) >>> 0;
  return [GROUNDS.indexOf('heights'), field, 0, () => { memory.calls.web_free(field); memory.calls.web_free(at); }];
}

/** Heights and unit normals of a ground at positions x, z, x, z, ... */
export function heightsAt(memory, ground, places) {
  const [kind, a, b, free] = groundNumbers(memory, ground);
  const count = places.length / 2, at = memory.room(places.length * 4 + count * 16);
  memory.floats(at, places.length).set(places);
  const heights = at + places.length * 4, normals = heights + count * 4;
  memory.calls.web_ground_heights(kind, a, b, at, count, heights, normals);
  const found = { heights: memory.floats(heights, count).slice(), normals: memory.floats(normals, count * 3).slice() };
  memory.calls.web_free(at);
  free();
  return found;
}
