/* Events, from numbers to objects. */
import { EVENT_NUMBERS, EVENT_ROOM } from './memory.js';

/** In the order of web_world_events. */
const EVENTS = ['footDown', 'footUp', 'landed', 'torn', 'unsplit', 'asleep', 'awake', 'contactBegin', 'contactEnd', 'contactHit',
  'detailChanged', 'memoryRefused'];

/** Events of the last step, oldest first. */
export function eventsOf({ sbfmt, calls, handle }) {
  const count = calls.web_world_events(handle, sbfmt.scratch, EVENT_ROOM), n = sbfmt.doubles(sbfmt.scratch, count * EVENT_NUMBERS);
  return Array.from({ length: count }, (_, i) => {
    const e = n.slice(i * EVENT_NUMBERS, (i + 1) * EVENT_NUMBERS);
    return { kind: EVENTS[e[0]], character: e[1], leg: e[2], softBody: e[3], rigidBody: e[4], collider: e[5], tick: e[6],
      impulse: e[7], position: Array.from(e.slice(8, 11)), normal: Array.from(e.slice(11, 14)), other: e[14],
      otherSoftBody: e[15], otherRigidBody: e[16], speed: e[17], fromDetailLevel: e[18], toDetailLevel: e[19] };
  }).sort((a, b) => a.tick - b.tick);
}
