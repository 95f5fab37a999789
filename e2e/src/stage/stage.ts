/** The page in a browser, with a scripted robot, a clock that only the test moves on, and display frames one by one. */
import type { CloudOptions, PictureFile, PictureOptions, StageControl } from '@farpoint/webxr/stage-control';
import type { StageStateName } from '@farpoint/webxr/stage-states';
import type { DrawnProbe, PageState, PageStats } from '@farpoint/webxr/test-api';
import { type CDPSession, expect, type Page } from '@playwright/test';
import { keep, type Stored } from '../stored.ts';

/** One display frame of a usual screen, ms. */
export const FRAME_MS = 16;
/** One where frames are not what is tested: of a computer without a GPU. Drawing is most of what such a test takes. */
const RARE_FRAME_MS = 48;
/** Until the session is there and the state has come about, ms. */
const BEGIN_MS = 600;
/** When the page is opened. Nothing depends on the date. */
export const OPENED_AT = Date.UTC(2026, 0, 1);

export interface StageOptions {
  /** How it begins: a name of stage-states.ts. Default: connected to a robot, and nobody drives. */
  state?: StageStateName;
  /** Size of the canvas, `WIDTHxHEIGHT`; `full`: that of the window. */
  canvas?: string;
  /** Further parameters of the page's address. */
  query?: Readonly<Record<string, string>>;
  /** What the browser keeps of an earlier visit, by its key. */
  stored?: Stored;
  /** The address's fragment, with `#`. */
  hash?: string;
  /** How long to wait, ms. */
  forMs?: number;
  /** From one display frame to the next, ms; counts from the page's first opening on. */
  frameMs?: number;
}

export interface Rect {
  x: number;
  y: number;
  width: number;
  height: number;
}
/** What a page sends to a robot. */
export type Sent = ReturnType<StageControl['sent']>[number];
export type Rgb = readonly [red: number, green: number, blue: number];

export class Stage {
  readonly page: Page;
  readonly #origin: string;
  #devtools: Promise<CDPSession> | null = null;
  #frameMs: number = RARE_FRAME_MS;

  constructor(page: Page, origin: string) {
    this.page = page;
    this.#origin = origin;
  }

