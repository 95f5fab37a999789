import { describe, expect, it } from 'vitest';
import { layerOf, type TestLayer, violationsOf } from './test-rules.ts';

const rules = (layer: TestLayer, source: string) => violationsOf(layer, source).map(({ rule }) => rule);
/** A whole test around some lines. */
const test = (...lines: string[]) => `test('drives', async ({ stage }) => {\n  ${lines.join('\n  ')}\n});\n`;

it.each([
  ['e2e/pages/estop.page.ts', 'deterministic'],
  ['tools/scenario/src/faults.scenario.test.ts', 'deterministic'],
  ['apps/robot-node/src/robot.stack.test.ts', 'stack'],
  ['e2e/smoke/sound.smoke.ts', 'smoke'],
  ['packages/rtp/src/pacer.test.ts', null],
  ['e2e/src/stack.ts', null],
])('%s is a test of layer %s', (file, layer) => {
  expect(layerOf(file)).toBe(layer);
});

const SLEEP = 'await new Promise((resolve) => setTimeout(resolve, 300));';

describe('each rule finds what it forbids', () => {
  it.each<[TestLayer, string, string]>([
    ['deterministic', 'no waitForTimeout', 'await page.waitForTimeout(100); expect(a).toBe(1);'],
    ['deterministic', 'no stack', 'const stack = new LocalStack(); expect(a).toBe(1);'],
    ['deterministic', 'no polling', 'await expect.poll(() => a).toBe(1);'],
    ['deterministic', 'no polling', 'await expect(async () => a).toPass();'],
    ['deterministic', 'no real clock', 'expect(Date.now()).toBe(1);'],
    ['deterministic', 'no real clock', 'expect(performance.now()).toBe(1);'],
    ['deterministic', 'no sleep', `${SLEEP} expect(a).toBe(1);`],
    ['stack', 'no sleep', `${SLEEP} expect(a).toBe(1);`],
    ['stack', 'no port number', "server.listen(300, '127.0.0.1'); expect(a).toBe(1);"],
    ['stack', 'no port number', 'new WebSocketServer({ port: 3001 }); expect(a).toBe(1);'],
    ['stack', 'no port number', "run(['--admin-port', '9000']); expect(a).toBe(1);"],
    ['stack', 'no upper bound of a time', 'expect(tookMs).toBeLessThan(400);'],
    ['stack', 'no upper bound of a time', 'expect(performance.now() - beganMs).toBeLessThanOrEqual(LIMIT);'],
    [
      'smoke',
      'no upper bound of a time',
      'expect(Math.max(...delays.map(({ ageMs }) => ageMs))).toBeLessThan(67);',
    ],
    ['smoke', 'no waitForTimeout', 'await page.waitForTimeout(100); expect(a).toBe(1);'],
    ['smoke', 'no frames as a clock', 'await operator.expectFrames(35);'],
    ['smoke', 'no picture that nobody asked for', 'await page.screenshot({ path }); expect(a).toBe(1);'],
    ['stack', 'a test expects something', 'await drive();'],
    [
      'deterministic',
      'a test expects something after its last action',
      "expect(a).toBe(1);\n  await page.click('#a');",
    ],
    ['smoke', 'no second try of its own', 'test.describe.configure({ retries: 2 }); expect(a).toBe(1);'],
  ])('%s: %s', (layer, rule, line) => {
    expect(rules(layer, test(line))).toEqual([rule]);
  });

  it('a test that is left out by hand, with its line', () => {
    const source = `// not test.only('a')\n\ntest.skip('drives', () => {\n  expect(1).toBe(1);\n});\n`;
    expect(violationsOf('stack', source)).toEqual([
      { rule: 'no test is left out by hand', line: 3, text: "test.skip('drives', () => {" },
    ]);
  });
});

describe('no rule finds what is allowed', () => {
  it.each<[string, TestLayer, string]>([
    ['what a machine lacks', 'smoke', test('test.skip(!hasVideo, NEEDS_VIDEO);', 'expect(a).toBe(1);')],
    [
      'stepped frames',
      'deterministic',
      test('await stage.run(999);', "expect(await stage.sent('estop')).toEqual([]);"),
    ],
    ['a comment', 'deterministic', test('// not Date.now(), and no LocalStack', 'expect(a).toBe(1);')],
    [
      'an action that an expectation follows',
      'deterministic',
      test("await page.click('#a');", 'expect(a).toBe(1);'),
    ],
    [
      'trying whether something can be pressed',
      'deterministic',
      test("await page.locator('#estop').click({ trial: true });"),
    ],
    ['waiting until something is so', 'stack', test(`while (!is()) ${SLEEP}`)],
    [
      'the order of two instants',
      'stack',
      test('expect(first.capturedAtMs).toBeLessThan(second.capturedAtMs);'),
    ],
    ['a bound that is longer than a test', 'stack', test('expect(ageMs).toBeLessThan(60_000);')],
    ['a lower bound of a time', 'stack', test('expect(tookMs).toBeGreaterThan(100);')],
    [
      'whatever port is free',
      'stack',
      test("run(['--port', '0']).listen({ port: 0 });", 'expect(a).toBe(1);'),
    ],
    [
      'a port that nobody listens at',
      'stack',
      test("await connect('ws://localhost:3000', { address: '::1', port: 500 });", 'expect(a).toBe(1);'),
    ],
    ['few frames', 'smoke', test('await operator.expectFrames(5);')],
    [
      'a picture for people',
      'smoke',
      test('if (PICTURES) await page.screenshot({ path });', 'expect(a).toBe(1);'),
    ],
    [
      'an expectation in a helper',
      'stack',
      `function stops() {\n  expect(a).toBe(1);\n}\n${test('stops();')}`,
    ],
    [
      'an expectation that tests share',
      'stack',
      `import { stopsBy } from './testing/stops.ts';\n${test("await stopsBy('gpio');")}`,
    ],
    [
      'a table of cases',
      'stack',
      "test.each([\n  ['a', 1],\n  ['b', 2],\n])(\n  '%s',\n  async (_, n) => {\n    expect(n).toBe(n);\n  },\n  30_000,\n);\n",
    ],
  ])('%s', (_, layer, source) => {
    expect(violationsOf(layer, source)).toEqual([]);
  });
});
