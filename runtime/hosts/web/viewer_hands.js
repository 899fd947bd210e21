/* What a visitor of the page makes the character do: walk, be pulled about, be hit by balls. */
import { Stage } from './viewer_stage.js';
import { vector } from './viewer_draw.js';

const BALLS = 6, GRAVITY = 9.80665;
/** A pointer that is down has to go so many pixels before it pulls: a second finger may come, to zoom. */
const SLOP_PX = 4;
/** What keys ask of it, in shares of its pace. */
export const MOVES = {
  KeyW: ['forward', 1], KeyS: ['forward', -0.5], KeyA: ['turn', 1], KeyD: ['turn', -1], KeyQ: ['sideways', 0.5], KeyE: ['sideways', -0.5],
};

export class Hands extends Stage {
  constructor(sbfmt, bytes, canvas) {
    super(sbfmt, bytes, canvas);
    this.keys = new Set();
  }

  restart(...how) {
    this.release();
    super.restart(...how);
  }

  steer() {
    const drive = { forward: 0, turn: 0, sideways: 0 };
    for (const key of this.keys) drive[MOVES[key][0]] += MOVES[key][1];
    const speed = this.choices.speed * this.size;
    this.character.drive(drive.forward * speed, drive.turn * 0.9, drive.sideways * speed);
  }

  /** Grabs the object under the pointer; false if there is none. */
  grab(x, y) {
    const way = this.wayThrough(x, y), hit = this.world.ray(this.eye, way, this.camera.distance * 4);
    if (!hit || !hit.character) return false;
    const rigid = hit.rigidBody >= 0 ? hit.rigidBody : this.rigidOf.get(this.asset.softBodies[hit.softBody]?.bone);
    this.held = { rigid, from: [x, y], target: hit.position, depth: vector.dot(vector.subtract(hit.position, this.eye), this.forward) };
    const soft = hit.softBody >= 0 && this.character.softMotion(hit.softBody).mass > 0;
    if (soft && (rigid === undefined || !this.mass)) { // no bone that could be pulled: the flesh itself
      this.held.vertex = this.character.nearestVertex(hit.softBody, hit.position);
      this.held.softBody = hit.softBody;
      return true;
    }
    if (rigid === undefined || !this.mass) { // nothing that could be pulled: a finger presses
      this.held.finger = this.world.collider({ shape: 'sphere', radius: 0.04 * this.size, position: hit.position });
      return true;
    }
    const state = this.character.rigidState(rigid), center = vector.add(this.character.origin, state.position);
    const back = [-state.rotation[0], -state.rotation[1], -state.rotation[2], state.rotation[3]];
    this.held.local = vector.turn(back, vector.subtract(hit.position, center));
    return true;
  }
  dragTo(x, y) {
    const { held } = this, way = this.wayThrough(x, y);
    if (!held.pulled && Math.hypot(x - held.from[0], y - held.from[1]) < SLOP_PX) return;
    held.pulled = true;
    held.target = vector.add(this.eye, vector.scale(way, held.depth / vector.dot(way, this.forward)));
    held.target[1] = Math.max(held.target[1], this.groundHeight(held.target) + 0.02 * this.size);
  }
  release() {
    this.held?.finger?.free();
    if (this.held?.vertex !== undefined) this.character.release(this.held.softBody, this.held.vertex);
    this.held = undefined;
  }

  /** Pulls the grabbed object towards the pointer, with enough force to lift it. */
  pull(seconds) {
    const { held } = this;
    if (!held?.pulled) return;
    if (held.finger) return held.finger.move(held.target);
    if (held.vertex !== undefined) return this.character.grab(held.softBody, held.vertex, held.target);
    if (this.character.posture !== 'falling') this.character.fall();
    const state = this.character.rigidState(held.rigid);
    const place = vector.add(vector.add(this.character.origin, state.position), vector.turn(state.rotation, held.local));
    // Towards the pointer at a speed, by impulses that this body alone can take, and most of the weight of all that hangs on it.
    let wanted = vector.scale(vector.subtract(held.target, place), 9);
    wanted = vector.scale(wanted, Math.min(1, 3 * Math.sqrt(GRAVITY * this.size) / (vector.length(wanted) || 1)));
    const impulse = vector.scale(vector.subtract(wanted, state.velocity), 1.5 * state.mass);
    const lift = wanted[1] > 0 ? 0.9 * this.mass * GRAVITY * seconds : 0;
    this.character.push(held.rigid, place, vector.add(impulse, [0, lift, 0]));
  }

  /** Throws a ball from beside the eye to the character's middle. */
  throwBall() {
    const radius = 0.07 * this.size, speed = 1.8 * Math.sqrt(GRAVITY * this.size), to = this.subject;
    const from = vector.add(this.eye, vector.scale(this.forward, this.camera.distance * 0.25)), way = vector.subtract(to, from);
    const seconds = vector.length(way) / speed, velocity = vector.scale(way, 1 / seconds);
    velocity[1] += GRAVITY * seconds / 2;
    if (this.balls.length === BALLS) this.balls.shift().collider.free();
    this.balls.push({ collider: this.world.collider({ shape: 'sphere', radius, position: from }), place: from, velocity, radius, hits: 0 });
  }

  /** Flies the balls; one that meets the character knocks it and comes back. */
  flyBalls(seconds) {
    for (const one of this.balls) {
      one.velocity[1] -= GRAVITY * seconds;
      const step = vector.scale(one.velocity, seconds), length = vector.length(step);
      const hit = length > 1e-6 && this.world.ray(one.place, step, length + one.radius);
      if (hit && hit.character && vector.dot(hit.normal, one.velocity) < 0) this.knock(one, hit);
      one.place = vector.add(one.place, vector.scale(one.velocity, seconds));
      const least = this.groundHeight(one.place) + one.radius;
      if (one.place[1] < least) {
        one.place[1] = least;
        one.velocity = [one.velocity[0] * 0.97, Math.abs(one.velocity[1]) * 0.55, one.velocity[2] * 0.97];
      }
      one.collider.move(one.place);
    }
  }

  knock(one, hit) {
    const into = vector.dot(one.velocity, hit.normal), change = vector.scale(hit.normal, -1.4 * into);
    one.velocity = vector.add(one.velocity, change);
    one.hits++;
    const rigid = hit.rigidBody >= 0 ? hit.rigidBody : this.rigidOf.get(this.asset.softBodies[hit.softBody]?.bone);
    if (rigid === undefined || !this.mass) return;
    this.character.fall();
    this.character.push(rigid, hit.position, vector.scale(change, -0.03 * this.mass));
  }
}
