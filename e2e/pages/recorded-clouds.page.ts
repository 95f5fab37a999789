/**
 * Clouds of real sensors, and of the simulated one, by the robot's own sources and encoders: all of each is drawn, where it
 * was seen and in its colours.
 */
import { expect, test } from '../src/stage/page-test.ts';
import { FRAME_MS, type Rgb, type Stage } from '../src/stage/stage.ts';

const BACKGROUND: Rgb = [11, 15, 20];
/** Of the canvas, pixels. */
const [WIDTH, HEIGHT] = [320, 180];
/** As coarse as the formats make colours. */
const COLOUR_LEVELS = 9;

interface Facts {
  name: string;
  /** Of its first frame: points that have a place, and what of them fits `points64` at 40 Mbit/s and 5 frames/s. */
  whole: number;
  plain: number;
  /** Of the file's points in the world, metres: x, y, z. The sensor is 1 m above the ground, and looks ahead. */
  bounds: readonly (readonly [min: number, max: number])[];
  /** How much the encoder rounds at the farthest point, metres. */
  roundedM: number;
  /** How much of the picture its points cover at least, 0–1. */
  drawn: number;
  /** Directions in which the file has only one colour, and which. */
  colours: readonly { right: number; down: number; colour: Rgb }[];
}

const OFFICE: Facts = {
  ...{ name: 'sim-office', whole: 208_316, plain: 120_450, drawn: 0.7, roundedM: 0.15 },
  bounds: [
    [0.762, 11.077],
    [-7.356, 2.422],
    [0.235, 4.905],
  ],
  colours: [],
};

const CAMERAS: readonly Facts[] = [
  {
    ...{ name: 'kinect-room', whole: 259_847, plain: 120_450, drawn: 0.25, roundedM: 0.01 },
    bounds: [
      [0.843, 3.821],
      [-1.81, 1.072],
      [0.592, 2.581],
    ],
    colours: [
      { right: 0.3, down: -0.2, colour: [169, 139, 121] },
      { right: 0.2, down: 0.2, colour: [179, 159, 160] },
      { right: -0.4, down: 0.2, colour: [234, 222, 229] },
    ],
  },
  {
    ...{ name: 'stereo-table', whole: 209_280, plain: 120_450, drawn: 0.12, roundedM: 0.01 },
    bounds: [
      [0.69, 2.593],
      [-0.715, 0.456],
      [0.821, 1.511],
    ],
    colours: [],
  },
  {
    ...{ name: 'rgbd-sequence', whole: 267_129, plain: 120_450, drawn: 0.25, roundedM: 0.06 },
    bounds: [
      [0.955, 2.702],
      [-1.043, 1.366],
      [0.574, 2.171],
    ],
    colours: [
      { right: 0.1, down: 0, colour: [255, 255, 255] },
      { right: 0.3, down: -0.4, colour: [176, 192, 204] },
      { right: -0.3, down: 0.3, colour: [253, 175, 129] },
    ],
  },
];

const STREET: Facts = {
  ...{ name: 'lidar-street', whole: 115_385, plain: 114_239, drawn: 0.25, roundedM: 0.01, colours: [] },
  bounds: [
    [-71.036, 73.039],
    [-21.105, 53.797],
    [-4.16, 3.672],
  ],
};
/** Of the points that have a place in `points64`: none is farther than 32.767 m along an axis. */
const STREET_IN_POINTS64 = [
  [-32.756, 32.023],
  [-21.105, 30.792],
  [-4.16, 2.595],
] as const;

