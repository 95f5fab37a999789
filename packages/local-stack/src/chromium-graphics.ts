/** What Chromium draws with in tests and benchmarks. */

/** By name, Chromium's flags. */
const GRAPHICS = {
  // On the processor. Compositing is software too: the window need not be drawn by the same emulated GPU.
  software: [
    '--use-angle=swiftshader',
    '--enable-unsafe-swiftshader',
    '--disable-gpu-compositing',
    '--disable-gpu-rasterization',
  ],
  // On a GPU, which needs no display.
  vulkan: ['--use-angle=vulkan', '--enable-features=Vulkan', '--disable-vulkan-surface'],
  egl: ['--use-angle=gl-egl'],
} as const;

export type ChromiumGraphics = keyof typeof GRAPHICS;

const VARIABLE = 'FARPOINT_GRAPHICS';

/** @param name as `FARPOINT_GRAPHICS` has it; empty: `software` @throws {Error} if there is no such graphics */
export function chromiumGraphics(name = process.env[VARIABLE] ?? ''): ChromiumGraphics {
  if (name === '') return 'software';
  if (Object.hasOwn(GRAPHICS, name)) return name as ChromiumGraphics;
  throw new Error(`${VARIABLE} is \`${name}\`, not ${Object.keys(GRAPHICS).join(', ')}`);
}

export function graphicsFlags(graphics: ChromiumGraphics): string[] {
  return ['--use-gl=angle', '--ignore-gpu-blocklist', ...GRAPHICS[graphics]];
}
