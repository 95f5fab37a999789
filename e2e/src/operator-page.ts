import type { LocalStack } from '@farpoint/local-stack';
import type { DrawnProbe, PageState, PageStats } from '@farpoint/webxr/test-api';
import type { Page, TestInfo } from '@playwright/test';
import { expect } from './expect.ts';
import { savesPictures, screenSizes, shownOrLate } from './screens.ts';

export interface OpenOptions {
  robot?: string;
  token?: string;
  /** Where the page finds signaling; default: where it was loaded from. */
  signaling?: string;
  /** `relay`: through TURN servers only. */
  ice?: 'relay';
  /**
   * Fixed size of the canvas, `WIDTHxHEIGHT`; by default a small one, which leaves more processor time for the rest.
   * `full`: as large as the window gives it, for tests whose subject is the picture.
   */
  canvas?: string;
  /** `1`: each picture is waited for, so that its time is known. */
  measure?: '1';
  /** Refuse coded clouds. */
  mode?: 'points64';
  /** Draw only every n-th point of coded clouds. */
  every?: string;
  /** `1`: draw clouds of depth cameras as surfaces, which a software renderer does not by default. */
  surface?: '0' | '1';
  /** `0`: surfaces have the packets' colours, not those of their camera's video. */
  paint?: '0';
  /** `1`: remember what was seen, which a page with a software renderer does not by default. */
  memory?: '0' | '1';
  /** Take the stream from this bridge. */
  bridge?: string;
  /** `1`: videos carry their capture time in the picture. */
  barcode?: '1';
  /** `0`: videos are shown as they come, not in step. */
  sync?: '0';
  cues?: '0';
  /** `0`: the view is not led by commands. */
  predict?: '0';
  /** How videos are received; by default what suits the browser best. */
  video?: 'track' | 'native' | 'webcodecs';
}

/** What both Playwright's pages and Puppeteer's in Firefox support. */
export interface BrowserPage {
  goto(url: string): Promise<unknown>;
  waitForFunction(holds: () => boolean): Promise<unknown>;
  evaluate<T>(work: () => T | Promise<T>): Promise<T>;
  screenshot(options: { path: string }): Promise<Uint8Array>;
  readonly keyboard: BrowserKeyboard;
}

/** Names keys by the text they produce, which is the only way that both support. */
interface BrowserKeyboard {
  down(key: Key): Promise<void>;
  up(key: Key): Promise<void>;
}

const SMALL_CANVAS = '320x180';

const DEAD_MAN = ' ';
const FORWARD = 'w';
const RELEASE_ESTOP = 'r';
type Key = typeof DEAD_MAN | typeof FORWARD | typeof RELEASE_ESTOP;

/** Run in the page. A hand grips before it pushes: after a stop, a robot does not move for one that does both at once. */
const SCRIPTED = {
  forward: async () => {
    window.farpoint.hold({ forward: 0, left: 0 });
    await new Promise((resolve) => setTimeout(resolve, 100));
    window.farpoint.hold({ forward: 1, left: 0 });
  },
  back: async () => {
    window.farpoint.hold({ forward: 0, left: 0 });
    await new Promise((resolve) => setTimeout(resolve, 100));
    window.farpoint.hold({ forward: -1, left: 0 });
  },
};
type ScriptedWay = keyof typeof SCRIPTED;

/** A dead-man grip in a test's hand. */
export interface Grip {
  hold(): Promise<void>;
  release(): Promise<void>;
}

/** The operator's page as a test uses it: real keys and buttons, and `window.farpoint` to inspect it. */
export class OperatorPage {
  readonly page: BrowserPage;
  #grip: Grip | null = null;

  private constructor(page: BrowserPage) {
    this.page = page;
  }

