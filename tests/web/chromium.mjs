// Chromium for the tests: without a window, with software drawing. Collects errors of the page.
import { createRequire } from 'node:module';
import { mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import path from 'node:path';

/** Opens a tab. Pages may ask for nothing but files of this machine and, where it is given, what `server` has. Faults are gathered, not thrown. */
export async function open(modules, pictures, server) {
  const { chromium } = createRequire(path.join(modules, 'package.json'))('playwright-core');
  const faults = [];
  const profile = mkdtempSync(path.join(tmpdir(), 'sbfmt-page-'));
  const context = await chromium.launchPersistentContext(profile, {
    executablePath: process.env.SBFMT_CHROMIUM ?? '/usr/bin/chromium', headless: true, viewport: { width: 1180, height: 720 }, offline: !server,
    args: ['--headless', '--no-sandbox', '--disable-quic', '--no-first-run', '--disable-background-networking', '--disable-component-update',
      '--disable-sync', '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader'],
  });
  const tab = context.pages()[0] ?? await context.newPage();
  tab.setDefaultTimeout(120000);
  tab.on('pageerror', (error) => faults.push(`the page throws ${error.message}`));
  tab.on('console', (line) => line.type() === 'error' && faults.push(`the page says ${line.text()}`));
  tab.on('request', (asked) => {
    const address = asked.url();
    if (!/^(file|data|blob):/.test(address) && !(server && address.startsWith(server))) faults.push(`the page asks for ${address}`);
  });
  return {
    tab, faults,
    expect: (good, what) => good || faults.push(what),
    shoot: (name) => tab.screenshot({ path: path.join(pictures, `${name}.png`) }),
    close: async () => {
      await context.close();
      rmSync(profile, { recursive: true, force: true });
    },
  };
}

/** How many colours are in the picture that an object of the page draws, `draw()` and `painter.gl` being its own. */
export function colorsDrawn(tab, name) {
  return tab.evaluate((called) => {
    const drawer = globalThis[called];
    drawer.draw();
    const { gl } = drawer.painter, { width, height } = gl.canvas, pixels = new Uint8Array(4 * width * height), colors = new Set();
    gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
    for (let i = 0; i < pixels.length; i += 4) colors.add((pixels[i] >> 4) << 8 | (pixels[i + 1] >> 4) << 4 | pixels[i + 2] >> 4);
    return colors.size;
  }, name);
}