  /** Opens the page in a state. Call it once, or again to load the page anew: what the browser stores is kept. */
  async open(options: StageOptions = {}): Promise<Page> {
    const { page } = this;
    const {
      state = 'live',
      canvas = '320x180',
      query = {},
      stored = {},
      hash = '',
      forMs = BEGIN_MS,
      frameMs = RARE_FRAME_MS,
    } = options;
    await this.#prepare(frameMs);
    await keep(page, stored);
    const url = new URL(this.#origin);
    url.searchParams.set('stage', state);
    if (canvas !== 'full') url.searchParams.set('canvas', canvas);
    // Each picture is waited for: a frame that has been stepped has been drawn.
    for (const [name, value] of Object.entries({ measure: '1', ...query })) url.searchParams.set(name, value);
    url.hash = hash;
    await page.goto(url.href);
    await this.#begun(forMs);
    return page;
  }

  /** Opens the page with a link of its own; the test answers its sockets by `page.routeWebSocket`. @param path of the page */
  async openOwn(query: Readonly<Record<string, string>> = {}, path = '/'): Promise<Page> {
    await this.#prepare(RARE_FRAME_MS);
    const url = new URL(path, this.#origin);
    for (const [name, value] of Object.entries({ canvas: '64x36', ...query }))
      url.searchParams.set(name, value);
    await this.page.goto(url.href);
    // Until the page's scripts have run.
    await expect(this.page.locator('#link:not([hidden])').filter({ hasText: /^(Starting…)?$/ })).toHaveCount(
      0,
    );
    return this.page;
  }

  /** Opens the page with several robots; what it has in its address goes to the page of each. */
  async openWall(query: Readonly<Record<string, string>>): Promise<Page> {
    await this.#prepare(RARE_FRAME_MS);
    const url = new URL('/wall.html', this.#origin);
    for (const [name, value] of Object.entries(query)) url.searchParams.set(name, value);
    await this.page.goto(url.href);
    // They are there once the wall has its texts.
    await this.page.locator('iframe').first().waitFor({ state: 'attached' });
    for (const frame of this.page.frames())
      if (frame !== this.page.mainFrame()) await frame.evaluate(() => window.stageOpened);
    await this.run(BEGIN_MS + 500);
    return this.page;
  }

  async #prepare(frameMs: number): Promise<void> {
    const { page } = this;
    if (page.url() !== 'about:blank') return;
    await page.clock.install({ time: OPENED_AT });
    await page.clock.pauseAt(OPENED_AT + 1000);
    this.#frameMs = frameMs;
    await page.addInitScript(prepare, frameMs);
  }

  /** Loads the page anew, as a person does. */
  async reload(forMs = BEGIN_MS): Promise<void> {
    await this.page.reload();
    await this.#begun(forMs);
  }

  async #begun(forMs: number): Promise<void> {
    await this.page.evaluate(() => window.stageOpened);
    await this.run(forMs);
  }

  /** Lets this much time pass, ms. */
  async run(ms: number): Promise<void> {
    await this.page.clock.runFor(ms);
  }

  /** Draws so many display frames. */
  async frames(count: number): Promise<void> {
    await this.run(count * this.#frameMs);
  }

  /** Stops the display's frames, as a hung compositor does; timers and events go on. The next frame is the last one. */
  async freeze(): Promise<void> {
    await this.page.evaluate(() => {
      const request = window.requestAnimationFrame;
      const held: FrameRequestCallback[] = [];
      window.requestAnimationFrame = (callback) => held.push(callback);
      window.thawFrames = () => {
        window.requestAnimationFrame = request;
        for (const callback of held) request.call(window, callback);
      };
    });
    await this.frames(1);
  }

  /** Lets the frames go on. */
  async thaw(): Promise<void> {
    await this.page.evaluate(() => window.thawFrames?.());
  }

  /** Whether fingers, and no mouse, touch the screen from now on. */
  async touched(enabled: boolean): Promise<void> {
    this.#devtools ??= this.page.context().newCDPSession(this.page);
    await (await this.#devtools).send('Emulation.setTouchEmulationEnabled', { enabled });
  }

  /** What fingers do on the screen. @param fingers those that are down, pixels of the page; none: the last one is let go */
  async fingers(
    type: 'touchStart' | 'touchMove' | 'touchEnd',
    ...fingers: { x: number; y: number }[]
  ): Promise<void> {
    this.#devtools ??= this.page.context().newCDPSession(this.page);
    const touchPoints = fingers.map(({ x, y }, id) => ({ x, y, id }));
    await (await this.#devtools).send('Input.dispatchTouchEvent', { type, touchPoints });
  }

  /** Changes the size of the window, and lets the page find its new layout. */
  async resize(width: number, height: number): Promise<void> {
    await this.page.setViewportSize({ width, height });
    for (let rounds = 0; rounds < 2; rounds++) {
      // An observer is told of its first size after the page's own observers have seen theirs.
      await this.page.evaluate(
        () => new Promise<void>((resolve) => new ResizeObserver(() => resolve()).observe(document.body)),
      );
      await this.run(250);
    }
  }

  /** Does something with the scripted robot, in the page. */
  script<Result>(act: (stage: StageControl) => Result): Promise<Result>;
  script<Result, Argument>(
    act: (stage: StageControl, argument: Argument) => Result,
    argument: Argument,
  ): Promise<Result>;
  script<Result, Argument>(
    act: (stage: StageControl, argument: Argument) => Result,
    argument?: Argument,
  ): Promise<Result> {
    return this.page.evaluate(
      ([text, argument]) => {
        const run = new Function(`return (${text})`)() as (stage: StageControl, argument: unknown) => Result;
        return run(window.farpointStage, argument);
      },
      [act.toString(), argument] as const,
    ) as Promise<Result>;
  }

  /** The robot sends these. */
  tell(...messages: Parameters<StageControl['tell']>): Promise<void> {
    return this.page.evaluate((all) => window.farpointStage.tell(...all), messages);
  }

  /** What the page has sent of this type, since it was last forgotten. */
  async sent<Type extends Sent['type']>(type: Type): Promise<Extract<Sent, { type: Type }>[]> {
    const all: Sent[] = await this.page.evaluate((type) => window.farpointStage.sent(type), type);
    return all as Extract<Sent, { type: Type }>[];
  }

  /** What the page has sent so far is not in {@link sent} any more. */
  async forget(): Promise<void> {
    await this.page.evaluate(() => window.farpointStage.forget());
  }

  /** A frame of a loaded cloud comes. @returns how many packets it has */
  cloud(name: string, options: CloudOptions = {}): Promise<number> {
    return this.page.evaluate(([name, options]) => window.farpointStage.cloud(name, options), [
      name,
      options,
    ] as const);
  }

  /** A picture of a video comes. @returns whether the page takes it */
  video(name: string, picture: PictureOptions = {}): Promise<boolean> {
    return this.page.evaluate(([name, picture]) => window.farpointStage.video(name, picture), [
      name,
      picture,
    ] as const);
  }

  /** A picture of a camera comes, and is decoded. @param ageMs how long before now it was taken */
  async picture(camera: number, file: PictureFile, ageMs = 0): Promise<void> {
    await this.page.evaluate(([camera, file, ageMs]) => window.farpointStage.picture(camera, file, ageMs), [
      camera,
      file,
      ageMs,
    ] as const);
  }

  /** Loads clouds that {@link cloud} can send then. */
  async load(...names: string[]): Promise<void> {
    await this.page.evaluate(async (names) => {
      for (const name of names) await window.farpointStage.load(name);
    }, names);
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

  /** Draws a frame, and reads a part of it: shares of the canvas, from the top left. @returns its pixels, row by row */
  async pixels(rect: Rect = { x: 0, y: 0, width: 1, height: 1 }): Promise<Rgb[]> {
    await this.page.evaluate(() => window.farpointStage.photograph());
    for (let tries = 0; !(await this.page.evaluate(() => window.farpointStage.hasPicture)); tries++) {
      if (tries === 20) throw new Error('the page has drawn nothing in 20 display frames');
      await this.frames(1);
    }
    const bytes = Buffer.from(
      await this.page.evaluate((rect) => window.farpointStage.pixels(rect), rect),
      'base64',
    );
    return Array.from({ length: bytes.length / 3 }, (_, i): Rgb => {
      const [red = 0, green = 0, blue = 0] = bytes.subarray(3 * i, 3 * i + 3);
      return [red, green, blue];
    });
  }

  /** The mean colour of a part. */
  async mean(rect?: Rect): Promise<Rgb> {
    const pixels = await this.pixels(rect);
    const sum = (channel: 0 | 1 | 2) => pixels.reduce((all, pixel) => all + pixel[channel], 0);
    return [sum(0) / pixels.length, sum(1) / pixels.length, sum(2) / pixels.length];
  }

  /** Share of a part's pixels that differ by at most `tolerance` from a colour in each channel, 0–1. */
  async share(colour: Rgb, rect?: Rect, tolerance = 12): Promise<number> {
    const pixels = await this.pixels(rect);
    const near = pixels.filter((pixel) =>
      pixel.every((level, i) => Math.abs(level - (colour[i] ?? 0)) <= tolerance),
    );
    return near.length / pixels.length;
  }
}

declare global {
  interface Window {
    /** Resolves once the page has a scripted robot and has started. */
    stageOpened: Promise<void>;
    thawFrames?: () => void;
  }
}

/** Runs in each page before its own scripts. @param frameMs from one display frame to the next */
function prepare(frameMs: number): void {
  // The test's clock draws every 16 ms.
  window.requestAnimationFrame = (callback) => {
    const nowMs = performance.now();
    return window.setTimeout(() => callback(performance.now()), frameMs - (nowMs % frameMs));
  };
  window.cancelAnimationFrame = (handle) => window.clearTimeout(handle);
  window.stageOpened = new Promise((resolve) => {
    window.farpointStageOpened = resolve;
  });
  // Events have the time of the test's clock, too.
  Object.defineProperty(Event.prototype, 'timeStamp', { get: () => performance.now() });
  const still = new CSSStyleSheet();
  still.replaceSync('*, *::before, *::after { animation: none !important; transition: none !important; }');
  document.adoptedStyleSheets = [still];
}
