import { existsSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { LocalStack, repositoryRoot, type StackSpec } from '@farpoint/local-stack';
import { type Ros1Node, Ros1Peers } from '@farpoint/ros/testing/ros1';
import { test as base } from '@playwright/test';
import { OperatorPage } from './operator-page.ts';

/** The web app, built with `window.farpoint`. `pnpm build` makes it. */
export const webRoot = join(repositoryRoot, 'apps', 'webxr', 'dist-testing');

/** Recorded clouds that exist beside the repository on some machines. Tests that use them are skipped elsewhere. */
export const cloudsFolder = join(repositoryRoot, '..', 'shared', 'data', 'clouds');

export interface StackFixtures {
  /** Starts a stack of the real programs that lasts as long as the test. */
  startStack: (spec?: Partial<StackSpec>) => Promise<LocalStack>;
  /** Starts a stack with {@link simulatedRobot} and opens the page on it. Points are being drawn when it resolves. */
  openRobot: () => Promise<{ stack: LocalStack; operator: OperatorPage }>;
  /**
   * Starts a ROS 1 master, rospy nodes and a robot among them, and opens the page on it. Points are being drawn when
   * it resolves. The test is skipped without rospy.
   */
  openRos1Robot: (graph: Ros1Graph) => Promise<{ nodes: Ros1Node[]; operator: OperatorPage }>;
}

export interface Ros1Graph {
  /** Name of each node, and its parts of `ros1_node.py`, separated by commas. */
  nodes: readonly (readonly [name: string, parts: string])[];
  /** The robot's topics, besides `/points` and their `/camera_info`. */
  topics: readonly object[];
  /** Where velocities go; `source`: nowhere. */
  sink?: 'ros1' | 'source';
}

export const simulatedRobot = {
  id: 'sim-1',
  name: 'Simulated robot 1',
  args: ['--source', 'sim', '--sim-seed', '1', '--mode', 'points64', '--max-points', '15000'],
};

/** Its clouds are few and small: they leave the processor to videos or sound. */
export const lightRobot = {
  ...simulatedRobot,
  args: [...simulatedRobot.args.slice(0, -1), '600', '--sim-size', '64', '--fps', '10'],
};

/** Two robots, light enough to stream one after the other. */
export const twoRobots = [1, 2].map((n) => ({
  id: `sim-${n}`,
  name: `Simulated robot ${n}`,
  args: [
    '--source',
    'sim',
    '--sim-seed',
    String(n),
    '--mode',
    'points64',
    '--max-points',
    '6000',
    '--fps',
    '15',
  ],
}));

export const test = base.extend<StackFixtures>({
  startStack: async ({ browserName: _ }, use, testInfo) => {
    if (!existsSync(join(webRoot, 'index.html')))
      throw new Error('the web app is not built: run `pnpm build`');
    const stacks: LocalStack[] = [];
    const log = testInfo.outputPath('programs.log');
    const lines: string[] = [];
    await use(async (spec = {}) => {
      const stack = await LocalStack.start({
        webRoot,
        robots: [simulatedRobot],
        onLine: (name, line) => lines.push(`${name} ${line}`),
        ...spec,
      });
      stacks.push(stack);
      return stack;
    });
    // Before the programs are stopped: what they say of that explains no failure.
    if (testInfo.status !== testInfo.expectedStatus) {
      writeFileSync(log, `${lines.join('\n')}\n`);
      testInfo.attachments.push({ name: 'programs.log', path: log, contentType: 'text/plain' });
    }
    for (const stack of stacks) await stack.stop();
  },
  openRobot: async ({ page, startStack }, use) => {
    await use(async () => {
      const stack = await startStack();
      const operator = await OperatorPage.open(page, stack, { robot: simulatedRobot.id });
      await operator.expectPoints();
      return { stack, operator };
    });
  },
  openRos1Robot: async ({ page, startStack }, use, testInfo) => {
    const { python, missing } = Ros1Peers.find();
    let peers: Ros1Peers | null = null;
    await use(async ({ nodes, topics, sink = 'source' }) => {
      testInfo.skip(python === null, missing ?? '');
      peers = await Ros1Peers.open(python ?? '');
      await peers.startCore();
      const started: Ros1Node[] = [];
      for (const [name, parts] of nodes) started.push(await peers.startNode(parts, name));
      const clouds = [
        { topic: '/points', as: 'cloud' },
        { topic: '/camera_info', as: 'cameraInfo' },
      ];
      const robot = {
        ...{ source: { kind: 'ros1' }, sink: { kind: sink }, topics: [...clouds, ...topics] },
        ros: { master: peers.masterUrl, hostname: '127.0.0.1' },
      };
      const config = testInfo.outputPath('farpoint.yaml');
      // JSON is valid YAML.
      writeFileSync(config, JSON.stringify({ robot }));
      const stack = await startStack({
        robots: [{ id: 'ros-1', name: 'Robot in a ROS graph', args: ['--config', config] }],
      });
      const operator = await OperatorPage.open(page, stack, { robot: 'ros-1' });
      await operator.expectPoints(5000);
      return { nodes: started, operator };
    });
    await (peers as Ros1Peers | null)?.close();
  },
});

export { expect } from './expect.ts';