  static async open(page: BrowserPage, stack: LocalStack, options: OpenOptions = {}): Promise<OperatorPage> {
    const url = new URL(stack.webUrl);
    if (options.robot !== undefined) url.searchParams.set('robot', options.robot);
    const { canvas = SMALL_CANVAS } = options;
    if (canvas !== 'full') url.searchParams.set('canvas', canvas);
    for (const name of [
      'token',
      'signaling',
      'ice',
      'bridge',
      'measure',
      'mode',
      'every',
      'surface',
      'memory',
      'paint',
      'barcode',
      'sync',
      'cues',
      'predict',
      'video',
    ] as const) {
      const value = options[name];
      if (value !== undefined) url.searchParams.set(name, value);
    }
    await page.goto(url.href);
    await page.waitForFunction(() => window.farpoint !== undefined);
    return new OperatorPage(page);
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

  /** Waits until a part of the page's state has this value. */
  async expectState<Key extends keyof PageState>(key: Key, value: PageState[Key]): Promise<void> {
    await expect.poll(async () => (await this.state())[key], { message: `state.${key}` }).toEqual(value);
  }

  /** Waits until the robot's points are drawn, and more keep arriving. */
  async expectPoints(least = 1000): Promise<void> {
    // A page that was loaded again has it a moment later.
    await this.page.waitForFunction(() => window.farpoint !== undefined);
    await this.expectState('session', 'live');
    await expect
      .poll(async () => (await this.probe()).points, { message: 'points drawn' })
      .toBeGreaterThan(least);
    await this.expectFrames(5);
  }

  /** Waits until more than this many further frames of the robot have been drawn. */
  async expectFrames(more: number): Promise<void> {
    const { framesDrawn } = await this.stats();
    await expect
      .poll(async () => (await this.stats()).framesDrawn, { message: 'frames drawn' })
      .toBeGreaterThan(framesDrawn + more);
  }

  /** Pose of base_link in the world. The robot's telemetry must have arrived. */
  async body(): Promise<{ x: number; y: number; yaw: number }> {
    const { body } = await this.state();
    if (body === null) throw new Error('no telemetry of the robot yet');
    return body;
  }

  /**
   * Waits until the robot has moved at least this far from a position, metres.
   *
   * @param driver whose keys or grip are held
   */
  async expectMovedFrom(from: { x: number; y: number }, least: number, driver: OperatorPage = this) {
    await expect
      .poll(
        async () => {
          await driver.gripAnew(this);
          const { x, y } = await this.body();
          return Math.hypot(x - from.x, y - from.y);
        },
        { message: 'metres driven', intervals: [100] },
      )
      .toBeGreaterThan(least);
  }

  /** Waits until the robot measures that it stands still. */
  async expectStanding(): Promise<void> {
    await expect
      .poll(
        async () => {
          const { velocity } = await this.state();
          return velocity === null ? Number.NaN : Math.abs(velocity.linear) + Math.abs(velocity.angular);
        },
        { message: 'speed' },
      )
      .toBe(0);
  }

  /** Drives forward until {@link release}, by the page's script input. The first grip requests the lease. */
  holdForward(): Promise<void> {
    return this.hold(this.scriptGrip('forward'));
  }

  /** A grip of the page's script input. No device has to be read in time, which a page that draws in software is not. */
  scriptGrip(way: ScriptedWay): Grip {
    return {
      hold: () => this.page.evaluate(SCRIPTED[way]),
      release: () => this.page.evaluate(() => window.farpoint.hold(null)),
    };
  }

  /** As {@link holdForward}, by the dead-man key and W: for tests whose subject is the keyboard. */
  async holdForwardKeys(): Promise<void> {
    const { keyboard } = this.page;
    await this.hold({
      async hold() {
        await keyboard.down(DEAD_MAN);
        await keyboard.down(FORWARD);
      },
      async release() {
        await keyboard.up(FORWARD);
        await keyboard.up(DEAD_MAN);
      },
    });
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

  /**
   * On a busy machine the page may pause for longer than a grip or the robot's watchdog allows, even for an instant. The
   * robot then stops until the operator lets go and grips again, so that is what this does, as an operator would.
   *
   * @param watcher a page that hears the robot's state; through a bridge, another one
   */
  async gripAnew(watcher: OperatorPage = this): Promise<void> {
    const grip = this.#grip;
    if (grip === null) return;
    const { drive } = await watcher.state();
    const { gripLost } = await this.state();
    if (drive !== 'watchdog' && gripLost === null) return;
    await this.release();
    await watcher.expectState('drive', 'idle');
    await this.expectState('gripLost', null);
    await this.hold(grip);
  }

  /** Holds the key that releases the emergency stop until the robot has released it. */
  async releaseEstop(): Promise<void> {
    await this.page.keyboard.down(RELEASE_ESTOP);
    await this.expectState('estop', false);
    await this.page.keyboard.up(RELEASE_ESTOP);
  }

  /** Saves pictures for people of the page as a phone, a laptop and a large screen show it, if they want any. */
  async screenshots(page: Page, testInfo: TestInfo, name: string): Promise<void> {
    if (!savesPictures) return;
    const before = page.viewportSize();
    for (const size of screenSizes) {
      await page.setViewportSize(size);
      await this.screenshot(testInfo, `${name}-${size.width}`);
    }
    if (before !== null) await page.setViewportSize(before);
  }

  /** Saves a picture for people, if they want any; otherwise waits until what it would show is drawn. */
  async screenshot(testInfo: TestInfo, name: string): Promise<void> {
    if (savesPictures) await this.picture(testInfo, name);
    else await this.page.evaluate(shownOrLate);
  }

  /** Takes a picture for the test, and saves it with its output. */
  async picture(testInfo: TestInfo, name: string): Promise<Buffer> {
    return Buffer.from(await this.page.screenshot({ path: testInfo.outputPath(`${name}.png`) }));
  }
}
