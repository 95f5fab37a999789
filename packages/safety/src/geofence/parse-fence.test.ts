import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import { EarthFrame } from './earth-frame.ts';
import { FenceError, parseFence } from './parse-fence.ts';

type Json = Record<string, unknown>;
const ring = [
  [0, 0],
  [4, 0],
  [4, 3],
  [0, 0],
];
const polygon = (properties: Json = { kind: 'allowed' }, coordinates: unknown = [ring]) => ({
  ...{ type: 'Feature', properties },
  geometry: { type: 'Polygon', coordinates },
});
const circle = (properties: Json) => ({
  ...{ type: 'Feature', properties },
  geometry: { type: 'Point', coordinates: [1, 2] },
});
const file = (features: unknown[], more: Json = { frame: 'world' }) =>
  JSON.stringify({ type: 'FeatureCollection', ...more, features });

describe('a fence in metres', () => {
  test('has areas of three kinds, polygons and circles', () => {
    const text = file([
      polygon(),
      polygon({ kind: 'slow', maxMps: 0.3, name: 'the door' }),
      circle({ kind: 'forbidden', radiusM: 0.5 }),
    ]);
    const { fence, earth } = parseFence(text, null);
    expect(earth).toBeNull();
    const area = { shape: 'polygon', rings: [ring.slice(0, 3)] };
    expect(fence).toEqual({
      ...{ allowed: [area], slow: [{ area, maxMps: 0.3 }], radiusM: null },
      forbidden: [{ shape: 'circle', centre: [1, 2], radiusM: 0.5 }],
    });
  });

  test.each([
    ['{', 'is not JSON'],
    ['[]', /expected object/],
    [file([]), 'features: must have an area'],
    [file([polygon({ kind: 'allow' })]), 'features[0].properties.kind: must be allowed, slow or forbidden'],
    [file([polygon({ kind: 'slow' })]), 'features[0].properties.maxMps: is needed for a slow area'],
    [
      file([polygon({ kind: 'allowed', maxMps: 1 })]),
      'features[0].properties.maxMps: is for a slow area only',
    ],
    [file([circle({ kind: 'allowed' })]), 'features[0].properties.radiusM: is needed for a Point'],
    [file([polygon({ kind: 'allowed', radiusM: 1 })]), 'features[0].properties.radiusM: is for a Point only'],
    [file([polygon({ kind: 'allowed' }, [ring.slice(0, 3)])]), /must be a ring of four or more/],
    [
      file([polygon({ kind: 'allowed' }, [[...ring.slice(0, 3), [0, 1]]])]),
      'features[0].geometry.coordinates[0]: the last position must be the first',
    ],
    [file([polygon({ kind: 'allowed' }, [ring.map(([x, y]) => [x, (y ?? 0) * 1e6])])]), /more than 10 km/],
    [file([polygon()], { frame: 'map' }), 'frame: must be wgs84 or world'],
    [file([polygon()], {}), /needs the place of the world’s origin/],
    [
      file([polygon({ kind: 'allowed' }, [Array.from({ length: 302 }, (_, i) => [i % 301, 0])])]),
      'has 301 corners; at most 300 are allowed',
    ],
  ])('%s', (text, message) => {
    expect(() => parseFence(text, null)).toThrow(message);
  });

  test('any text gives a fence or says what is wrong', () => {
    const anything = fc.oneof(
      fc.string(),
      fc.json(),
      fc.jsonValue().map((value) => file([polygon({ kind: 'allowed' }, value)])),
      fc.jsonValue().map((value) => file([value])),
    );
    fc.assert(
      fc.property(anything, (text) => {
        try {
          parseFence(text, 'first');
        } catch (error) {
          expect(error).toBeInstanceOf(FenceError);
        }
      }),
      { seed: 5 },
    );
  });
});

describe('a fence on the earth', () => {
  const origin = { latitude: 52.5, longitude: 13.4, turnDeg: 0 };

  test('is put into the world’s frame', () => {
    const metres = (latitude: number, longitude: number) =>
      new EarthFrame(origin).toFrame(latitude, longitude);
    // A minute of latitude is a nautical mile.
    expect(metres(52.5 + 1 / 60, 13.4)).toEqual([expect.closeTo(0), expect.closeTo(1854.6, 0)]);
    expect(metres(52.5, 13.401)[0]).toBeCloseTo(67.9, 1);
    const turned = new EarthFrame({ ...origin, turnDeg: 90 }).toFrame(52.501, 13.4);
    expect(turned).toEqual([expect.closeTo(111.26, 1), expect.closeTo(0)]);
    const date = new EarthFrame({ latitude: 0, longitude: 179.9995, turnDeg: 0 }).toFrame(0, -179.9995);
    expect(date[0]).toBeCloseTo(111.3, 1);
  });

  test('has its origin at the first position if nothing else is known, and refuses what is no place', () => {
    const at = (longitude: number, latitude: number) =>
      file(
        [
          polygon({ kind: 'allowed' }, [
            [
              [13.4, 52.5],
              [13.401, 52.5],
              [longitude, latitude],
              [13.4, 52.5],
            ],
          ]),
        ],
        {},
      );
    const { fence, earth } = parseFence(at(13.4, 52.501), 'first');
    expect(earth?.origin).toEqual({ latitude: 52.5, longitude: 13.4, turnDeg: 0 });
    expect(fence.allowed[0]).toMatchObject({
      rings: [
        [
          [0, 0],
          [expect.closeTo(67.9, 1), 0],
          [0, expect.closeTo(111.3, 1)],
        ],
      ],
    });
    expect(() => parseFence(at(13.4, 91), 'first')).toThrow('must be longitude, then latitude, in degrees');
    expect(() => parseFence(at(13.4, 53), 'first')).toThrow('more than 10 km');
    expect(parseFence(at(13.4, 52.501), origin).earth?.origin).toEqual(origin);
  });
});
