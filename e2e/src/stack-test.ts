import { existsSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { LocalStack, repositoryRoot, type StackSpec } from '@farpoint/local-stack';
import { type Ros1Node, Ros1Peers } from '@farpoint/ros/testing/ros1';
import { test as base } from '@playwright/test';
import { OperatorPage } from './operator-page.ts';
import { DISPLAY_HZ, slowDisplay } from './slow-display.ts';

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

const simulatorArgs = ['--source', 'sim', '--sim-seed', '1', '--mode', 'points64'];

/** Two cores capture, code, decode and draw its clouds with time to spare. */
export const simulatedRobot = {
  id: 'sim-1',
  name: 'Simulated robot 1',
  args: [...simulatorArgs, '--max-points', '6000', '--sim-size', '160', '--fps', '10'],
};

/** Its clouds are few and small: they leave the processor to videos or sound. */
export const lightRobot = {
  ...simulatedRobot,
  args: [...simulatorArgs, '--max-points', '600', '--sim-size', '64', '--fps', '10'],
};

/** Two robots, light enough to stream one after the other. */
export const twoRobots = [1, 2].map((n) => ({
  id: `sim-${n}`,
  name: `Simulated robot ${n}`,
  args: [...simulatedRobot.args, '--sim-seed', String(n)],
}));

export const test = base.extend<StackFixtures>({
  context: async ({ context }, use) => {
    await context.addInitScript(slowDisplay, DISPLAY_HZ);
    await use(context);
  },
  startStack: async ({ browserName: _ }, use, testInfo) => {
    if (!existsSync(join(webRoot, 'index.html')))
      throw new Error('the web app is not built: run `pnpm build`');
    const stacks: LocalStack[] = [];
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
    for (const stack of stacks) await stack.stop();
    if (testInfo.status !== testInfo.expectedStatus) {
      await testInfo.attach('programs.log', { body: lines.join('\n'), contentType: 'text/plain' });
    }
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
export { LONG } from './long.ts';
