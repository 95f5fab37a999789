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

  test('may be of a map’s editor: empty cells are null, areas have several parts, and a byte order mark is first', () => {
    const empty = { fid: 1, maxMps: null, radiusM: null, note: null };
    const other = ring.map(([x, y]) => [(x ?? 0) + 10, y]);
    const several = (type: string, properties: Json, coordinates: unknown) => ({
      ...{ type: 'Feature', properties, geometry: { type, coordinates } },
    });
    const text = file(
      [
        polygon({ ...empty, kind: 'allowed' }),
        several('MultiPolygon', { ...empty, kind: 'slow', maxMps: 0.5 }, [[ring], [other]]),
        several('MultiPoint', { ...empty, kind: 'forbidden', radiusM: 1 }, [
          [1, 2],
          [3, 4, 5],
        ]),
      ],
      { name: 'yard', crs: { type: 'name' }, frame: 'world' },
    );
    const { fence } = parseFence(`\uFEFF${text}`, null);
    const [first, second] = [ring, other].map((each) => ({ shape: 'polygon', rings: [each.slice(0, 3)] }));
    expect(fence).toEqual({
      ...{ allowed: [first], radiusM: null },
      slow: [
        { area: first, maxMps: 0.5 },
        { area: second, maxMps: 0.5 },
      ],
      forbidden: [
        { shape: 'circle', centre: [1, 2], radiusM: 1 },
        { shape: 'circle', centre: [3, 4], radiusM: 1 },
      ],
    });
    const earthly = file(
      [
        several('MultiPolygon', { kind: 'allowed' }, [
          [ring.map(([x, y]) => [(x ?? 0) / 1e3, (y ?? 0) / 1e3])],
        ]),
      ],
      {},
    );
    expect(parseFence(earthly, 'first').earth?.origin).toEqual({ latitude: 0, longitude: 0, turnDeg: 0 });
  });

  const geometry = (type: unknown, coordinates: unknown = []) =>
    file([{ type: 'Feature', properties: { kind: 'allowed' }, geometry: { type, coordinates } }]);

  test.each([
    ['{', 'is not JSON'],
    ['[]', 'is not a FeatureCollection'],
    [
      geometry('LineString'),
      /^features\[0\]\.geometry[.a-z]*: must be a Polygon, MultiPolygon, Point or MultiPoint$/,
    ],
    [file([{ ...polygon(), geometry: null }]), /^features\[0\]\.geometry: must be a Polygon, MultiPolygon/],
    [file([{ ...polygon(), properties: null }]), 'features[0].properties: must have a kind'],
    [file([polygon({ kind: null })]), 'features[0].properties.kind: must be allowed, slow or forbidden'],
    [
      file([polygon({ kind: 'slow', maxMps: null })]),
      'features[0].properties.maxMps: is needed for a slow area',
    ],
    [file([polygon({ kind: 'slow', maxMps: '0.5' })]), 'features[0].properties.maxMps: must be a number'],
    [geometry('MultiPolygon', []), 'features[0].geometry.coordinates: must have a polygon'],
    [geometry('MultiPolygon', [ring]), /^features\[0\]\.geometry\.coordinates\[0\]\[0\]/],
    [
      geometry('MultiPolygon', [[ring], [[...ring.slice(0, 3), [0, 1]]]]),
      'features[0].geometry.coordinates[1][0]: the last position must be the first',
    ],
    [
      geometry(
        'MultiPolygon',
        Array.from({ length: 101 }, () => [ring]),
      ),
      'corners; at most 300',
    ],
    [geometry('MultiPoint', [[0, 0]]), 'features[0].properties.radiusM: is needed for a MultiPoint'],
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
