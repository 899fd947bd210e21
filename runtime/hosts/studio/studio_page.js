/* The page's elements. */
export const element = (id) => document.getElementById(id);
