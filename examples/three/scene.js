/* A character that walks in a circle, in three.js: loaded by GLTFLoader with SoftBodyPlugin, moved by the runtime, worked by the pointer. */
import * as THREE from 'three';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import { load } from 'sbfmt';
import { SoftBodyPlugin } from 'sbfmt/three';

const LONGEST_FRAME = 1 / 20; // s: a slower machine shows slow motion
const CLICK_PX = 4, PUSH = 2, PULL = 60; // pixels that a click may move; m/s that it gives; m/s^2 that a drag gives at most
const COLORS = { light: { background: 0xdcdcda, lines: 0xb8b8b4, shadow: 0.3 }, dark: { background: 0x242628, lines: 0x3c3f42, shadow: 0.55 } };

const canvas = document.querySelector('#canvas'), hint = document.querySelector('#hint');

/** The bytes that the page has in an element, as base64. */
function bytesOf(id) {
  return Uint8Array.from(atob(document.getElementById(id).textContent), (one) => one.charCodeAt(0));
}

async function start() {
  const sbfmt = await load(bytesOf('library')), world = sbfmt.world();
  const loader = new GLTFLoader();
  loader.register((parser) => new SoftBodyPlugin(parser, { sbfmt, world }));
  const { scene: loaded, softCharacter: shown } = await loader.parseAsync(bytesOf('character').buffer, '');
  const { character } = shown;
  const box = new THREE.Box3().setFromObject(shown), size = box.getSize(new THREE.Vector3()).length();
  character.drive(0.4 * size, 0.35); // m/s, rad/s

  const scene = new THREE.Scene();
  scene.add(loaded);
  const { light, paint } = surround(scene, size);
  const camera = new THREE.PerspectiveCamera(35, 1, 0.01 * size, 100 * size);
  const renderer = new THREE.WebGLRenderer({ canvas, antialias: true });
  renderer.shadowMap.enabled = true;
  renderer.shadowMap.type = THREE.PCFSoftShadowMap;
  const pointer = takePointer(world, character, camera);
  const controls = new OrbitControls(camera, canvas);
  Object.assign(controls, { enableDamping: true, enablePan: false, maxPolarAngle: 0.49 * Math.PI,
    minDistance: 0.6 * size, maxDistance: 8 * size });
  pointer.onHold = (held) => { controls.enabled = !held; };
  box.getCenter(controls.target);
  camera.position.copy(controls.target).add(new THREE.Vector3(1.15, 0.55, 1.1).multiplyScalar(size));

  /** Camera and light go with the character. */
  const target = new THREE.Vector3();
  function follow(seconds) {
    new THREE.Box3().setFromObject(shown).getCenter(target);
    const step = target.clone().sub(controls.target).multiplyScalar(1 - Math.exp(-4 * seconds));
    controls.target.add(step);
    camera.position.add(step);
    light.target.position.copy(target);
    light.position.copy(target).add(light.userData.from);
  }
  function draw() {
    renderer.render(scene, camera);
  }
  function step(seconds) {
    pointer.pull();
    world.step(seconds);
    shown.update();
    follow(seconds);
    controls.update();
  }
  function resize() {
    renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    renderer.setSize(innerWidth, innerHeight, false);
    camera.aspect = innerWidth / innerHeight;
    camera.updateProjectionMatrix();
    draw();
  }
  addEventListener('resize', resize);
  paint();
  step(1 / 60);
  resize();
  const clock = new THREE.Clock();
  renderer.setAnimationLoop(() => {
    step(Math.min(clock.getDelta(), LONGEST_FRAME));
    draw();
  });
  globalThis.stage = { sbfmt, world, character, shown, scene, camera, controls, renderer, step, draw }; // for the browser's console
}

