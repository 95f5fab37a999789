/** The whole stack as an operator has it: the real programs and the built page in a headless Chromium. */
import { spawnSync } from 'node:child_process';
import { join } from 'node:path';
import {
  chromiumLaunchOptions,
  EmulatedLink,
  type EmulatedLinkSpec,
  LocalStack,
  type RobotSpec,
  repositoryRoot,
} from '@farpoint/local-stack';
import type {} from '@farpoint/webxr/test-api';
import { type Browser, type BrowserServer, chromium, type Page } from '@playwright/test';

export interface LiveStackOptions {
  robot: RobotSpec;
  /**
   * Size of the page's canvas in pixels, or of its window if it has its own canvas. Small where only the stream is measured:
   * there is no GPU.
   */
  canvas: string;
  /** The page sizes its canvas itself, as it does for people. */
  ownCanvas?: boolean;
  /** Additional parameters of the page's address. */
  query?: string;
  /** What the page's browser keeps of an earlier visit, by its key. */
  stored?: Readonly<Record<string, Readonly<Record<string, unknown>>>>;
  /** A bad network between the robots and everything else. */
  link?: EmulatedLinkSpec;
  /** Capacity of the link until `reset`, Mbit/s; default: as its options say. */
  connectAtMbps?: number;
  /** Robots besides the one that is driven. */
  otherRobots?: RobotSpec[];
  log: (line: string) => void;
}

export interface LiveStack {
  stack: LocalStack;
  /** `null` if the options have no link. */
  link: EmulatedLink | null;
  page: Page;
  /** Opens another page, connected to another robot. */
  openPage(robotId: string): Promise<Page>;
  /** Process id of the browser. Its renderer, GPU and network processes are its children. */
  browserPid: number;
  close(): Promise<void>;
}

/** Builds the page, starts signaling, one robot and a browser, and connects them. */
export async function startLiveStack(options: LiveStackOptions): Promise<LiveStack> {
  const { log, robot } = options;
  log('building the page');
  buildPage();
  log('starting signaling and the robot');
  const stack = await LocalStack.start({
    webRoot: join(repositoryRoot, 'apps', 'webxr', 'dist-testing'),
    robots: [],
    env: { FARPOINT_LOG_LEVEL: 'warn' },
  });
  let link: EmulatedLink | null = null;
  let server: BrowserServer | null = null;
  const close = async (): Promise<void> => {
    await server?.close();
    await stack.stop();
    await link?.stop();
  };
  try {
    if (options.link !== undefined) link = await EmulatedLink.start(stack, options.link);
    if (options.connectAtMbps !== undefined)
      link?.tell({ type: 'set', direction: 'both', rateMbps: options.connectAtMbps });
    const through = link === null ? [] : ['--signaling', link.signalingUrl];
    for (const spec of [robot, ...(options.otherRobots ?? [])]) {
      await stack.startRobot({ ...spec, args: [...(spec.args ?? []), ...through] });
    }
    server = await chromium.launchServer(chromiumLaunchOptions());
    log('starting the browser');
    const browser: Browser = await chromium.connect(server.wsEndpoint());
    // No larger than the canvas, because the browser composes its window in software, too.
    const [width, height] = options.canvas.split('x').map(Number) as [number, number];
    const openPage = async (robotId: string): Promise<Page> => {
      const page = await browser.newPage({
        viewport: { width: Math.max(width, 320), height: Math.max(height, 180) },
      });
      await page.addInitScript((stored) => {
        for (const [key, value] of Object.entries(stored)) localStorage[key] = JSON.stringify(value);
      }, options.stored ?? {});
      const canvas = options.ownCanvas ? '' : `canvas=${options.canvas}&measure=1&`;
      await page.goto(`${stack.webUrl}?${canvas}${options.query ?? ''}`);
      await page.waitForFunction(() => window.farpoint !== undefined);
      await page.waitForFunction(
        (id) => window.farpoint.robots().some((listed) => listed.id === id),
        robotId,
      );
      await page.evaluate((id) => window.farpoint.connect(id, 20_000), robotId);
      await page.waitForFunction(() => window.farpoint.stats().framesDrawn > 5);
      return page;
    };
    const page = await openPage(robot.id);
    return { stack, link, page, openPage, browserPid: server.process().pid as number, close };
  } catch (error) {
    await close();
    throw error;
  }
}

/** @param mode of Vite: that of tests and benchmarks, or that of the deployed page */
export function buildPage(mode: 'testing' | 'production' = 'testing'): void {
  const vite = join(repositoryRoot, 'apps', 'webxr', 'node_modules', 'vite', 'bin', 'vite.js');
  const cwd = join(repositoryRoot, 'apps', 'webxr');
  const result = spawnSync(process.execPath, [vite, 'build', '--mode', mode, '--logLevel', 'error'], {
    cwd,
    encoding: 'utf8',
  });
  if (result.status !== 0) throw new Error(`the page does not build:\n${result.stdout}${result.stderr}`);
}
