/**
 * Keeps tests from depending on what nobody controls: real time, the load of the machine, fixed ports. What breaks a rule
 * today is an exception; there may be fewer of them, and no new ones.
 */
import { expect, test } from 'vitest';
import { layerOf, violationsOf } from './lib/test-rules.ts';
import { workspaceFiles as files, readWorkspaceFile as read } from './lib/workspace-files.ts';

const SLEEP = 'no sleep';
const PORT = 'no port number';
const BOUND = 'no upper bound of a time';
/** A socket brings a message when the browser does. */
const POLLING = 'no polling';
const NOTHING = 'a test expects something';

/** Rules that these files break. Delete an entry as soon as its file keeps the rule. */
const EXCEPTIONS: Readonly<Record<string, readonly string[]>> = {
  'apps/bridge/src/bridge.stack.test.ts': [PORT],
  'apps/robot-node/src/broadcast/broadcast.stack.test.ts': [SLEEP],
  'apps/robot-node/src/broadcast/encrypted-broadcast.stack.test.ts': [SLEEP],
  'apps/robot-node/src/grants.stack.test.ts': [SLEEP],
  'apps/robot-node/src/reference/reference-profile.stack.test.ts': [NOTHING],
  'apps/robot-node/src/signaling/signaling-client.stack.test.ts': [SLEEP],
  'apps/robot-node/src/strangers.stack.test.ts': [SLEEP],
  'apps/robot-node/src/transport/offered-videos.stack.test.ts': [BOUND, SLEEP],
  'apps/robot-node/src/transport/operator-peer.stack.test.ts': [NOTHING],
  'apps/signaling/src/server.stack.test.ts': [PORT, NOTHING],
  'apps/signaling/src/strict-transport.stack.test.ts': [PORT],
  'e2e/pages/signaling.page.ts': [POLLING],
  'packages/conformance/src/main.stack.test.ts': [PORT],
  'packages/conformance/src/suites/suites.stack.test.ts': [NOTHING],
  'packages/dds/src/peers.stack.test.ts': [PORT],
  'packages/foxglove/src/live-listener.stack.test.ts': [PORT],
  'packages/link-emulator/src/udp-link.stack.test.ts': [PORT],
  'packages/shared-memory/src/producers.stack.test.ts': [NOTHING],
  'packages/sound/src/sound.stack.test.ts': [SLEEP],
  'packages/video/src/video-process.stack.test.ts': [BOUND],
  'packages/webrtc/src/werift/remote-candidates.stack.test.ts': [SLEEP],
};

const tests = files.flatMap((file) => {
  const layer = layerOf(file);
  return layer === null ? [] : [{ file, violations: violationsOf(layer, read(file)) }];
});

test('there are tests that have rules', () => {
  expect(tests.length).toBeGreaterThan(50);
});

test('there are at most 20 smoke tests: what takes ten seconds each, and real time', () => {
  const smoke = tests.filter(({ file }) => layerOf(file) === 'smoke').map(({ file }) => read(file));
  const count = smoke.reduce((sum, text) => sum + (text.match(/^ *test\(/gm)?.length ?? 0), 0);
  expect(count).toBeGreaterThan(10);
  expect(count).toBeLessThanOrEqual(20);
});

test('no test breaks a rule of its layer', () => {
  const broken = tests.flatMap(({ file, violations }) =>
    violations
      .filter(({ rule }) => !(EXCEPTIONS[file] ?? []).includes(rule))
      .map(({ rule, line, text }) => `${file}:${line}: ${rule}: ${text}`),
  );
  expect(broken).toEqual([]);
});

test('every exception is needed', () => {
  const needless = Object.entries(EXCEPTIONS).flatMap(([file, rules]) => {
    const broken = new Set(tests.find((each) => each.file === file)?.violations.map(({ rule }) => rule));
    return rules.filter((rule) => !broken.has(rule)).map((rule) => `${file}: ${rule}`);
  });
  expect(needless, 'delete these from EXCEPTIONS').toEqual([]);
});
