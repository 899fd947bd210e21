/* Checks of arguments before calls of the library. */

export function number(value, name, otherwise) {
  if (value === undefined && otherwise !== undefined) return otherwise;
  if (typeof value !== 'number' || !Number.isFinite(value)) throw new TypeError(`${name} is to be a finite number, not ${value}`);
  return value;
}

export function triple(value, name, otherwise) {
  if (value === undefined && otherwise) return otherwise;
  if (!value || value.length !== 3) throw new TypeError(`${name} is to be three numbers, [x, y, z]`);
  return Array.from(value, (one) => number(one, name));
}

export function quadruple(value, name) {
  if (!value || value.length !== 4) throw new TypeError(`${name} is to be four numbers, [x, y, z, w]`);
  return Array.from(value, (one) => number(one, name));
}

/** An index below a count. */
export function placeIn(value, count, name) {
  if (!Number.isInteger(value) || value < 0 || value >= count)
    throw new TypeError(count ? `${name} is 0 to ${count - 1}, not ${value}` : `there is no ${name} ${value}: the asset has none`);
  return value;
}

export function chosen(list, value, name) {
  const place = list.indexOf(value);
  if (place < 0) throw new TypeError(`${name} is one of ${list.join(', ')}, not ${value}`);
  return place;
}
