/* What a visitor takes away: files, and the code that shows them. */
import { element } from './studio_page.js';

const TYPES = { glb: 'model/gltf-binary', html: 'text/html', sbf: 'application/xml', sbfz: 'application/octet-stream' };

export function save(name, bytes) {
  const link = document.createElement('a'), kind = name.slice(name.lastIndexOf('.') + 1);
  link.href = URL.createObjectURL(new Blob([bytes], { type: TYPES[kind] ?? bytes.type }));
  link.download = name;
  document.body.append(link);
  link.click();
  link.remove();
  setTimeout(() => URL.revokeObjectURL(link.href), 60000);
}

const inQuotes = (name) => JSON.stringify(name);

/** Programs that walk the character at a speed, m/s: [[title, text]]. */
function snippetsOf(name, speed, commands) {
  const file = `${name}.sbfz`, pace = Number(speed.toPrecision(3));
  return [
    ['Shell', commands],
    ['C', `// #include "sbfmt/packed.h", "sbrun/events.h"; link with sbrun
sbf_asset *asset;
sbr_model *model;
sbr_world *world;
sbr_character_id character;
sbr_world_definition of_world = sbr_default_world_definition();
sbr_character_definition of_character = sbr_default_character_definition();
sbf_packed_load_file(${inQuotes(file)}, NULL, &asset, &error);
sbr_model_create(asset, NULL, &model, &error);
sbr_world_create(&of_world, &world, &error);
sbr_character_create(world, model, &of_character, &character, &error);
sbr_character_set_drive(world, character, ${pace}, 0, 0); // m/s
sbr_world_step(world, 1.0 / 60); // each frame; then sbr_character_get_skin`],
    ['three.js', `import { load } from 'sbfmt';
import { SoftCharacter } from 'sbfmt/three';

const sbfmt = await load(), world = sbfmt.world(), file = await fetch(${inQuotes(file)});
const character = world.add(sbfmt.asset(await file.arrayBuffer()).model());
character.drive(${pace}); // m/s
const shown = new SoftCharacter(character);
scene.add(shown);
// each frame: world.step(1 / 60); shown.update();`],
    ['Godot', `extends Node3D

func _ready() -> void:
\tvar character := SoftCharacter3D.new()
\tcharacter.asset = load(${inQuotes(`res://${file}`)})
\tcharacter.forward_speed = ${pace} # m/s
\tadd_child(character)`],
  ];
}

/** Shows the snippets, each with a button that copies it. */
export function showSnippets(name, speed, commands, edited) {
  element('editedToo').hidden = !edited;
  element('snippets').replaceChildren(...snippetsOf(name, speed, commands).map(([title, text]) => {
    const box = document.createElement('div'), head = document.createElement('h3'), pre = document.createElement('pre');
    const copy = Object.assign(document.createElement('button'), { type: 'button', textContent: 'Copy' });
    copy.setAttribute('aria-label', `Copy the code for ${title}`);
    copy.addEventListener('click', async () => {
      await navigator.clipboard.writeText(text);
      copy.textContent = 'Copied';
    });
    box.className = 'snippet';
    head.append(title, copy);
    pre.textContent = text;
    pre.tabIndex = 0;
    pre.setAttribute('aria-label', title);
    box.append(head, pre);
    return box;
  }));
}