/** Ground, lights and background, as light or as dark as the visitor's system. */
function surround(scene, size) {
  const sky = new THREE.HemisphereLight(0xffffff, 0x8a8078, 1.6), light = new THREE.DirectionalLight(0xfff4e6, 2.4);
  light.userData.from = new THREE.Vector3(1.2, 2.2, 0.8).multiplyScalar(size);
  light.castShadow = true;
  light.shadow.mapSize.set(2048, 2048);
  Object.assign(light.shadow.camera, { left: -size, right: size, top: size, bottom: -size, near: 0.1 * size, far: 6 * size });
  Object.assign(light.shadow, { bias: -0.0003, normalBias: 0.002 * size });
  const ground = new THREE.Mesh(new THREE.PlaneGeometry(60 * size, 60 * size).rotateX(-Math.PI / 2), new THREE.ShadowMaterial());
  ground.receiveShadow = true;
  const tile = new THREE.CanvasTexture(Object.assign(document.createElement('canvas'), { width: 256, height: 256 }));
  Object.assign(tile, { wrapS: THREE.RepeatWrapping, wrapT: THREE.RepeatWrapping, colorSpace: THREE.SRGBColorSpace, anisotropy: 8 });
  tile.repeat.setScalar(120);
  const floor = new THREE.Mesh(ground.geometry, new THREE.MeshBasicMaterial({ map: tile, depthWrite: false }));
  floor.renderOrder = -1; // below all else, also the shadow
  scene.fog = new THREE.Fog(0, 4 * size, 14 * size);
  scene.add(sky, light, light.target, floor, ground);
  const dark = matchMedia('(prefers-color-scheme: dark)');
  function paint() {
    const colors = COLORS[dark.matches ? 'dark' : 'light'];
    scene.background = new THREE.Color(colors.background);
    scene.fog.color.set(colors.background);
    const pen = tile.image.getContext('2d');
    Object.assign(pen, { fillStyle: scene.background.getStyle(), strokeStyle: new THREE.Color(colors.lines).getStyle(), lineWidth: 4 });
    pen.fillRect(0, 0, 256, 256);
    pen.strokeRect(0, 0, 256, 256);
    tile.needsUpdate = true;
    ground.material.opacity = colors.shadow;
  }
  dark.addEventListener('change', paint);
  return { light, paint };
}

/** What the pointer does to the character. `onHold(held)` is called when it takes it and lets it go. */
function takePointer(world, character, camera) {
  const rays = new THREE.Raycaster(), hands = { onHold() {}, pull };
  let held;
  function aim({ offsetX, offsetY }) {
    rays.setFromCamera(new THREE.Vector2(2 * offsetX / canvas.clientWidth - 1, 1 - 2 * offsetY / canvas.clientHeight), camera);
    return rays.ray;
  }
  function hitBy(event) {
    const { origin, direction } = aim(event), hit = world.ray(origin.toArray(), direction.toArray(), camera.far);
    return hit?.character === character.id ? { ...hit, direction } : undefined;
  }
  canvas.addEventListener('pointerdown', (event) => {
    const hit = event.button === 0 && !held && hitBy(event);
    if (!hit || hit.softBody < 0) return;
    const place = new THREE.Vector3(...hit.position), facing = camera.getWorldDirection(new THREE.Vector3());
    held = { ...hit, id: event.pointerId, from: [event.offsetX, event.offsetY], vertex: character.nearestVertex(hit.softBody, hit.position),
      plane: new THREE.Plane().setFromNormalAndCoplanarPoint(facing, place), target: undefined };
    canvas.setPointerCapture(event.pointerId);
    hands.onHold(true);
  });
  canvas.addEventListener('pointermove', (event) => {
    if (held?.id !== event.pointerId) return;
    if (!held.target && Math.hypot(event.offsetX - held.from[0], event.offsetY - held.from[1]) < CLICK_PX) return;
    const place = aim(event).intersectPlane(held.plane, new THREE.Vector3());
    if (place) held.target = place.setY(Math.max(place.y, 0)).toArray();
  });
  for (const kind of ['pointerup', 'pointercancel'])
    canvas.addEventListener(kind, (event) => {
      if (held?.id !== event.pointerId) return;
      const { softBody, vertex, target, direction } = held;
      held = undefined;
      hands.onHold(false);
      if (target) character.release(softBody, vertex);
      else if (kind === 'pointerup') push(softBody, direction);
    });
  canvas.addEventListener('dblclick', (event) => {
    if (hitBy(event)) character.fall();
  });
  function push(softBody, direction) {
    const impulse = direction.clone().multiplyScalar(PUSH * character.softMotion(softBody).mass);
    character.applySoftImpulse(softBody, impulse.toArray());
  }
  /** Before each step. */
  function pull() {
    if (!held?.target) return;
    character.grab(held.softBody, held.vertex, held.target, { maxForce: PULL * character.softMotion(held.softBody).mass });
  }
  return hands;
}

start().catch((error) => {
  hint.textContent = `The character cannot be shown: ${error.message}`;
  throw error;
});
