/* Objects in the library's memory, and their users. */

/** A handle that throws if it is used after it was freed, or freed while objects made from it exist. */
export class Lent {
  #name;
  #handle = 0;
  #users = new Set();

  constructor(name) {
    this.#name = name;
  }

  get handle() {
    if (!this.#handle) throw new TypeError(`this ${this.#name} was freed`);
    return this.#handle;
  }
  set handle(handle) {
    this.#handle = handle;
  }
  get freed() {
    return !this.#handle;
  }

  use(user) {
    this.#users.add(user);
  }
  leave(user) {
    this.#users.delete(user);
  }
  get users() {
    return [...this.#users];
  }
  /** Call before it is freed: objects made from it must be freed first. */
  refuseUsers(what) {
    if (this.#users.size) throw new TypeError(`this ${this.#name} is freed after its ${what}, of which there are ${this.#users.size} left`);
  }
}
