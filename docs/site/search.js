// Finds sections that hold all words of a query. The index is a script, since pages from disk may not fetch files.
const field = document.getElementById('search'), results = document.getElementById('results');
const most = 20;

// How well a section fits: 0 if a word is missing; words in the title and the heading count more.
function score([title, heading, , text], words) {
  const of = [title, heading, text].map((one) => one.toLowerCase());
  let sum = 0;
  for (const word of words) {
    const here = (of[0].includes(word) ? 8 : 0) + (of[1].includes(word) ? 4 : 0) + (of[2].includes(word) ? 1 : 0);
    if (!here) return 0;
    sum += here;
  }
  return sum;
}

function find() {
  const words = field.value.toLowerCase().split(/\s+/).filter(Boolean);
  const found = words.length ? searchIndex.map((one) => [score(one, words), one]).filter(([points]) => points) : [];
  found.sort((a, b) => b[0] - a[0]);
  results.replaceChildren(...found.slice(0, most).map(([, [title, heading, page]]) => {
    const item = document.createElement('li'), link = document.createElement('a');
    link.href = `${document.body.dataset.top}/${page}`;
    link.textContent = heading ? `${title}: ${heading}` : title;
    item.append(link);
    return item;
  }));
}

field.addEventListener('input', find);
field.value = new URLSearchParams(location.search).get('search') ?? '';
find();
