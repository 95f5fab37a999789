import type { DrawnProbe, PageState, PageStats } from '@farpoint/webxr/test-api';
import type { TestInfo } from '@playwright/test';
import { expect } from './expect.ts';
import { savesPictures } from './screens.ts';

export interface OpenOptions {
  robot?: string;
  /** `relay`: through TURN servers only. */
  ice?: 'relay';
  /** Fixed size of the canvas, `WIDTHxHEIGHT`; by default a small one, which leaves more processor time for the rest. */
  canvas?: string;
  /** Draw only every n-th point of coded clouds. */
  every?: string;
  /** Take the stream from this bridge. */
  bridge?: string;
  /** `1`: videos carry their capture time in the picture. */
  barcode?: '1';
  /** How videos are received; by default what suits the browser best. */
  video?: 'track' | 'native' | 'webcodecs';
}

/** What both Playwright's pages and Puppeteer's in Firefox support. */
export interface BrowserPage {
  goto(url: string): Promise<unknown>;
  waitForFunction(holds: () => boolean): Promise<unknown>;
  evaluate<Result, Argument>(
    work: (argument: Argument) => Result | Promise<Result>,
    argument: Argument,
  ): Promise<Result>;
  evaluate<Result>(work: () => Result | Promise<Result>): Promise<Result>;
  screenshot(options: { path: string }): Promise<Uint8Array>;
  readonly keyboard: BrowserKeyboard;
}

/** Names keys by the text they produce, which is the only way that both support. */
interface BrowserKeyboard {
  down(key: Key): Promise<void>;
  up(key: Key): Promise<void>;
}

const SMALL_CANVAS = '320x180';
/** How long one short push lasts. The robot stands after it. */
const PUSH_MS = 400;

const DEAD_MAN = ' ';
const FORWARD = 'w';
const RELEASE_ESTOP = 'r';
type Key = typeof DEAD_MAN | typeof FORWARD | typeof RELEASE_ESTOP;

/** Somebody who hears where the robot is: the driver's own page, or another operator. */
export interface Watcher {
  /** base_link in the world, metres and radians; `null` before its telemetry has arrived. */
  pose(): Promise<{ x: number; y: number; yaw: number } | null>;
  /** Whether the robot measures that it stands still; `null` before it has said so. */
  stands(): Promise<boolean | null>;
}

/** A dead-man grip in a test's hand. */
export interface Grip {
  hold(): Promise<void>;
  release(): Promise<void>;
}

/** The operator's page as a test uses it: real keys and buttons, and `window.farpoint` to inspect it. */
export class OperatorPage implements Watcher {
  readonly page: BrowserPage;
  #grip: Grip | null = null;

  private constructor(page: BrowserPage) {
    this.page = page;
  }

  /** @param webUrl where the service serves the page */
  static async open(page: BrowserPage, webUrl: string, options: OpenOptions = {}): Promise<OperatorPage> {
    const url = new URL(webUrl);
    for (const [name, value] of Object.entries({ canvas: SMALL_CANVAS, ...options }))
      if (value !== undefined) url.searchParams.set(name, value);
    await page.goto(url.href);
    const operator = new OperatorPage(page);
    await operator.loaded();
    return operator;
  }

  /** Waits until the page can be asked; also after it was loaded again. */
  async loaded(): Promise<void> {
    await this.page.waitForFunction(() => window.farpoint !== undefined);
  }

  state(): Promise<PageState> {
    return this.page.evaluate(() => window.farpoint.state());
  }

  stats(): Promise<PageStats> {
    return this.page.evaluate(() => window.farpoint.stats());
  }

  probe(): Promise<DrawnProbe> {
    return this.page.evaluate(() => window.farpoint.probe());
  }

  async pose() {
    return (await this.state()).body;
  }

  async stands() {
    const { velocity } = await this.state();
    return velocity === null ? null : velocity.linear === 0 && velocity.angular === 0;
  }

  /** Waits until a part of the page's state has this value. */
  async expectState<Key extends keyof PageState>(key: Key, value: PageState[Key]): Promise<void> {
    await expect.poll(async () => (await this.state())[key], { message: `state.${key}` }).toEqual(value);
  }

  /** Waits until the robot's points are drawn, and more keep arriving. */
  async expectPoints(least = 100): Promise<void> {
    await this.expectState('session', 'live');
    await expect
      .poll(async () => (await this.probe()).points, { message: 'points drawn' })
      .toBeGreaterThan(least);
    await this.expectFrames(3);
  }

