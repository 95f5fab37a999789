import { describe, expect, test } from 'vitest';
import {
  appearanceText,
  CloudAppearance,
  defaultLook,
  parseAppearance,
  type StoredAppearance,
} from './cloud-appearance.ts';

const nothing = parseAppearance(null);

describe('the appearance of clouds', () => {
  test('a LiDAR begins with heights, a camera with its own colours; from above without the ceiling', () => {
    expect(defaultLook('Front LiDAR').mode).toBe('height');
    expect(defaultLook('laser_top').mode).toBe('height');
    expect(defaultLook('Camera').mode).toBe('captured');
    expect(nothing.cut).toEqual({ below: null, above: null });
    expect(nothing.cutFromAbove).toEqual({ below: null, above: 2 });
  });

  test('each change is stored and read again', () => {
    let text = '';
    const appearance = new CloudAppearance(nothing, (now) => {
      text = appearanceText(now);
    });
    expect(text).toBe('');
    appearance.setLook('LiDAR', { mode: 'distance', fixed: { min: 1, max: 8 } });
    appearance.setLook('Camera', { mode: 'lit', fixed: null });
    appearance.cut.value = { below: -0.2, above: null };
    appearance.cutFromAbove.value = { below: null, above: null };
    appearance.headingUp.value = false;
    appearance.surface.value = true;
    appearance.memory.value = false;
    appearance.paint.value = false;
    appearance.hazards.value = true;
    const again: StoredAppearance = parseAppearance(text);
    expect([...again.looks]).toEqual([
      ['LiDAR', { mode: 'distance', fixed: { min: 1, max: 8 } }],
      ['Camera', { mode: 'lit', fixed: null }],
    ]);
    expect(again).toMatchObject({
      cut: { below: -0.2, above: null },
      cutFromAbove: { below: null, above: null },
      headingUp: false,
      surface: true,
      memory: false,
      paint: false,
      hazards: true,
    });
    expect(nothing).toMatchObject({ paint: true, hazards: false });
  });

  test('clouds are drawn as surfaces as suits the renderer, until somebody chooses', () => {
    const appearance = new CloudAppearance(nothing, () => {}, true);
    expect(appearance.drawsSurface.value).toBe(true);
    appearance.surface.value = false;
    expect(appearance.drawsSurface.value).toBe(false);
    expect(new CloudAppearance({ ...nothing, surface: true }, () => {}).drawsSurface.value).toBe(true);
  });

  test('keeps 32 sensors, those changed last', () => {
    const appearance = new CloudAppearance(nothing, () => {});
    for (let i = 0; i < 40; i++) appearance.setLook(`s${i}`, { mode: 'age', fixed: null });
    expect(appearance.looks.value.size).toBe(32);
    expect(appearance.lookOf('s39').mode).toBe('age');
    expect(appearance.lookOf('s0').mode).toBe('captured');
  });

  test.each([
    '{',
    '7',
    'null',
    '{"looks":[1],"cut":3,"cutFromAbove":null,"headingUp":"no"}',
    '{"looks":{"a":{"mode":"rings"},"b":null},"surface":1}',
  ])('ignores %s', (text) => expect(parseAppearance(text)).toEqual(nothing));

  test('ignores a range that is none', () => {
    const text = '{"looks":{"a":{"mode":"height","fixed":{"min":2,"max":2}}}}';
    expect(parseAppearance(text).looks.get('a')).toEqual({ mode: 'height', fixed: null });
  });
});
