import { describe, expect, test } from 'vitest';
import { chromiumGraphics, graphicsFlags } from './chromium-graphics.ts';

describe('what Chromium draws with', () => {
  test('is the processor where nothing is asked for', () => {
    expect(chromiumGraphics('')).toBe('software');
    expect(graphicsFlags('software')).toContain('--use-angle=swiftshader');
  });

  test('is a GPU on request, which also puts the window together', () => {
    for (const name of ['vulkan', 'egl']) {
      const flags = graphicsFlags(chromiumGraphics(name));
      expect(flags.join()).not.toMatch(/swiftshader|disable-gpu/);
    }
  });

  test('names what there is where something else is asked for', () => {
    expect(() => chromiumGraphics('metal')).toThrow(
      'FARPOINT_GRAPHICS is `metal`, not software, vulkan, egl',
    );
    expect(() => chromiumGraphics('toString')).toThrow('toString');
  });
});
