/* Soft-bodied characters of the sbfmt format, in a page or under node. Types and what everything means: sbfmt.d.ts.
 *
 *   const sbfmt = await load();
 *   const asset = sbfmt.asset(bytes);
 *   const world = sbfmt.world();
 *   const lizard = world.add(asset.model());
 *   lizard.drive(0.25);
 *   world.step(1 / 60);
 *   lizard.skin(0).positions
 *
 * Views of numbers lie in the library's own memory: they are read at once or copied. */

export { load } from './modules/library.js';
export { SbfmtError } from './modules/sbfmt_error.js';
