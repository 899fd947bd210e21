/* A slider with its number and unit; on a logarithmic scale unless it is told otherwise. */

/** Three digits, with the prefix of the unit that keeps them short. */
export function shortNumber(value, unit) {
  if (unit === 'Pa') {
    const [factor, prefix] = value >= 1e6 ? [1e6, 'MPa'] : value >= 1e3 ? [1e3, 'kPa'] : [1, 'Pa'];
    return `${Number((value / factor).toPrecision(3))} ${prefix}`;
  }
  if (unit === 'm' && value < 1) return `${Number((100 * value).toPrecision(3))} cm`;
  return `${Number(value.toPrecision(3))}${unit ? ` ${unit}` : ''}`;
}

/** A label with a slider; `change(value)` is called when it was moved. */
export function slider({ label, unit, low, high, linear }, value, change) {
  const control = document.createElement('label'), text = document.createElement('span'), shown = document.createElement('span');
  const input = Object.assign(document.createElement('input'), { type: 'range', min: 0, max: 1, step: 0.001 });
  const toValue = (at) => (linear ? low + at * (high - low) : low * (high / low) ** at);
  const toPlace = (number) => (linear ? (number - low) / (high - low) : Math.log(Math.max(number, low) / low) / Math.log(high / low));
  const tell = (number) => {
    shown.textContent = shortNumber(number, unit);
    input.setAttribute('aria-valuetext', shown.textContent);
  };
  control.className = 'slider';
  shown.className = 'value';
  text.textContent = label;
  control.append(text, shown, input);
  input.value = toPlace(value);
  tell(value);
  input.addEventListener('input', () => tell(toValue(Number(input.value))));
  input.addEventListener('change', () => change(Number(toValue(Number(input.value)).toPrecision(3))));
  return control;
}
