/* Other characters for the page: .sbfz and .glb files that are chosen, or dropped anywhere. */

/** Lets the viewer show what the visitor brings; `tell` says what is wrong with it, '' that nothing is. */
export function listenForFiles(viewer, element, tell) {
  const chooser = element('file');
  const show = async (file) => {
    tell('');
    try {
      viewer.open(new Uint8Array(await file.arrayBuffer()));
    } catch (error) {
      tell(`${file.name}: ${error.message}`);
      return;
    }
    const title = viewer.asset.title || file.name;
    document.title = title;
    element('title').textContent = title;
    viewer.canvas.setAttribute('aria-label', viewer.canvas.getAttribute('aria-label').replace(/^.*(?=, a soft-bodied)/, title));
  };
  element('open').addEventListener('click', () => chooser.click());
  chooser.addEventListener('change', () => {
    if (chooser.files.length) show(chooser.files[0]);
    chooser.value = ''; // the same file again is a change too
  });
  const over = (is) => document.body.classList.toggle('drop', is);
  addEventListener('dragover', (event) => {
    event.preventDefault();
    over(true);
  });
  addEventListener('dragleave', (event) => event.relatedTarget ?? over(false));
  addEventListener('drop', (event) => {
    event.preventDefault();
    over(false);
    const [file] = event.dataTransfer.files;
    if (file) show(file);
    else tell('That is no file: drop an .sbfz or a .glb.');
  });
}