/** Draws the first frame of a cloud, and expects all of its points, at their places and in their colours. */
async function expectDrawn(stage: Stage, cloud: string, points: number, facts: Facts): Promise<void> {
  await stage.cloud(cloud, { frame: 0 });
  await stage.frames(4);
  const { points: drawn, bounds, camera } = await stage.probe();
  expect(drawn, cloud).toBe(points);
  expect(camera, cloud).toEqual({ x: 0, y: 0, z: 1, yaw: 0 });
  for (const [axis, [min, max]] of facts.bounds.entries()) {
    const off = [(bounds?.min[axis] ?? Number.NaN) - min, (bounds?.max[axis] ?? Number.NaN) - max];
    expect(Math.max(...off.map(Math.abs)), `${cloud}: bounds of axis ${axis}`).toBeLessThan(facts.roundedM);
  }
  const pixels = await stage.pixels();
  const empty = pixels.filter((pixel) => isNear(pixel, BACKGROUND, 6)).length;
  expect(1 - empty / pixels.length, cloud).toBeGreaterThan(facts.drawn);
  const [fx, fy] = await stage.script(({ app }) => {
    const { elements } = app.stage.viewCamera.projectionMatrix;
    return [elements[0], elements[5]] as const;
  });
  for (const { right, down, colour } of facts.colours) {
    const column = Math.round(WIDTH * (0.5 + (right * fx) / 2));
    const row = Math.round(HEIGHT * (0.5 + (down * fy) / 2));
    // A pixel may show the background between two points.
    const around = [-2, -1, 0, 1, 2].flatMap((dy) =>
      [-2, -1, 0, 1, 2].map((dx) => pixels[(row + dy) * WIDTH + column + dx] ?? BACKGROUND),
    );
    const seen = [0, 1, 2].map((i) => median(around.map((pixel) => pixel[i] ?? 0)));
    expect(isNear(seen, colour, COLOUR_LEVELS), `${cloud}: ${seen} at ${right}, ${down}`).toBe(true);
  }
}

function median(values: number[]): number {
  return values.sort((a, b) => a - b)[values.length >> 1] ?? Number.NaN;
}

function isNear(one: readonly number[], other: readonly number[], levels: number): boolean {
  return one.every((level, i) => Math.abs(level - (other[i] ?? Number.NaN)) <= levels);
}

test('all of a cloud of 480 × 480 pixels is drawn, and of points64 what the rate allows', async ({
  stage,
}) => {
  await stage.open({ state: 'still', query: { every: '1' }, frameMs: FRAME_MS });
  await stage.load('sim-office', 'sim-office-points64');
  await expectDrawn(stage, 'sim-office-points64', OFFICE.plain, OFFICE);
  await expectDrawn(stage, 'sim-office', OFFICE.whole, OFFICE);
  const { pointsPerFrame, packetsLost, drops } = await stage.stats();
  expect({ pointsPerFrame, packetsLost, drops }).toEqual({
    ...{ pointsPerFrame: (OFFICE.plain + OFFICE.whole) / 2, packetsLost: 0, drops: {} },
  });
});

for (const recording of CAMERAS) {
  const { name, whole, plain } = recording;
  test(`a depth camera’s recording is drawn: all points, at their places, in their colours: ${name}`, async ({
    stage,
    loadRecordings,
  }) => {
    await stage.open({ state: 'still', query: { every: '1' } });
    await loadRecordings(name, `${name}-points64`);
    await expectDrawn(stage, `${name}-points64`, plain, recording);
    await expectDrawn(stage, name, whole, recording);
  });
}

test('a street that a LiDAR recorded is drawn; the grid lies on the ground that is seen, and all of it fits the view from above', async ({
  stage,
  loadRecordings,
}) => {
  const page = await stage.open({ state: 'still', query: { every: '1' } });
  await loadRecordings('lidar-street', 'lidar-street-points64');
  await expectDrawn(stage, 'lidar-street-points64', STREET.plain, { ...STREET, bounds: STREET_IN_POINTS64 });
  await expectDrawn(stage, 'lidar-street', STREET.whole, STREET);
  // The sensor was 1.7 to 1.9 m above the street.
  for (let i = 0; i < 6; i++) {
    await stage.cloud('lidar-street');
    await stage.frames(12);
  }
  const { gridM, reachM } = (await stage.state()).scene;
  expect(gridM).toBeLessThan(-0.55);
  expect(gridM).toBeGreaterThan(-1);
  expect(reachM).toBeGreaterThan(15);
  // Seen from above, the street is in the middle of the screen, and nothing goes beyond its edges.
  await page.keyboard.press('t');
  await stage.frames(20);
  const empty = (x: number) => stage.share(BACKGROUND, { x, y: 0.25, width: 0.1, height: 0.45 }, 6);
  expect(await empty(0)).toBeGreaterThan(0.95);
  expect(await empty(0.9)).toBeGreaterThan(0.95);
  expect(await empty(0.4)).toBeLessThan(0.35);
});
