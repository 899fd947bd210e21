/* What lies in the library's memory until it is freed, and who still uses it. */

/** A handle that says so when it is used after it was freed, and that nothing takes away from what is made of it. */
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
  /** Before it is freed: what is made of it goes first. */
  refuseUsers(what) {
    if (this.#users.size) throw new TypeError(`this ${this.#name} is freed after its ${what}, of which there are ${this.#users.size} left`);
  }
}
