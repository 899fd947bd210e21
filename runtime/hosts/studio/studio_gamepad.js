/* A gamepad: its left stick walks and turns, its right stick turns the view, its triggers sink and rise, its first button knocks
 * over, its second throws a ball. */
const DEAD = 0.15, KNOCK = 0, THROW = 1, SINK = 6, RISE = 7;

export class Gamepad {
  constructor() {
    this.before = [];
  }
  /** What the first gamepad asks for: sticks and triggers from -1 to 1, and buttons that went down since the last call. undefined: nothing. */
  read() {
    const pad = [...navigator.getGamepads?.() ?? []].find((one) => one?.connected && one.mapping === 'standard');
    if (!pad) return undefined;
    const axis = (place) => (Math.abs(pad.axes[place] ?? 0) > DEAD ? pad.axes[place] : 0), value = (place) => pad.buttons[place]?.value ?? 0;
    const down = pad.buttons.map(({ pressed }) => pressed), went = (place) => !!down[place] && !this.before[place];
    const asked = { forward: -axis(1), turn: -axis(0), yaw: axis(2), pitch: axis(3), up: value(RISE) - value(SINK), knock: went(KNOCK), ball: went(THROW) };
    this.before = down;
    return Object.values(asked).some(Boolean) ? asked : undefined;
  }
}
