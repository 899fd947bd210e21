/* The page's elements. */
export const element = (id) => document.getElementById(id);

/** Puts other controls into a box. The one that takes the place of the one with the focus has the focus. */
export function refill(box, controls) {
  const inputs = () => [...box.querySelectorAll('input')], at = inputs().indexOf(document.activeElement);
  box.replaceChildren(...controls);
  if (at >= 0) inputs()[at]?.focus({ preventScroll: true });
}
