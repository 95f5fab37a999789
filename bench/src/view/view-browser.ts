/** The benchmark's page (page/view-page.ts), bundled and opened in a headless Chromium. */
import { spawnSync } from 'node:child_process';
import { extname, join } from 'node:path';
import { chromiumLaunchOptions, processFolder, repositoryRoot } from '@farpoint/local-stack';
import type { Pose } from '@farpoint/protocol';
import { chromium, type Page } from '@playwright/test';
import type { ViewOptions } from './page/view-page.ts';
import type { Picture } from './picture-difference.ts';
import type { CodedPicture } from './picture-video.ts';

/** Answered from the bundle; nothing leaves this machine. Browsers decode videos only for such names, and by TLS. */
const ORIGIN = 'http://view.localhost';
const TYPES: Readonly<Record<string, string>> = {
  '.html': 'text/html',
  '.js': 'text/javascript',
  '.wasm': 'application/wasm',
};

export class ViewBrowser {
  readonly #page: Page;
  readonly #close: () => Promise<void>;

  private constructor(page: Page, close: () => Promise<void>) {
    this.#page = page;
    this.#close = close;
  }

  static async open(): Promise<ViewBrowser> {
    const folder = processFolder();
    bundle(folder);
    const browser = await chromium.launch(chromiumLaunchOptions());
    const page = await browser.newPage();
    await page.route(`${ORIGIN}/**`, (route) => {
      const path = new URL(route.request().url()).pathname;
      return route.fulfill({ path: join(folder, path), contentType: TYPES[extname(path)] ?? 'text/plain' });
    });
    page.on('pageerror', (error) => console.error(error.message));
    await page.goto(`${ORIGIN}/index.html`);
    await page.waitForFunction(() => window.view !== undefined);
    return new ViewBrowser(page, () => browser.close());
  }

  /** @param header of an organised stream; `null` for `points64` */
  async begin(header: Uint8Array | null, options: Omit<ViewOptions, 'header'>): Promise<void> {
    const all = { ...options, header: header === null ? null : base64(header) };
    await this.#page.evaluate((given) => window.view.begin(given), all);
  }

  /** Gives the page a frame's packets. Returns the time on the page's main thread, without decoding, ms. */
  feed(payloads: readonly ArrayBuffer[]): Promise<number> {
    const texts = payloads.map((payload) => base64(new Uint8Array(payload)));
    return this.#page.evaluate((each) => window.view.feed(each), texts);
  }

  /** Decodes a picture of the depth camera's video, which paints the cloud of its capture instant. */
  paint(picture: CodedPicture): Promise<void> {
    const { bytes, ...others } = picture;
    return this.#page.evaluate((given) => window.view.paint(given), { ...others, bytes: base64(bytes) });
  }

  /** What an eye sees. @param fieldOfView vertical, degrees */
  async look(eye: Pose, fieldOfView: number): Promise<{ picture: Picture; drawMs: number }> {
    const seen = await this.#page.evaluate((given) => window.view.look(given.eye, given.fieldOfView), {
      eye,
      fieldOfView,
    });
    const depth = Buffer.from(seen.depth, 'base64');
    const picture = {
      colour: new Uint8Array(Buffer.from(seen.colour, 'base64')),
      depth: new Float32Array(depth.buffer.slice(depth.byteOffset, depth.byteOffset + depth.length)),
    };
    return { picture, drawMs: seen.drawMs };
  }

  close(): Promise<void> {
    return this.#close();
  }
}

function bundle(into: string): void {
  const vite = join(repositoryRoot, 'apps', 'webxr', 'node_modules', 'vite', 'bin', 'vite.js');
  const options = ['--outDir', into, '--emptyOutDir', '--logLevel', 'error'];
  const { status, stdout, stderr } = spawnSync(
    process.execPath,
    [vite, 'build', join(import.meta.dirname, 'page'), ...options],
    { encoding: 'utf8' },
  );
  if (status !== 0) throw new Error(`the benchmark's page does not build:\n${stdout}${stderr}`);
}

function base64(bytes: Uint8Array): string {
  return Buffer.from(bytes.buffer, bytes.byteOffset, bytes.length).toString('base64');
}
