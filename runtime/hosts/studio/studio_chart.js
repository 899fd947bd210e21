/* The chart of a character's levels: their error against their cost. A point is chosen by a click or a key. */
import { shortNumber } from './studio_slider.js';

const WIDTH = 320, HEIGHT = 190, LEFT = 48, RIGHT = 14, TOP = 12, BOTTOM = 34;
/** As the program counts costs. */
const NS_PER_VISIT = 6;
const NAMES = { soft: 'soft', jiggle: 'springy bones', bones: 'bones alone' };
const made = (name, attributes, ...children) => {
  const element = document.createElementNS('http://www.w3.org/2000/svg', name);
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
  element.append(...children);
  return element;
};

/** Levels as Model.detailLevels gives them; `chosen`: what is shown, a number or a kind. */
export function chartOf(levels, chosen, choose) {
  const points = levels.filter(({ kind }) => kind !== 'away').map((one) => ({ ...one, us: one.visits * NS_PER_VISIT / 1000,
    value: one.kind === 'soft' ? one.level : one.kind, text: one.kind === 'soft' ? `level ${one.level}` : NAMES[one.kind] }));
  const mostUs = Math.max(...points.map(({ us }) => us)) * 1.1 || 1, mostError = Math.max(...points.map(({ error }) => error)) * 1.15 || 0.001;
  const x = (us) => LEFT + us / mostUs * (WIDTH - LEFT - RIGHT), y = (error) => HEIGHT - BOTTOM - error / mostError * (HEIGHT - TOP - BOTTOM);
  const marks = points.map((one) => {
    const inWords = `${one.text}: ${one.error ? `${shortNumber(one.error, 'm')} off` : 'the finest'}, ${shortNumber(one.us, 'µs')} a frame`, isRight = x(one.us) > WIDTH * 0.6;
    const mark = made('g', { role: 'radio', tabindex: one.value === chosen ? 0 : -1, 'aria-checked': String(one.value === chosen), 'aria-label': inWords },
      made('title', {}, inWords), made('circle', { cx: x(one.us), cy: y(one.error), r: 6 }),
      made('text', { x: x(one.us) + (isRight ? -10 : 10), y: y(one.error) - 6, 'text-anchor': isRight ? 'end' : 'start' }, one.text));
    mark.addEventListener('click', () => choose(one.value));
    return mark;
  });
  const chart = made('svg', { viewBox: `0 0 ${WIDTH} ${HEIGHT}`, role: 'radiogroup', 'aria-label': 'Level of the soft parts, by error and cost' },
    made('path', { class: 'axis', d: `M${LEFT} ${TOP}V${HEIGHT - BOTTOM}H${WIDTH - RIGHT}` }),
    made('text', { x: LEFT - 5, y: TOP + 8, 'text-anchor': 'end' }, shortNumber(mostError, 'm')), made('text', { x: LEFT - 5, y: HEIGHT - BOTTOM, 'text-anchor': 'end' }, '0'),
    made('text', { x: LEFT + 4, y: TOP + 8 }, 'error'), made('text', { x: WIDTH - RIGHT, y: HEIGHT - BOTTOM + 14, 'text-anchor': 'end' }, shortNumber(mostUs, 'µs')),
    made('text', { x: LEFT, y: HEIGHT - BOTTOM + 14 }, '0'), made('text', { x: (LEFT + WIDTH - RIGHT) / 2, y: HEIGHT - 6, 'text-anchor': 'middle' }, 'physics and skin, a frame'), ...marks);
  chart.addEventListener('keydown', (event) => {
    const at = marks.indexOf(document.activeElement), by = { ArrowLeft: 1, ArrowUp: 1, ArrowRight: -1, ArrowDown: -1 }[event.key];
    if (at < 0 || !by && !['Enter', ' '].includes(event.key)) return;
    event.preventDefault();
    choose(points[(at + (by ?? 0) + points.length) % points.length].value);
  });
  return chart;
}