  /** Waits until more than this many further frames of the robot have been drawn. */
  async expectFrames(more: number): Promise<void> {
    const { framesDrawn } = await this.stats();
    await expect
      .poll(async () => (await this.stats()).framesDrawn, { message: 'frames drawn' })
      .toBeGreaterThan(framesDrawn + more);
  }

  /** Drives by short pushes of the page's script input until the robot has moved at least this far, metres. */
  async drives(least: number, { ahead = 1, watcher = this as Watcher } = {}): Promise<void> {
    const from = await poseOf(watcher);
    await expectMoved(watcher, from, least, () =>
      this.page.evaluate(([ahead, ms]) => window.farpoint.drive({ forward: ahead, left: 0 }, ms), [
        ahead,
        PUSH_MS,
      ] as const),
    );
    await expectStanding(watcher);
  }

  /** A short push does not move the robot, which stands. */
  async cannotDrive(watcher: Watcher = this): Promise<void> {
    await expectStanding(watcher);
    const stood = await poseOf(watcher);
    await this.page.evaluate((ms) => window.farpoint.drive({ forward: 1, left: 0 }, ms), 2 * PUSH_MS);
    expect(await poseOf(watcher)).toEqual(stood);
  }

  /** The keys with which a person drives ahead. */
  get keys(): Grip {
    const { keyboard } = this.page;
    return {
      async hold() {
        await keyboard.down(DEAD_MAN);
        await keyboard.down(FORWARD);
      },
      async release() {
        await keyboard.up(FORWARD);
        await keyboard.up(DEAD_MAN);
      },
    };
  }

  /** The page's script input, pushed ahead. A hand grips before it pushes. */
  get script(): Grip {
    return {
      hold: () =>
        this.page.evaluate(async () => {
          window.farpoint.hold({ forward: 0, left: 0 });
          await new Promise(requestAnimationFrame);
          window.farpoint.hold({ forward: 1, left: 0 });
        }),
      release: () => this.page.evaluate(() => window.farpoint.hold(null)),
    };
  }

  /** Holds this grip until {@link release}. */
  async hold(grip: Grip): Promise<void> {
    this.#grip = grip;
    await grip.hold();
  }

  async release(): Promise<void> {
    const grip = this.#grip;
    this.#grip = null;
    await grip?.release();
  }

  /** Waits until what is held has moved the robot at least this far, metres. */
  async expectMovedFrom(
    from: { x: number; y: number },
    least: number,
    watcher: Watcher = this,
  ): Promise<void> {
    await expectMoved(watcher, from, least, () => this.gripAnew());
  }

  /**
   * On a busy machine the page may pause for longer than a grip or the robot's watchdog allows, even for an instant. The
   * robot then stops until the operator lets go and grips again, so that is what this does, as an operator would.
   */
  async gripAnew(): Promise<void> {
    const grip = this.#grip;
    if (grip === null) return;
    const { drive, gripLost } = await this.state();
    if (drive !== 'watchdog' && gripLost === null) return;
    await this.release();
    await this.expectState('gripLost', null);
    await expect.poll(async () => (await this.state()).drive).not.toBe('watchdog');
    await this.hold(grip);
  }

  /** Holds the key that releases the emergency stop until the robot has released it. */
  async releaseEstop(): Promise<void> {
    await this.page.keyboard.down(RELEASE_ESTOP);
    await this.expectState('estop', false);
    await this.page.keyboard.up(RELEASE_ESTOP);
  }

  /** Saves a picture for people, if they want any. */
  async picture(testInfo: TestInfo, name: string): Promise<void> {
    if (savesPictures) await this.page.screenshot({ path: testInfo.outputPath(`${name}.png`) });
  }
}

/** Waits for the robot's first telemetry. */
export async function poseOf(watcher: Watcher): Promise<{ x: number; y: number; yaw: number }> {
  await expect.poll(async () => (await watcher.pose()) !== null, { message: 'telemetry' }).toBe(true);
  return (await watcher.pose()) as { x: number; y: number; yaw: number };
}

/** Waits until the robot measures that it stands still. */
export async function expectStanding(watcher: Watcher): Promise<void> {
  await expect.poll(() => watcher.stands(), { message: 'stands' }).toBe(true);
}

async function expectMoved(
  watcher: Watcher,
  from: { x: number; y: number },
  least: number,
  push: () => Promise<unknown>,
): Promise<void> {
  await expect
    .poll(
      async () => {
        await push();
        const { x, y } = await poseOf(watcher);
        return Math.hypot(x - from.x, y - from.y);
      },
      { message: 'metres driven' },
    )
    .toBeGreaterThan(least);
}
