/* Data shared by the characters of one asset. */
import { chosen, number, triple } from './checked.js';
import { Lent } from './lent.js';

const SCHEMES = ['automatic', 'symplectic', 'position_based', 'relaxation', 'explicit_euler', 'heun', 'block_descent'];
const DETAIL_KINDS = ['soft', 'jiggle', 'bones', 'away'];

/** Data shared by the characters of one asset. */
export class Model extends Lent {
  constructor(asset, options) {
    super('model');
    const sbfmt = asset.sbfmt, c = sbfmt.calls, scheme = options.scheme ?? 'automatic';
    const name = new TextEncoder().encode(scheme + '\0');
    chosen(SCHEMES, scheme, 'scheme');
    sbfmt.bytes(sbfmt.scratch, name.length).set(name);
    const gravity = triple(options.gravity, 'gravity', [0, 0, 0]);
    this.asset = asset;
    this.level = number(options.level, 'level', 0);
    this.handle = c.web_model_create(asset.handle, this.level, sbfmt.scratch, number(options.substeps, 'substeps', 0),
      options.free ? 1 : 0, options.gravity ? 1 : 0, ...gravity, options.scalar ? 1 : 0, options.detailLevels ? 1 : 0);
    if (this.freed) throw sbfmt.failure();
    asset.use(this);
    this.substeps = c.web_model_substeps(this.handle);
    this.instructions = sbfmt.text(c.web_model_instructions(this.handle));
    const count = c.web_model_detail_levels(this.handle, sbfmt.scratch, 64), n = sbfmt.floats(sbfmt.scratch, 4 * count);
    this.detailLevels = Array.from({ length: count }, (_, i) => ({ kind: DETAIL_KINDS[n[4 * i]], level: n[4 * i + 1], error: n[4 * i + 2], visits: n[4 * i + 3] }));
  }

  /** After its characters. */
  free() {
    if (this.freed) return;
    this.refuseUsers('characters');
    this.asset.leave(this);
    this.asset.sbfmt.calls.web_model_free(this.handle);
    this.handle = 0;
  }
}
