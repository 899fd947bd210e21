/* A shape of the host's. */
import { chosen, number, quadruple, triple } from './checked.js';

const SHAPES = ['sphere', 'box', 'capsule'];

/** A shape of the host that characters collide with. */
export class Collider {
  constructor(world, options) {
    const c = world.calls, kind = chosen(SHAPES, options.shape ?? 'sphere', 'shape');
    this.world = world;
    this.shape = c.web_shape_create(kind, number(options.radius, 'radius', 0.5),
      ...triple(options.halfSizes, 'halfSizes', [0.5, 0.5, 0.5]));
    if (!this.shape) throw world.sbfmt.failure();
    this.id = c.web_collider_create(world.handle, this.shape, ...triple(options.position, 'position', [0, 0, 0]),
      number(options.friction, 'friction', -1), number(options.restitution, 'restitution', -1));
    if (this.id) {
      world.use(this);
      return;
    }
    const failure = world.sbfmt.failure();
    c.web_shape_free(this.shape);
    throw failure;
  }

  /** Handle of its world, while that exists. */
  get home() {
    if (!this.id) throw new TypeError('this collider was freed');
    return this.world.handle;
  }

  move(position, rotation = [0, 0, 0, 1]) {
    this.world.calls.web_collider_move(this.home, this.id, 0, ...triple(position, 'position'), ...quadruple(rotation, 'rotation'));
  }
  place(position, rotation = [0, 0, 0, 1]) {
    this.world.calls.web_collider_move(this.home, this.id, 1, ...triple(position, 'position'), ...quadruple(rotation, 'rotation'));
  }
  free() {
    if (!this.id) return;
    this.world.calls.web_collider_free(this.home, this.id);
    this.world.leave(this);
    this.world.calls.web_shape_free(this.shape);
    this.id = 0;
  }
}
