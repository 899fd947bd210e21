/* Files that a visitor chooses or drops, folders too, as a Map of names and bytes. */
import { element } from './studio_page.js';

/** Files below an entry of a drop. */
async function filesOf(entry, at = '') {
  if (entry.isFile) return [[at + entry.name, await new Promise((resolve, reject) => entry.file(resolve, reject))]];
  const reader = entry.createReader(), found = [];
  for (let some; (some = await new Promise((resolve, reject) => reader.readEntries(resolve, reject))).length;) found.push(...some);
  return (await Promise.all(found.map((one) => filesOf(one, `${at}${entry.name}/`)))).flat();
}
const readAll = async (files) => new Map(await Promise.all(files.map(async ([name, file]) => [name, new Uint8Array(await file.arrayBuffer())])));

/** `take` receives the files, `tell` what is wrong. */
export function listenForDrops(take, tell) {
  const chooser = element('file');
  const bring = async (files) => {
    if (!files.length) return tell('That is no file: drop the files of a character.');
    try {
      await take(await readAll(files));
    } catch (error) {
      tell(error.message);
    }
  };
  element('open').addEventListener('click', () => chooser.click());
  chooser.addEventListener('change', () => {
    const files = [...chooser.files].map((file) => [file.name, file]);
    chooser.value = ''; // the same files again are a change too
    bring(files);
  });
  const over = (is) => document.body.classList.toggle('drop', is);
  addEventListener('dragover', (event) => {
    event.preventDefault();
    over(true);
  });
  addEventListener('dragleave', (event) => event.relatedTarget ?? over(false));
  addEventListener('drop', async (event) => {
    event.preventDefault();
    over(false);
    const entries = [...event.dataTransfer.items ?? []].map((item) => item.webkitGetAsEntry?.()).filter(Boolean);
    if (!entries.length) return bring([...event.dataTransfer.files].map((file) => [file.name, file]));
    bring((await Promise.all(entries.map((entry) => filesOf(entry)))).flat());
  });
}
